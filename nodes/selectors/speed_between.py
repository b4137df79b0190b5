"""Fast enough, and slow enough.

    slowest <= |V| <= fastest

V is the particle's own velocity; applied velocities are not in it.
"""

from graphfx.math import Vec3, length
from graphfx.node import INFINITY, param, selector


@selector
def speed_between(
    velocity: Vec3,
    slowest: float = param(0.0, unit="m/s", min=0, doc="What is slower does not pass."),
    fastest: float = param(INFINITY, unit="m/s", min=0, doc="What is faster does not pass."),
) -> bool:
    """Return whether the particle's speed lies between."""
    speed = length(velocity)
    return (speed >= slowest) & (speed <= fastest)
