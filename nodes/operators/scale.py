"""Scale: draw all particles away from a center, or towards it, in proportion to their distance.

    dP/dt = rate (P - center),    so P' = center + (P - center) exp(rate dt)

An applied velocity: the particle's own velocity does not change. Exact for any dt, but that a step grows by 1e30 at most,
and who comes within 1e-33 m of the center is there. [Sims 1990, 3.3]
"""

from graphfx.math import Vec3, absolute, exp, maximum, minimum, where
from graphfx.node import operator, param


def growing(position: Vec3, center: Vec3, rate: float) -> Vec3:
    """Return the rate of change of the position."""
    return (position - center) * rate


@operator.flow(writes="position", neutral="rate == 0", linear=growing)
def scale(
    position: Vec3,
    dt: float,
    center: Vec3 = param((0, 0, 0), unit="m", doc="The point that stays where it is."),
    rate: float = param(0.5, unit="1/s", min=-50, max=50, doc="Growth; 0.693 doubles all in a second, negative shrinks."),
) -> Vec3:
    """Return the position after dt seconds."""
    offset = (position - center) * minimum(exp(rate * dt), 1e30)
    farthest = maximum(maximum(absolute(offset.x), absolute(offset.y)), absolute(offset.z))
    return center + offset * where(farthest < 1e-33, 0.0, 1.0)
