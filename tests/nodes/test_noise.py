"""The value `noise`: the field of `curl_noise`, as a number and as a vector."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from graphfx.math import Vec3, curl_noise
from graphfx.node import Library

NOISE = Library()["noise"].function


@functools.cache
def many() -> tuple[np.ndarray, np.ndarray]:
    """Return levels and vectors at 700 places of many patches."""
    places = np.random.default_rng(5).uniform(-100, 100, (700, 3))
    found = [NOISE(0.0, Vec3(*place), 1.5, 0.0, 3) for place in places]
    return np.array([level for level, _ in found]), np.array([[v.x, v.y, v.z] for _, v in found])


def test_means_are_as_documented() -> None:
    """The mean of vector . vector is 1, that of level^2 is 1/3, and level has no mean."""
    levels, vectors = many()
    assert (vectors**2).sum(1).mean() == pytest.approx(1, rel=0.12)
    assert (levels**2).mean() == pytest.approx(1 / 3, rel=0.15)
    assert levels.mean() == pytest.approx(0, abs=0.07)


def test_level_is_a_part_of_the_vector() -> None:
    """level = vector . (1, 1, 1) / sqrt 3."""
    levels, vectors = many()
    np.testing.assert_allclose(levels, vectors.sum(1) / np.sqrt(3), rtol=0, atol=1e-14)


def test_size_and_rate_stretch_space_and_time() -> None:
    """At size s and rate f the field at s x and time t / f is that of size 1 and rate 1 at x and t."""
    _, found = NOISE(3.0, Vec3(0.5, 1.0, -2.0), 2.0, 0.25, 7)
    wanted = curl_noise(Vec3(0.25, 0.5, -1.0), 0.75, 7)
    assert (found.x, found.y, found.z) == pytest.approx((wanted.x, wanted.y, wanted.z), abs=1e-14)


def test_neighbours_are_given_much_the_same() -> None:
    """A hundredth of a patch away the level has changed by little."""
    changes = [abs(NOISE(0.0, Vec3(x, 0.3, 0.2), 1.0, 0.0, 0)[0] - NOISE(0.0, Vec3(x + 0.01, 0.3, 0.2), 1.0, 0.0, 0)[0])
               for x in np.arange(0, 20, 0.17)]
    assert max(changes) < 0.08
