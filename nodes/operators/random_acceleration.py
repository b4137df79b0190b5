"""Random acceleration: push each particle this way and that, as small gusts do.

    A = strength (x, y, z) along,    (x, y, z) uniform in the unit ball, new for each particle every 1/24 s

It holds for 1/24 s whatever the frames and steps are, so the motion is the same at any of them, and exact. After n such
times a velocity is off by about strength sqrt(0.6 n) / 24. [Sims 1990, 3.4]

As Brownian motion it is dV = strength dW along: after a time t each component of a velocity is off by strength sqrt(t), the
strength being in m/s^1.5. A particle's W is the same whatever the frames and steps are; the motion is of order 1 in the step.

Also called: jitter, random force, Langevin force.
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.noise(writes="velocity", neutral="strength == 0")
def random_acceleration(
    noise: Vec3,
    strength: float = param(1.0, unit="m/s^2", doc="Greatest acceleration; m/s^1.5 if Brownian."),
    along: Vec3 = param((1, 1, 1), doc="Share of it along x, y and z; (1, 0, 1) keeps to the ground."),
) -> Vec3:
    """Return the acceleration."""
    return Vec3(noise.x * along.x, noise.y * along.y, noise.z * along.z) * strength
