"""How opacity falls from 1 at a particle's centre to 0 at its edge.

With q = distance / radius:

    linear     1 - q                                          ends at q = 1
    gaussian   (exp(-k q^2) - exp(-k)) / (1 - exp(-k))        k = 4.5: the edge is at three standard deviations
    disc       1, with a ramp one pixel wide across the edge  ends half a pixel outside it

A capsule of radius r and length L has the total (opacity summed over its area, pixels^2)

    width r L + area r^2

with the two numbers below, exact integrals; those of the disc are of the ideal one, without its ramp. Its spread is

    moment r^2        the mean of x^2 over the opacity of a still particle, x across it

so convolved with a disc of radius q, such as an open lens makes of a point, it has the spread of one of radius
sqrt(r^2 + q^2 / (4 moment)).
"""

from __future__ import annotations

import math
from typing import NamedTuple

LINEAR, GAUSSIAN, DISC = 0, 1, 2
SHARPNESS = 4.5
"""k of the gaussian."""
EDGE = math.exp(-SHARPNESS)
DISC_RAMP = 0.5
"""Half the width of the disc's ramp, pixels."""


class Falloff(NamedTuple):
    """One falloff: its code in kernels, its two integrals, and how far it reaches beyond its radius in pixels."""

    code: int
    width: float
    """Integral across a streak of radius 1."""
    area: float
    """Integral over a still particle of radius 1."""
    moment: float
    """Mean of x^2 over a still particle of radius 1."""
    reach: float


FALLOFFS = {
    "linear": Falloff(LINEAR, 1.0, math.pi / 3, 3 / 20, 0.0),
    "gaussian": Falloff(
        GAUSSIAN,
        (math.sqrt(math.pi / SHARPNESS) * math.erf(math.sqrt(SHARPNESS)) - 2 * EDGE) / (1 - EDGE),
        math.pi * (1 / SHARPNESS - EDGE / (1 - EDGE)),
        ((1 - (1 + SHARPNESS) * EDGE) / (2 * SHARPNESS**2) - EDGE / 4) / ((1 - EDGE) / SHARPNESS - EDGE),
        0.0,
    ),
    "disc": Falloff(DISC, 2.0, math.pi, 1 / 4, DISC_RAMP),
}
