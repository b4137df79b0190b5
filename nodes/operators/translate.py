"""Translate: an applied velocity, the same for all.

    dP/dt = rate

It moves the particle and leaves its own velocity alone. [Sims 1990, 3.3]
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="position", neutral="length(rate) == 0")
def translate(
    rate: Vec3 = param((0, 0, 0), unit="m/s", doc="Applied velocity; the particle's own velocity does not change."),
) -> Vec3:
    """Return the rate of change of the position."""
    return rate
