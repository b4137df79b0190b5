"""Curl noise: stir particles with a smooth random field that nowhere gathers or thins them out, like smoke in still air.

    dP/dt = speed u(P / size, rate time),    u = curl A

An applied velocity: the particle's own velocity does not change. The mean of u . u is 1. One field has one size; put
several, each half as large and somewhat slower, for finer detail. Second order in the step: the field is taken half way
along. [Bridson, Hourihan and Nordenstam 2007; `graphfx.math.noise` has the formula]

Also called: advect by noise, flow field.
"""

from graphfx.math import Vec3
from graphfx.math import curl_noise as field
from graphfx.node import operator, param


@operator.velocity(neutral="speed == 0")
def curl_noise(
    position: Vec3,
    time: float,
    speed: float = param(1.0, unit="m/s", doc="Usual speed: the root of its mean square."),
    size: float = param(1.0, unit="m", min=1e-6, doc="Size of the eddies; the field repeats after 289 of them."),
    rate: float = param(0.5, unit="1/s", doc="How often the field has become another; 0 stands still."),
    seed: int = param(0, min=0, max=83520, doc="Another seed is another field."),
) -> Vec3:
    """Return the applied velocity."""
    return field(position * (1.0 / size), time * rate, seed) * speed
