"""Directions from uniform numbers."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.math import Vec3, around, dot, on_unit_sphere

GENERATOR = np.random.default_rng(8)


def test_directions_are_unit_and_even() -> None:
    """Points of the sphere are at distance 1, and their mean and mean squares are those of the even distribution."""
    u, v = GENERATOR.uniform(size=(2, 200_000))
    x, y, z = on_unit_sphere(u, v)
    assert np.abs(x * x + y * y + z * z - 1.0).max() < 1e-14
    for part in (x, y, z):
        assert abs(part.mean()) < 4 / np.sqrt(3 * part.size)
        assert abs((part * part).mean() - 1 / 3) < 4 * np.sqrt(4 / 45 / part.size)


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, -1), (0.6, 0.8, 0), (0.0, 0.9, np.sqrt(0.19)), (-0.48, 0.6, 0.64)])
def test_a_vector_around_an_axis_is_square_to_it(axis: tuple[float, float, float]) -> None:
    """It has length 1, is square to the axis, and a quarter turn on it is square to it and right-handed."""
    a = Vec3(*map(np.float64, axis))
    first, second = around(a, np.float64(0.0)), around(a, np.float64(0.25))
    assert abs(dot(first, a)) < 1e-15 and abs(dot(first, first) - 1) < 1e-15 and abs(dot(first, second)) < 1e-15
    turned = np.cross([first.x, first.y, first.z], [second.x, second.y, second.z])
    np.testing.assert_allclose(turned, axis, atol=1e-14)
