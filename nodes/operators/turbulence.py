"""Turbulence: push particles about with a smooth random field, the same for all that are near each other.

    dV/dt = strength u(P / size, rate time)

The field of `curl_noise` as an acceleration; the mean of u . u is 1. With `damp` or `drag` it is a restless wind.
[Bridson, Hourihan and Nordenstam 2007; `graphfx.math.noise` has the formula]

Also called: noise force.
"""

from graphfx.math import Vec3, curl_noise
from graphfx.node import operator, param


@operator.acceleration(neutral="strength == 0")
def turbulence(
    position: Vec3,
    time: float,
    strength: float = param(1.0, unit="m/s^2", doc="Usual acceleration: the root of its mean square."),
    size: float = param(1.0, unit="m", min=1e-6, doc="Size of the eddies; the field repeats after 289 of them."),
    rate: float = param(0.5, unit="1/s", doc="How often the field has become another; 0 stands still."),
    seed: int = param(0, min=0, max=83520, doc="Another seed is another field."),
) -> Vec3:
    """Return the acceleration."""
    return curl_noise(position * (1.0 / size), time * rate, seed) * strength
