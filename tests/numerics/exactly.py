"""Motion of one particle measured against closed forms, which are evaluated in extended precision."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

LONG, COMPLEX = np.longdouble, np.clongdouble
EPS = {32: 2.0**-23, 64: 2.0**-52}
"""The spacing of numbers above 1, by precision."""


def at(frame: int, fps: float) -> Any:
    """Return the time of a frame [s]."""
    time = frame / Fraction(fps)
    return LONG(time.numerator) / LONG(time.denominator)


def off(got: Any, wanted: Any, least: float = 0.0) -> float:
    """Return the greatest difference of components, relative to the greatest component wanted, or to `least` [m or m/s]."""
    wanted = np.array(wanted, LONG)
    size = max(np.abs(wanted).max(), LONG(least))
    difference = np.abs(np.array(got, LONG) - wanted).max()
    return float(difference / size) if size > 0 else float(difference)


def damped(d: Any, t: Any) -> Any:
    """Return (1 - e^-dt) / d, the way of a speed of 1, which is t at d = 0."""
    return -np.expm1(-LONG(d) * t) / LONG(d) if d else t
