"""Random acceleration: push each particle this way and that, as small gusts do.

    A = strength (x, y, z) along,    (x, y, z) uniform in the unit ball, new for each particle every 1/24 s

It holds for 1/24 s whatever the frames and steps are, so the motion is the same at any of them, and exact. After n such
times a velocity is off by about strength sqrt(0.6 n) / 24. [Sims 1990, 3.4]

Also called: jitter, random force.
"""

from graphfx.math import Vec3, on_unit_sphere, power
from graphfx.node import operator, param


@operator.noise(writes="velocity", neutral="strength == 0")
def random_acceleration(
    draw: tuple,
    strength: float = param(1.0, unit="m/s^2", doc="Greatest acceleration."),
    along: Vec3 = param((1, 1, 1), doc="Share of it along x, y and z; (1, 0, 1) keeps to the ground."),
) -> Vec3:
    """Return the acceleration."""
    push = on_unit_sphere(draw[0], draw[1]) * (strength * power(draw[2], 0.3333333333333333))
    return Vec3(push.x * along.x, push.y * along.y, push.z * along.z)
