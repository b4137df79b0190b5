"""How opacity falls from 1 at a particle's centre to 0 at its edge.

With q = distance / radius:

    linear     1 - q                                          ends at q = 1
    gaussian   (exp(-k q^2) - exp(-k)) / (1 - exp(-k))        k = 4.5: the edge is at three standard deviations
    disc       1, with a ramp one pixel wide across the edge  ends half a pixel outside it
    a curve    straight lines between points (q, opacity), level before the first and after the last; ends at q = 1

A capsule of radius r and length L has the total (opacity summed over its area, pixels^2)

    width r L + area r^2

with the two numbers below, exact integrals; those of the disc are of the ideal one, without its ramp. Its spread is

    moment r^2        the mean of x^2 over the opacity of a still particle, x across it

so convolved with a disc of radius q, such as an open lens makes of a point, it has the spread of one of radius
sqrt(r^2 + q^2 / (4 moment)).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

LINEAR, GAUSSIAN, DISC, CURVE = 0, 1, 2, 3
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
Points = Sequence[tuple[float, float]]


def curve_of(points: Points) -> Falloff:
    """Return the falloff of a curve."""
    starts, values, slopes = _lines(points)
    ends, levels = np.append(starts[1:], 1.0), values - slopes * starts

    def integral(power: int) -> float:
        """Return the integral of q^power times the curve, from 0 to 1."""
        low, high = power + 1, power + 2
        return float((levels * (ends**low - starts**low) / low + slopes * (ends**high - starts**high) / high).sum())

    if not integral(1) > 0.0:
        raise ValueError("a falloff is 0 everywhere; nothing would be drawn")
    return Falloff(CURVE, 2 * integral(0), 2 * math.pi * integral(1), integral(3) / (2 * integral(1)), 0.0)


def curve_table(points: Points) -> np.ndarray:
    """Return what kernels read of a curve, float32: how many lines, then of each where it starts, its value there, its slope."""
    lines = np.stack(_lines(points), axis=1)
    return np.append(len(lines), lines.reshape(-1)).astype(np.float32)


def _lines(points: Points) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return where the straight lines of a curve start, from 0 on, their values there, and their slopes."""
    places, values = (np.array([point[k] for point in points], np.float64) for k in range(2))
    rising = len(places) > 0 and (np.diff(places) > 0).all() and places[0] >= 0 and places[-1] <= 1
    if not rising or not ((values >= 0) & (values <= 1)).all():
        raise ValueError("the points of a falloff are pairs (q, opacity) of numbers from 0 to 1, q rising")
    starts = np.concatenate([[0.0], places]) if places[0] > 0 else places
    values = np.interp(starts, places, values)
    slopes = np.append(np.diff(values) / np.diff(starts), 0.0)
    keep = starts < 1
    return starts[keep], values[keep], slopes[keep]
