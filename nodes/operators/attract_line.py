"""Attract to a line: accelerate towards the nearest point of a line; particles orbit it as they do a point.

    A = -strength r / (|r|^2 + softening^2)^((falloff + 1) / 2),    r = the part of P - point across the axis

Along the line nothing acts. Softening rounds off the pull within about its own length. No pull is infinite:
(|r|^2 + softening^2)^(...) counts as at least 1e-18. [Sims 1990, 3.4]

Also called: axis force, line attractor.
"""

from graphfx.math import Vec3, dot, minimum, power, where
from graphfx.node import operator, param


@operator.acceleration(neutral="strength == 0")
def attract_line(
    position: Vec3,
    mass: float,
    point: Vec3 = param((0, 0, 0), unit="m", doc="Any point of the line."),
    axis: Vec3 = param((0, 1, 0), direction=True, doc="Direction of the line."),
    strength: float = param(
        10.0, unit="m/s^2", min=-1e12, max=1e12, doc="Acceleration at 1 m from the line; negative drives away."
    ),
    falloff: float = param(1.0, min=0, max=8, doc="Power of the distance by which the pull falls; 1 is a charged wire's."),
    softening: float = param(0.1, unit="m", min=0, doc="Length within which the pull is rounded off."),
    as_force: bool = param(False, doc="Strength is a force [N], divided by the particle's mass."),
) -> Vec3:
    """Return the acceleration."""
    offset = position - point
    across = offset - axis * dot(offset, axis)
    distance2 = dot(across, across) + softening * softening
    pull = strength * minimum(power(distance2, (falloff + 1.0) * -0.5), 1e18)
    return across * -where(as_force, pull / mass, pull)
