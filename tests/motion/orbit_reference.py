"""The orbit under an inverse square pull in 130 decimal digits, from its equation of motion by series alone.

    t = r0 s + eta0 G2(s) + zeta0 G3(s),    P' = f P + g V,    f = 1 - mu G2 / r0,    g = t - mu G3

Gn by their power series at s / 2^k, then doubled k times; s by bisection and Newton's method. Nothing is made smaller by
whole periods, and no form is chosen: digits that cancel do not matter here.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from typing import Any

import numpy as np

DIGITS = 130
TINY = Decimal(10) ** -100


def universal(beta: Decimal, s: Decimal) -> tuple[Decimal, Decimal, Decimal, Decimal]:
    """Return G0, G1, G2 and G3."""
    x, doublings = beta * s * s, 0
    while abs(x) > Decimal("0.1"):
        x, doublings = x / 4, doublings + 1
    s = s / 2**doublings
    term = two = Decimal(1) / 2
    three, n = term / 3, 3
    while abs(term) > TINY:
        term = -term * x / (n * (n + 1))
        two, three, n = two + term, three + term / (n + 2), n + 2
    g2, g3 = s * s * two, s**3 * three
    g0, g1 = 1 - beta * g2, s - beta * g3
    for _ in range(doublings):
        g0, g1, g2, g3 = 2 * g0 * g0 - 1, 2 * g0 * g1, 2 * g1 * g1, 2 * (g3 + g1 * g2)
    return g0, g1, g2, g3


class Orbit:
    """The orbit of a particle from some place, in numbers that are taken as they stand."""

    def __init__(self, position: Any, velocity: Any, strength: float):
        self.q, self.v = ([Decimal(float(part)) for part in vector] for vector in (position, velocity))
        self.mu = Decimal(float(strength))
        self.r = sum(part * part for part in self.q).sqrt()  # type: ignore[union-attr]
        self.beta = 2 * self.mu / self.r - sum(part * part for part in self.v)
        self.eta = sum(a * b for a, b in zip(self.q, self.v, strict=True))
        self.zeta = self.mu - self.beta * self.r

    def _time(self, s: Decimal) -> tuple[Decimal, Decimal]:
        """Return the time at s, and the distance then."""
        _, g1, g2, g3 = universal(self.beta, s)
        return self.r * s + self.eta * g2 + self.zeta * g3, self.r + self.eta * g1 + self.zeta * g2

    def _s_at(self, dt: Decimal) -> Decimal:
        low = Decimal(0)
        high = min(dt / self.r, 1 / abs(self.beta).sqrt() if self.beta else dt / self.r)
        while self._time(high)[0] < dt:
            low, high = high, 2 * high
        s = (low + high) / 2
        for turn in range(500):
            time, r = self._time(s)
            low, high = (low, s) if time > dt else (s, high)
            after = s - (time - dt) / r if r else low
            if not low < after < high or turn < 6:
                after = (low + high) / 2
            if abs(after - s) < TINY * 10**20 * abs(s):
                break
            s = after
        return after

    def after(self, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Return position and velocity after a time, (3,) of Decimal each."""
        time = Decimal(float(dt))
        _, g1, g2, g3 = universal(self.beta, s := self._s_at(time))
        r = self.r + self.eta * g1 + self.zeta * g2
        f, g = 1 - self.mu * g2 / self.r, time - self.mu * g3
        slope, kept = -self.mu * g1 / (self.r * r), 1 - self.mu * g2 / r
        q, v = np.array(self.q), np.array(self.v)
        assert s > 0
        return f * q + g * v, slope * q + kept * v


def size(vector: np.ndarray) -> Decimal:
    """Return the length of a vector."""
    return sum(part * part for part in vector).sqrt()  # type: ignore[no-any-return]


def error_of(got: Any, wanted: np.ndarray) -> float:
    """Return the size of the difference, relative to the size of what is wanted."""
    return float(size(np.array([Decimal(float(part)) for part in got]) - wanted) / size(wanted))


def after(position: Any, velocity: Any, strength: float, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity after a time, from the centre."""
    with localcontext() as context:
        context.prec = DIGITS
        return Orbit(position, velocity, strength).after(dt)


def errors(got: Any, position: Any, velocity: Any, strength: float, dt: float) -> tuple[float, float]:
    """Return the relative errors of position and velocity after a time."""
    with localcontext() as context:
        context.prec = DIGITS
        wanted = Orbit(position, velocity, strength).after(dt)
        return error_of(got[0], wanted[0]), error_of(got[1], wanted[1])
