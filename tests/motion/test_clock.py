"""The clock: times from whole numbers, exact after any number of frames."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import pytest

from graphfx.motion.clock import Clock

RATES = [24, 30, 60, 1, 23.976, 29.97, 59.94, 12.5, 1000, Fraction(1, 3)]


@pytest.mark.parametrize("fps", RATES)
def test_time_is_the_quotient_of_whole_numbers(fps):
    """Frame n is at (n - first) / fps, rounded once, after a million frames and before the first too."""
    rate = Fraction(str(fps)) if isinstance(fps, float) else Fraction(fps)
    clock = Clock(float(fps), 7)
    assert all(clock.time_of(7 + n) == float(n / rate) for n in (0, 1, 2, 3, 999, 10**6, 10**6 + 1, -1, -40))


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("preroll", [0, 1, 0.1, 0.04, 6, 1 / 3, 2.71828])
def test_intervals_fill_the_time(fps, preroll):
    """Intervals begin at -preroll, each where the last ended, and end at the frames' times; none is empty or too long."""
    clock = Clock(float(fps), 3, preroll)
    intervals = list(clock.intervals(20))
    assert intervals[0].start == clock.start == pytest.approx(-preroll, abs=1e-6)
    assert all(one.end == other.start for one, other in pairwise(intervals))
    assert all(interval.end == clock.time_of(interval.frame) for interval in intervals)
    assert all(0 < interval.length <= (1 + 1e-9) / fps for interval in intervals)
    assert intervals[-1].frame == 20 and [i.frame for i in intervals] == list(range(intervals[0].frame, 21))


def test_fractional_preroll_shortens_the_first_interval_alone():
    """A preroll of 2.4 frames gives one interval of 0.4 frames and two whole ones before the first frame."""
    intervals = list(Clock(24, 1, 0.1).intervals(2))
    assert [interval.frame for interval in intervals] == [-1, 0, 1, 2]
    assert [round(interval.length * 24, 12) for interval in intervals] == [0.4, 1, 1, 1]


def test_no_frames_no_intervals():
    """Without preroll nothing comes before the first frame."""
    assert list(Clock(24, 1).intervals(1)) == [] and list(Clock(24, 5).intervals(4)) == []


def test_many_intervals_do_not_drift():
    """The last of 1e5 intervals interval ends at its frame's time to the last bit, and the lengths differ by rounding alone."""
    clock = Clock(24, 0)
    last = None
    for interval in clock.intervals(10**5):
        last = interval
    assert last is not None and last.end == 10**5 / 24 and last.start == (10**5 - 1) / 24
