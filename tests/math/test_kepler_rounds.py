"""Kepler's equation is solved to the last digits in the number of steps that is fixed, for orbits of all kinds."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.math.kepler import DOUBLE, DOUBLE_ROUNDS, SINGLE_ROUNDS, not_below, reached
from graphfx.math.universal import universal

COUNT = 1500
TINY = DOUBLE[0]


@pytest.fixture(scope="module")
def orbits() -> list[np.ndarray]:
    """Times, nearest distances, c, beta, root and its inverse: radial and circular, nearly parabolic, hyperbolas to 1e40."""
    draw = np.random.default_rng(9)
    closed = np.arange(COUNT) % 2 == 0
    beta = np.where(closed, 1, -1) * 10.0 ** draw.uniform(-8, 0.3, COUNT)
    nearest = 10.0 ** draw.uniform(-15, 0, COUNT)
    nearest[::7] = 0
    mu = np.where(closed, 1.0, draw.choice([-1, 1], COUNT) * 10.0 ** draw.uniform(-8, 0, COUNT))
    c = np.where(closed, np.maximum(1 - beta * nearest, 0), np.maximum(mu - beta * nearest, 1e-8))
    period = 2 * np.pi * (c + np.abs(beta) * nearest) / np.abs(beta) ** 1.5
    time = np.where(closed, draw.random(COUNT) * period / 2, 10.0 ** draw.uniform(-10, 40, COUNT))
    root = np.sqrt(np.abs(beta))
    return [time, nearest, c, beta, root, 1 / root]


@pytest.mark.parametrize("rounds, unit", [(SINGLE_ROUNDS, 2.0**-24), (DOUBLE_ROUNDS, 2.0**-50)])
def test_rounds_are_enough(orbits, rounds, unit):
    """The fixed rounds leave less than half a last digit of float32, and no more than rounding in float64."""
    with np.errstate(all="ignore"):
        few, many = reached(*orbits, TINY, rounds), reached(*orbits, TINY, 9)
    assert np.isfinite(many).all() and (many > 0).all()
    assert (np.abs(few - many) <= unit * many).all(), (np.abs(few - many) / many).max()


def test_newton_comes_down(orbits):
    """From a bound that is not below the root, every step of Newton's method stays above it: what is left is never < 0."""
    time, q, c, beta, root, per_root = orbits
    with np.errstate(all="ignore"):
        s = not_below(*orbits, TINY)
        for _ in range(DOUBLE_ROUNDS):
            _, _, g2, g3 = universal(s, beta, root, per_root)
            left = (q * s + c * g3) / time - 1
            assert (left >= -1e-6).all() and (left >= -1e-12).mean() > 0.99, left.min()
            s = s - left * time / np.maximum(q + c * g2, TINY)
