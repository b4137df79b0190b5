"""Rotate: turn all particles about an axis, rigidly, as a turntable does.

    P' = C + turn(P - C, about axis, by speed dt)

An applied velocity: the particle's own velocity does not turn with it. Exact for any dt. [Sims 1990, 3.3]
"""

from graphfx.math import Vec3, cross, sincos
from graphfx.math import rotate as turned
from graphfx.node import operator, param


def turning(position: Vec3, center: Vec3, axis: Vec3, speed: float) -> Vec3:
    """Return the rate of change of the position."""
    return cross(axis, position - center) * speed


@operator.flow(writes="position", neutral="speed == 0", linear=turning)
def rotate(
    position: Vec3,
    dt: float,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Any point on the axis."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Turns are right-handed about it."),
    speed: float = param(1.0, unit="rad/s", doc="Turning rate, the same at any distance; negative turns the other way."),
) -> Vec3:
    """Return the position after turning for dt seconds."""
    sine, cosine = sincos(speed * dt)
    return center + turned(position - center, axis, sine, cosine)
