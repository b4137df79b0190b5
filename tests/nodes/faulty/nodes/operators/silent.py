"""Silent: does nothing, and says that it is left out always, so that no plan has it."""

from graphfx.math import Vec3
from graphfx.node import operator


@operator.acceleration(neutral="1 == 1")
def silent() -> Vec3:
    """Return the acceleration."""
    return Vec3(0.0, 0.0, 0.0)
