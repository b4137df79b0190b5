"""Spiral: turn the velocity about the particle's spiral axis.

    dV/dt = speed (a x V),    a = spiral_axis / |spiral_axis|

A velocity parallel to the axis stays as it is; one perpendicular to it gives a circle; between the
two the particle moves on a helix along the axis. The turn is exact for any step.
[Sims 1990, 3.4.2]
"""

from graphfx.math import Vec3, cross, unit
from graphfx.node import operator, param


@operator.linear(writes="velocity", neutral="speed == 0")
def spiral(
    velocity: Vec3,
    spiral_axis: Vec3,
    speed: float = param(3.0, unit="rad/s", doc="Turning rate of the velocity, right-handed about the spiral axis."),
) -> Vec3:
    """Return the rate of change of the velocity."""
    return cross(unit(spiral_axis), velocity) * speed
