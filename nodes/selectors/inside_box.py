"""Inside a box with sides along the axes.

    min <= P <= max, in each coordinate

Also called: mask, region, bounding box.
"""

from graphfx.math import Vec3
from graphfx.node import param, selector


@selector
def inside_box(
    position: Vec3,
    min: Vec3 = param((-1, -1, -1), unit="m", doc="Corner with the least coordinates."),
    max: Vec3 = param((1, 1, 1), unit="m", doc="Corner with the greatest coordinates."),
) -> bool:
    """Return whether the particle is in the box."""
    along_x = (position.x >= min.x) & (position.x <= max.x)
    along_y = (position.y >= min.y) & (position.y <= max.y)
    along_z = (position.z >= min.z) & (position.z <= max.z)
    return along_x & along_y & along_z
