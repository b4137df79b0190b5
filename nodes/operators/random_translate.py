"""Random translation: shift each particle this way and that, and leave its own velocity alone.

    dP/dt = speed (x, y, z) along,    (x, y, z) uniform in the unit ball, new for each particle every 1/24 s

It holds for 1/24 s whatever the frames and steps are, so the motion is the same at any of them, and exact. After n such
times a particle is off by about speed sqrt(0.6 n) / 24. [Sims 1990, 3.3]

As Brownian motion it is dP = speed dW along: after a time t each coordinate is off by speed sqrt(t), the speed being in
m/s^0.5. A particle's W is the same whatever the frames and steps are.

Also called: jitter, wander, random walk, diffusion.
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.noise(writes="position", neutral="speed == 0")
def random_translate(
    noise: Vec3,
    speed: float = param(1.0, unit="m/s", doc="Greatest applied velocity; m/s^0.5 if Brownian."),
    along: Vec3 = param((1, 1, 1), doc="Share of it along x, y and z; (1, 0, 1) keeps to the ground."),
) -> Vec3:
    """Return the applied velocity."""
    return Vec3(noise.x * along.x, noise.y * along.y, noise.z * along.z) * speed
