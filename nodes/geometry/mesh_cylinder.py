"""A cylinder about the y axis, its middle at the origin; without caps it is a tube."""

from graphfx.geometry import Mesh, cylinder
from graphfx.node import geometry, param


@geometry
def mesh_cylinder(
    cylinder_radius: float = param(0.5, unit="m", min=0, doc="Distance of its edges from the axis."),
    height: float = param(1.0, unit="m", min=0, doc="Its length along y."),
    segments: int = param(32, min=3, max=4096, doc="Flat sides around."),
    caps: bool = param(True, doc="Whether its ends are closed."),
) -> Mesh:
    """Return the cylinder."""
    return cylinder(cylinder_radius, height, segments, caps)
