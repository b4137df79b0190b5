"""Uniformly in a flat disc.

    P = center + radius sqrt(u) (cos 2 pi v e1 + sin 2 pi v e2),   e1 and e2 across the axis

"""

from graphfx.math import Vec3, around, sqrt
from graphfx.node import param, value


@value
def in_disc(
    draw: tuple,
    center: Vec3 = param((0, 0, 0), doc="Center of the disc."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Normal of the disc."),
    radius: float = param(1.0, min=0, doc="Radius of the disc."),
) -> Vec3:
    """Return a point of the disc."""
    return center + around(axis, draw[1]) * (radius * sqrt(draw[0]))
