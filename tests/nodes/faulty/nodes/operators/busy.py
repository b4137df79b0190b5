"""Busy: pushes on even when it says that it does nothing."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.acceleration(neutral="strength == 0")
def busy(strength: float = param(1.0, unit="m/s^2", doc="Strength.")) -> Vec3:
    """Return the acceleration."""
    return Vec3(strength, strength, strength + 1.0)
