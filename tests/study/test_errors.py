"""Statistics of errors against values found by hand."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.matching import matched, quantile, size
from graphfx.cook.trial import States
from graphfx.study.errors import Distances, observed_order, root_mean_square


def states(places, ids=None, lives=None) -> States:
    """Return particles on the x axis."""
    position = np.array([[x, 0, 0] for x in places], float).reshape(-1, 3)
    numbers = np.arange(len(places)) if ids is None else ids
    return States(np.array(numbers, np.uint64), np.array(lives or [0] * len(places)), position, np.zeros_like(position))


def errors_of(true, other, tolerance=1.0, extent=1000.0):
    distances = Distances()
    distances.add("a", 1, true, other, extent)
    return distances.errors(tolerance)


def test_statistics_of_known_distances():
    """Of the distances 1 to 20: RMS sqrt(143.5), median 10, 95th percentile 19, greatest 20, 15 over 5."""
    found = errors_of(states([0] * 20), states(range(1, 21)), tolerance=5)
    assert found.rms == pytest.approx(143.5**0.5, rel=1e-15)
    assert (found.median, found.p95, found.greatest, found.over, found.compared, found.failures) == (10, 19, 20, 15, 20, 0)


def test_failures_are_infinitely_wrong_and_counted_once():
    """One of four is no number, one is not there, one has escaped: the median is infinite, RMS is that of the fourth."""
    found = errors_of(states([0, 0, 0, 0]), states([np.nan, 2, 1e9], ids=[0, 1, 2]))
    assert (found.not_finite, found.missing, found.escaped, found.over) == (1, 1, 1, 4)
    assert (found.rms, found.greatest, found.median, found.p95) == (2, 2, np.inf, np.inf)


def test_a_particle_fails_once_however_often_it_is_seen():
    """Failures count particles, not frames."""
    distances = Distances()
    for frame in range(3):
        distances.add("a", frame, states([0, 0]), states([np.inf, 0]), 10.0)
    assert distances.errors(1.0).not_finite == 1


def test_quantiles_by_frame():
    """Each frame has its own, over all sources; a frame without particles has none."""
    distances = Distances()
    for source, frame, other in (("a", 1, [3]), ("b", 1, [4, 5]), ("a", 2, [7]), ("a", 3, [])):
        distances.add(source, frame, states([0] * len(other)), states(other), 100.0)
    assert distances.by_frame() == {1: 5, 2: 7}


def test_particles_are_matched_by_id_and_life():
    """The order of rows does not matter; another life of the same particle is another particle."""
    true, other = states([1, 2, 3, 4], [7, 8, 9, 9], [0, 0, 0, 1]), states([40, 30, 10], [9, 9, 7], [1, 0, 0])
    rows, theirs = matched(true, other)
    assert sorted(zip(true.position[rows, 0].tolist(), other.position[theirs, 0].tolist(), strict=True)) == [
        (1, 10), (3, 30), (4, 40)]


def test_nothing_overflows():
    """Lengths near the greatest number, and the root of the mean of their squares, are finite; what is no number is infinite."""
    assert size(np.array([[1e300, 1e300, 0], [np.nan, 0, 0]])).tolist() == [pytest.approx(2**0.5 * 1e300), np.inf]
    assert root_mean_square(np.array([1e300, 1e300])) == pytest.approx(1e300)
    assert root_mean_square(np.zeros(3)) == 0


def test_quantile_is_a_value_that_occurs():
    """The 95th percentile of 100 values is the 95th; of one it is that one."""
    assert quantile(np.arange(1.0, 101.0), 0.95) == 95
    assert quantile(np.array([4.0]), 0.95) == 4


def test_observed_order_of_a_power():
    """error = 3 work^-2.5 shows order 2.5, whatever stands above and below what is measured, and where rounding rules."""
    work = [1.0, 2, 4, 8, 16, 32, 64, 128]
    errors = [1e6, *(3 * w**-2.5 for w in work[1:6]), 1e-4, 2e-3]
    assert observed_order(work, errors, 2e-4, 100.0) == pytest.approx(2.5, rel=1e-12)


def test_one_point_shows_no_order():
    """A slope needs two points that are measured."""
    assert observed_order([1, 2, 4], [0.1, 1e-9, 1e-9], 1e-8) is None
    assert observed_order([], [], 0) is None
