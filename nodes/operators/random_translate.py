"""Random translation: shift each particle this way and that, and leave its own velocity alone.

    dP/dt = speed (x, y, z) along,    (x, y, z) uniform in the unit ball, new for each particle every 1/24 s

It holds for 1/24 s whatever the frames and steps are, so the motion is the same at any of them, and exact. After n such
times a particle is off by about speed sqrt(0.6 n) / 24. [Sims 1990, 3.3]

Also called: jitter, wander, random walk.
"""

from graphfx.math import Vec3, on_unit_sphere, power
from graphfx.node import operator, param


@operator.noise(writes="position", neutral="speed == 0")
def random_translate(
    draw: tuple,
    speed: float = param(1.0, unit="m/s", doc="Greatest applied velocity."),
    along: Vec3 = param((1, 1, 1), doc="Share of it along x, y and z; (1, 0, 1) keeps to the ground."),
) -> Vec3:
    """Return the applied velocity."""
    shift = on_unit_sphere(draw[0], draw[1]) * (speed * power(draw[2], 0.3333333333333333))
    return Vec3(shift.x * along.x, shift.y * along.y, shift.z * along.z)
