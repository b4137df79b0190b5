"""Gravity: one constant acceleration for all.

    dV/dt = acceleration

The path is a parabola, exact for any step. [Sims 1990, 3.4]
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="velocity", neutral="length(acceleration) == 0")
def gravity(acceleration: Vec3 = param((0, -9.81, 0), unit="m/s^2", doc="Acceleration of every particle.")) -> Vec3:
    """Return the rate of change of the velocity."""
    return acceleration
