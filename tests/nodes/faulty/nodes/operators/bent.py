"""Bent: a drag that is not linear, and says that it is."""

from graphfx.math import Vec3, length
from graphfx.node import operator, param


@operator.linear(writes="velocity")
def bent(velocity: Vec3, drag: float = param(1.0, unit="1/m", min=0, max=1, doc="Strength.")) -> Vec3:
    """Return the rate of change of the velocity."""
    return velocity * (-drag * length(velocity))
