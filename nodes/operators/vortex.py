"""Vortex: swirl particles about an axis; the nearer the axis, the faster they turn.

    theta = magnitude / R^tightness dt

R is the distance from the axis (in units of 1 m), where the paper takes it from the center, and the turn is a
rate times dt, where the paper's is an angle per step. Turning keeps R and the height along the axis, so the flow
is exact for any dt. On the axis itself (R = 0) nothing moves, and close by R^-tightness counts as
at most 1e18. [Sims 1990, 3.3.1]
"""

from graphfx.math import Vec3, cross, dot, length, minimum, power, sincos, where
from graphfx.node import INFINITY, operator, param


@operator.flow(writes="position", neutral="magnitude == 0 and lift == 0")
def vortex(
    position: Vec3,
    dt: float,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Any point on the axis."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Turns are right-handed about it."),
    magnitude: float = param(1.0, unit="rad/s", doc="Turning rate at R = 1 m; negative turns the other way."),
    tightness: float = param(1.5, min=0, max=8, doc="How quickly the rate falls with R; 1 to 2 is usual."),
    range: float = param(INFINITY, unit="m", min=0, doc="Beyond this distance there is no turning; it fades smoothly to it."),
    lift: float = param(0.0, unit="m/s", doc="Speed along the axis at R = 1 m, falling with R in the same way; tornadoes."),
) -> Vec3:
    """Return the position after turning for dt seconds."""
    offset = position - center
    height = dot(offset, axis)
    radial = offset - axis * height
    R = length(radial)
    near = R / range
    fade = where(near < 1.0, (1.0 - near * near) * (1.0 - near * near), 0.0)
    rate = dt * fade * minimum(power(where(R > 0.0, R, 1.0), -tightness), 1e18)
    sine, cosine = sincos(magnitude * rate)
    moved = center + axis * (height + lift * rate) + radial * cosine + cross(axis, radial) * sine
    return where(R > 0.0, moved, position)
