"""Uniformly in a box with sides along the axes.

    P = min + (max - min) * (u, v, w)

[Sims 1990, 3.1]
"""

from graphfx.math import Vec3
from graphfx.node import param, value


@value
def in_box(
    draw: tuple,
    min: Vec3 = param((-1, -1, -1), doc="Corner with the least coordinates."),
    max: Vec3 = param((1, 1, 1), doc="Corner with the greatest coordinates."),
) -> Vec3:
    """Return a point of the box."""
    return Vec3(min.x + (max.x - min.x) * draw[0], min.y + (max.y - min.y) * draw[1], min.z + (max.z - min.z) * draw[2])
