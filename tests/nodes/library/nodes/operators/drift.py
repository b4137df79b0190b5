"""Drift: move along with a slow current.

    dP/dt = current

"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="position", neutral="length(current) == 0")
def drift(current: Vec3 = param((1, 0, 0), unit="m/s", doc="Velocity of the current.")) -> Vec3:
    """Return the rate of change of the position."""
    return current
