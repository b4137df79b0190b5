"""Averted: a plane whose normal looks away from where particles come from."""

from graphfx.math import Vec3, where
from graphfx.node import operator, param


@operator.surface
def averted(
    start: Vec3, end: Vec3, height: float = param(0.0, unit="m", doc="Height of the plane.")
) -> tuple[bool, Vec3, Vec3]:
    """Return whether the way meets the plane, a point of it, and its normal."""
    side = where(start.y < height, 1.0, -1.0)
    return (start.y - height) * (end.y - height) < 0.0, Vec3(0.0, height, 0.0), Vec3(0.0, side, 0.0)
