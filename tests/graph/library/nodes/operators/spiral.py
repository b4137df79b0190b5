"""Spiral: the parameters of the real one."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="velocity")
def spiral(
    velocity: Vec3,
    spiral_axis: Vec3,
    speed: float = param(3.0, unit="rad/s", doc="Turning rate of the velocity about the spiral axis."),
) -> Vec3:
    """Return the velocity."""
    return velocity
