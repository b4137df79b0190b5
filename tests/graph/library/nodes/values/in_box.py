"""A point in a box: the parameters of the real one."""

from graphfx.math import Vec3
from graphfx.node import param, value


@value
def in_box(
    draw: tuple,
    min: Vec3 = param((-1, -1, -1), doc="Lower corner."),
    max: Vec3 = param((1, 1, 1), doc="Upper corner."),
) -> Vec3:
    """Return a point."""
    return min
