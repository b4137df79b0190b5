"""Bursts: `count` at once, again and again, beside a rate, within an interval, at any frames."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.births import Births
from graphfx.errors import LimitError
from graphfx.motion.clock import Clock

from .effects import made


def births(emit, **time):
    """Return the times of all births of an emitter whose rate is 0 unless it is given."""
    found = made([], {"rate": 0, "life": 1e6, "set": {"velocity": [1, 0, 0]}, **emit}, {"precision": 64, **time})
    return found.simulate(found.flat.time.last)["sky"]["birth"]


@pytest.mark.parametrize("fps", [24, 25, 30, 60, 23.976, 10])
@pytest.mark.parametrize("every", [0.1, 0.05, 1 / 3, 1 / 24, 1 / 25, 1 / 60, 0.01, 0.3])
def test_no_burst_is_lost_or_doubled(fps, every):
    """The n-th burst is at n every, also where that is the time of a frame to the last bit."""
    emitter = made([], {"rate": 0, "count": 1, "every": every, "life": 1e6, "set": {"velocity": [1, 0, 0]}}).plan.emitters["sky"]
    clock = Clock(fps, 1)
    source = Births(emitter, clock.start)
    births = [source.at_start(), *(source.within(interval) for interval in clock.intervals(200))]
    found = np.concatenate([times.between(0, len(times)) for times in births])
    wanted = np.arange(20000) * every
    assert np.array_equal(found, wanted[wanted <= clock.time_of(200)])


def test_burst_is_at_once_and_once():
    """A count without `every` is made as the emitter begins, all at one time."""
    assert births({"count": 7}).tolist() == [0.0] * 7
    assert births({"count": 7}, preroll=0.13).tolist() == [-0.13] * 7
    assert births({"count": 7, "during": [0.1, 0.2]}).tolist() == [0.1] * 7


@pytest.mark.parametrize("begin", [0.0, 0.25, 0.1])
def test_bursts_count_from_the_begin_of_the_interval(begin):
    """With `during` they are at begin + n every until it ends."""
    found = births({"count": 2, "every": 0.07, "during": [begin, begin + 0.15]})
    np.testing.assert_allclose(found, np.repeat(begin + 0.07 * np.arange(3), 2), rtol=0, atol=1e-15)


def test_bursts_and_a_rate_go_together_in_order_of_time():
    """Particles are numbered by time, whoever makes them."""
    found = births({"count": 3, "every": 0.1, "rate": 50})
    assert np.array_equal(found, np.sort(found)) and len(found) == 3 * 5 + 23


def test_count_may_change_with_time():
    """Each burst takes the count of its time; what is less than one, or no number, is none."""
    count = {"keys": [[0, 0], [1, 10]]}
    values, numbers = np.unique(births({"count": count, "every": 0.1}), return_counts=True)
    np.testing.assert_allclose(values, [0.1, 0.2, 0.3, 0.4])
    assert numbers.tolist() == [1, 2, 3, 4]
    assert len(births({"count": {"expr": "0 / 0 + time"}, "every": 0.1})) == 0


@pytest.mark.parametrize(
    "emit, remedy",
    [
        ({"count": {"expr": "1 / 0"}}, r"nodes\.sky\.count: inf particles would be born in one frame, .* lower the count"),
        ({"count": {"expr": "1e18 + time"}}, r"lower the count"),
        ({"count": 1e18}, "lower the rate, the count or the life"),
    ],
)
def test_too_many_at_once_are_told(emit, remedy):
    """A count beyond all measure ends in a message."""
    with pytest.raises(LimitError, match=remedy):
        births(emit)


@pytest.mark.parametrize("every", [{"expr": "0 / 0"}, {"expr": "1 / 0"}])
def test_every_that_is_no_time_is_never(every):
    """Where `every` is no number, or endless, there is one burst."""
    assert births({"count": 2, "every": every}).tolist() == [0.0, 0.0]
