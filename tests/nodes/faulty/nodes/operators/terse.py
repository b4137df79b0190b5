"""no sentence"""

from graphfx.math import Vec3
from graphfx.node import operator


@operator.acceleration
def terse() -> Vec3:
    """Return the acceleration."""
    return Vec3(0.0, 1.0, 0.0)
