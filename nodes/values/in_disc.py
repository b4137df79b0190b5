"""Uniformly in a flat disc.

    P = center + radius sqrt(u) (cos 2 pi v e1 + sin 2 pi v e2),   e1 and e2 across the axis

"""

from graphfx.math import Vec3, absolute, cross, sincos, sqrt, unit, where
from graphfx.node import param, value


@value
def in_disc(
    draw: tuple,
    center: Vec3 = param((0, 0, 0), doc="Center of the disc."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Normal of the disc."),
    radius: float = param(1.0, min=0, doc="Radius of the disc."),
) -> Vec3:
    """Return a point of the disc."""
    upright = absolute(axis.y) < 0.9
    zero, one = axis.x * 0.0, axis.x * 0.0 + 1.0
    across = unit(cross(Vec3(where(upright, zero, one), where(upright, one, zero), zero), axis))
    sine, cosine = sincos(draw[1] * 6.283185307179586)
    return center + (across * cosine + cross(axis, across) * sine) * (radius * sqrt(draw[0]))
