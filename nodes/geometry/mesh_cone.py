"""A cone about the y axis: its base half the height below the origin, its tip as far above."""

from graphfx.geometry import Mesh, cone
from graphfx.node import geometry, param


@geometry
def mesh_cone(
    cone_radius: float = param(0.5, unit="m", min=0, doc="Radius of the base."),
    height: float = param(1.0, unit="m", min=0, doc="From the base to the tip."),
    segments: int = param(32, min=3, max=4096, doc="Flat sides around."),
    caps: bool = param(True, doc="Whether the base is closed."),
) -> Mesh:
    """Return the cone."""
    return cone(cone_radius, height, segments, caps)
