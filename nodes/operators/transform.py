"""Transform: put particles where their local coordinates lie, under a transform that may be animated.

    P = pivot + translate + R (scale (P0 - pivot)),    P0 = rest_position

R turns by `angle` about `axis`. It acts on each frame, so that motion blur follows it; `rest_position` is where the
particle was born unless it is set. [Sims 1990, 3.1]
"""

from graphfx.math import Vec3, rotate, sincos
from graphfx.node import operator, param


@operator.assign(writes="position")
def transform(
    rest_position: Vec3,
    translate: Vec3 = param((0, 0, 0), unit="m", doc="Added to the position."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Axis of the turn, which is right-handed about it."),
    angle: float = param(0.0, unit="deg", doc="How far it is turned."),
    scale: float = param(1.0, doc="How much the distance from the pivot grows."),
    pivot: Vec3 = param((0, 0, 0), type="point", unit="m", doc="The point about which it is turned and scaled."),
) -> Vec3:
    """Return the position."""
    local = (rest_position - pivot) * scale
    s, c = sincos(angle * 0.017453292519943295)
    return pivot + translate + rotate(local, axis, s, c)
