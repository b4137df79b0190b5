"""A torus about the y axis: a tube bent to a ring."""

from graphfx.geometry import Mesh, torus
from graphfx.node import geometry, param


@geometry
def mesh_torus(
    ring_radius: float = param(0.75, unit="m", min=0, doc="From the axis to the middle of the tube."),
    tube_radius: float = param(0.25, unit="m", min=0, doc="Radius of the tube."),
    segments: int = param(48, min=3, max=4096, doc="Pieces around the axis."),
    sides: int = param(24, min=3, max=4096, doc="Flat sides around the tube."),
) -> Mesh:
    """Return the torus."""
    return torus(ring_radius, tube_radius, segments, sides)
