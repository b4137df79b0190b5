"""Gusty: a push that grows with the square of the noise."""

from graphfx.math import Vec3, length
from graphfx.node import operator, param


@operator.noise(writes="velocity")
def gusty(noise: Vec3, strength: float = param(1.0, unit="m/s^2", min=0, max=1, doc="Strength.")) -> Vec3:
    """Return the acceleration."""
    return noise * (strength * length(noise))
