"""Scale: draw all particles away from a center, or towards it, in proportion to their distance.

    dP/dt = rate (P - center),    so P' = center + (P - center) exp(rate dt)

An applied velocity: the particle's own velocity does not change. Exact for any dt; growth counts as at most 3e38, so that
what is at the center stays there. [Sims 1990, 3.3]
"""

from graphfx.math import Vec3, exp, minimum
from graphfx.node import operator, param


@operator.flow(writes="position", neutral="rate == 0")
def scale(
    position: Vec3,
    dt: float,
    center: Vec3 = param((0, 0, 0), unit="m", doc="The point that stays where it is."),
    rate: float = param(0.5, unit="1/s", min=-50, max=50, doc="Growth; 0.693 doubles all in a second, negative shrinks."),
) -> Vec3:
    """Return the position after dt seconds."""
    return center + (position - center) * minimum(exp(rate * dt), 3e38)
