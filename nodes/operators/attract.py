"""Attract: accelerate towards a point, as planets are.

    A = strength (O - P) / (r^2 + softening^2)^((falloff + 1) / 2),    r = |O - P|

With falloff 2 and no softening this is the paper's A = g m (O - P) / |O - P|^3, an orbit of inverse squares, which is
known for any time: where nothing else acts, every step is exact, and what falls straight in comes back the way it came.
With falloff 0 the pull is the same at any distance. Softening rounds off the pull within about its own length, so that
particles that pass near the point are not flung where the step there is not exact. The sum in brackets is bounded so that
no pull is infinite: (r^2 + softening^2)^(...) counts as at least 1e-18. [Sims 1990, 3.4; softening: Plummer 1911]

Also called: attractor, repel, point force.
"""

from graphfx.math import Vec3, dot, kepler, minimum, power, where
from graphfx.node import operator, param


def orbit(
    position: Vec3, velocity: Vec3, mass: float, center: Vec3, strength: float, as_force: bool, dt: float
) -> tuple[Vec3, Vec3]:
    """Its orbit, by universal variables."""
    return kepler(position, velocity, center, where(as_force, strength / mass, strength), dt)


@operator.acceleration(neutral="strength == 0", flow=orbit, exact_if="softening == 0 and falloff == 2")
def attract(
    position: Vec3,
    mass: float,
    center: Vec3 = param((0, 0, 0), unit="m", doc="The point O."),
    strength: float = param(
        10.0, unit="m/s^2", min=-1e12, max=1e12, doc="Acceleration at 1 m; g m for gravity of a mass; negative drives away."
    ),
    falloff: float = param(2.0, min=0, max=8, doc="Power of the distance by which the pull falls; 2 is gravity, 0 none."),
    softening: float = param(0.1, unit="m", min=0, doc="Length within which the pull is rounded off."),
    as_force: bool = param(False, doc="Strength is a force [N], divided by the particle's mass."),
) -> Vec3:
    """Return the acceleration."""
    offset = center - position
    distance2 = dot(offset, offset) + softening * softening
    pull = strength * minimum(power(distance2, (falloff + 1.0) * -0.5), 1e18)
    return offset * where(as_force, pull / mass, pull)
