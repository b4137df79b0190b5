"""A box about the origin, closed, two triangles to a face."""

from graphfx.geometry import Mesh, box
from graphfx.math import Vec3
from graphfx.node import geometry, param


@geometry
def mesh_box(
    size: Vec3 = param((1, 1, 1), unit="m", min=0, doc="Its width, height and depth."),
) -> Mesh:
    """Return the box."""
    return box(size)
