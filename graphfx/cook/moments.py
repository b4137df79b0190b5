"""When many things happen, in order, without a list of it: times are found when they are asked for.

    part p is of the numbers offsets[p] ... offsets[p + 1] - 1:
    t(n) = burst[p]                               all at once
    t(n) = flow(first[p] + n - offsets[p])        one after another
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

PIECE = 1 << 18
"""Particles that are looked at together where each takes memory of its own for a while."""
Flow = Callable[[np.ndarray], np.ndarray]
"""The times [s] of what is numbered, which do not fall as the numbers rise."""


def _never(numbers: np.ndarray) -> np.ndarray:
    return np.full(len(numbers), np.inf)


NO_FLOW: tuple[Flow, int, int] = _never, 0, 0


@dataclass(frozen=True)
class Moments:
    """Ascending times [s]; `bursts` are NaN for the parts that flow, whose first numbers are `first`."""

    count: int
    offsets: np.ndarray
    bursts: np.ndarray
    first: np.ndarray
    flow: Flow

    def __len__(self) -> int:
        """Return how many times there are."""
        return self.count

    def at(self, places: np.ndarray) -> np.ndarray:
        """Return the times at some places among all, 0 the first."""
        if len(self.offsets) == 1 and np.isnan(self.bursts[0]):
            return self.flow(self.first[0] + places)
        part = np.searchsorted(self.offsets, places, "right") - 1
        times = self.bursts[part]
        flowing = np.flatnonzero(np.isnan(times))
        if len(flowing):
            part = part[flowing]
            times[flowing] = self.flow(self.first[part] + places[flowing] - self.offsets[part])
        return times

    def chosen(self, places: np.ndarray) -> Moments:
        """Return the times at ascending places as all that there are."""
        times = self.at(places)
        return moments(flow=lambda numbers: times[numbers], count=len(times))

    def between(self, start: int, stop: int) -> np.ndarray:
        """Return the times at places start ... stop - 1."""
        return self.at(np.arange(start, stop))


def moments(
    bursts: Sequence[float] = (), counts: Sequence[int] = (), flow: Flow = _never, first: int = 0, count: int = 0
) -> Moments:
    """Return when things happen that come in bursts, so many at each of the ascending times, and in a flow.

    The flow has `count` from number `first` on. What happens in a burst comes before what flows at the same time.
    """
    times = np.array(bursts, np.float64)
    places = _places(times, flow, first, count)
    lengths = np.zeros(2 * len(times) + 1, np.int64)
    lengths[0::2], lengths[1::2] = np.diff(np.concatenate([[0], places, [count]])), counts
    at_once, numbers = np.full(len(lengths), np.nan), np.zeros(len(lengths), np.int64)
    at_once[1::2], numbers[0::2] = times, first + np.concatenate([[0], places]).astype(np.int64)
    offsets, some = np.cumsum(lengths) - lengths, lengths > 0
    return Moments(int(lengths.sum()), offsets[some], at_once[some], numbers[some], flow)


def _places(times: np.ndarray, flow: Flow, first: int, count: int) -> np.ndarray:
    """Return how many of a flow come before each of some times, by bisection."""
    low, high = np.zeros(len(times), np.int64), np.full(len(times), count)
    while (low < high).any():
        middle = (low + high) // 2
        before = (low < high) & (flow(first + middle) < times)
        low, high = np.where(before, middle + 1, low), np.where(before, high, middle)
    return low


def pieces(first: int, end: int) -> Iterator[tuple[int, int]]:
    """Yield the pieces start ... stop - 1 of the numbers first ... end - 1, in order."""
    for start in range(first, end, PIECE):
        yield start, min(start + PIECE, end)
