"""Paths through points: they pass through all, straight ones are straight, they stay at their ends."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.geometry import points
from graphfx.geometry.tables import MeshTables
from graphfx.node import Library
from tests.geometry.lanes import PRECISIONS, function_of, on_lanes, same_bits

ALONG = function_of(Library()["along_path"])
BENT = np.array([[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 0.5], [4, 0, 0.5]], float)


def along(vertices: np.ndarray, progress: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return points and tangents of a path, found on the machine in float64."""
    point, tangent = on_lanes(ALONG, [MeshTables(points(list(vertices.ravel()))), progress], 64)
    return point, tangent


def test_passes_through_its_points() -> None:
    """At k / (n - 1) stands the k-th of n points, and the tangent there is (n - 1) (P[k+1] - P[k-1]) / 2."""
    point, tangent = along(BENT, np.arange(5) / 4)
    np.testing.assert_allclose(point, BENT, rtol=0, atol=1e-15)
    np.testing.assert_allclose(tangent[1:4], (BENT[2:] - BENT[:-2]) * 2, rtol=0, atol=1e-14)


def test_even_points_on_a_line_make_a_line() -> None:
    """Between its outer points a straight, even path is run through at an even pace."""
    line = np.arange(6)[:, None] * np.array([1.0, -2.0, 0.5])
    share = np.linspace(0.2, 0.8, 61)
    point, tangent = along(line, share)
    np.testing.assert_allclose(point, share[:, None] * line[-1], rtol=0, atol=1e-14)
    np.testing.assert_allclose(tangent, np.broadcast_to(line[-1], tangent.shape), rtol=0, atol=1e-13)


def test_tangent_is_the_derivative() -> None:
    """Differences of the point agree with the tangent, to the square of their step."""
    share, step = np.linspace(0.03, 0.97, 40), 1e-5
    (before, _), (after, _) = along(BENT, share - step), along(BENT, share + step)
    np.testing.assert_allclose((after - before) / (2 * step), along(BENT, share)[1], rtol=0, atol=1e-6)


@pytest.mark.parametrize("progress", [-3.0, 1.0, 7.5, np.inf, -np.inf])
def test_stays_at_its_ends(progress: float) -> None:
    """Beyond its ends a path stays, and one of a single point is that point."""
    end = BENT[0] if progress < 0 else BENT[-1]
    assert np.array_equal(along(BENT, np.array([progress]))[0][0], end)
    assert np.array_equal(along(BENT[1:2], np.array([progress]))[0][0], BENT[1])


@pytest.mark.parametrize("precision", PRECISIONS)
def test_machine_is_plain_python(precision: int) -> None:
    """Both ways give the same bits."""
    given = [MeshTables(points(list(BENT.ravel()))), np.random.default_rng(4).uniform(-0.2, 1.2, 300)]
    assert same_bits(ALONG, given, precision)
