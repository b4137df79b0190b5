"""Vortex: the parameters of the real one; it moves nothing."""

from graphfx.math import Vec3
from graphfx.node import INFINITY, operator, param


@operator.flow(writes="position", neutral="magnitude == 0 and lift == 0")
def vortex(
    position: Vec3,
    dt: float,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Any point on the axis."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Turns are right-handed about it."),
    magnitude: float = param(1.0, unit="rad/s", doc="Turning rate at R = 1 m; negative turns the other way."),
    tightness: float = param(1.5, min=0, max=8, doc="How quickly the rate falls with R; 1 to 2 is usual."),
    range: float = param(INFINITY, unit="m", min=0, doc="Beyond this distance there is no turning."),
    lift: float = param(0.0, unit="m/s", doc="Speed along the axis at R = 1 m."),
) -> Vec3:
    """Return the position."""
    return position
