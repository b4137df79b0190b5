"""Damp: slow particles down, as air does.

    dV/dt = -damping V,    so V(t) = V(0) exp(-damping t)

The paper's V' = V (1 - d dt) is its first-order form, which overshoots at d dt > 1; this one is exact for
any step. A negative damping speeds up. [Sims 1990, 3.4.1]
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="velocity", neutral="damping == 0")
def damp(
    velocity: Vec3,
    damping: float = param(1.0, unit="1/s", doc="Rate at which speed is lost; 0 to 10 is usual."),
) -> Vec3:
    """Return the rate of change of the velocity."""
    return velocity * -damping
