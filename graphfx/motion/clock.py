"""The clock: whole frames counted from integers, so that no time is ever a sum of steps.

Frame n shows t = (n - first) / fps. The simulation begins at -preroll; the first interval is shorter
if preroll is not a whole number of frames.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

DENOMINATOR = 1_000_000
"""Rates and prerolls are taken as fractions with at most this denominator: 23.976 is exact, as is 1/3."""


@dataclass(frozen=True)
class Interval:
    """The time from one frame's instant to the next: (start, end] in seconds, shown as `frame` (None: before the first)."""

    start: float
    end: float
    frame: int

    @property
    def length(self) -> float:
        """Return its length [s]."""
        return self.end - self.start


@dataclass(frozen=True)
class Clock:
    """Frames per second, the first frame's number, and the seconds simulated before it."""

    fps: float
    first: int
    preroll: float = 0.0

    def time_of(self, frame: int) -> float:
        """Return the time that a frame shows [s]."""
        return float((frame - self.first) / self._rate)

    @property
    def start(self) -> float:
        """Return when the simulation begins [s]."""
        return -float(self._before)

    def intervals(self, last: int) -> Iterator[Interval]:
        """Yield the intervals from the start up to frame `last`."""
        frame = self.first - math.ceil(self._before * self._rate) + 1
        start = self.start
        while frame <= last:
            end = self.time_of(frame)
            if end > start:
                yield Interval(start, end, frame)
            start = end
            frame += 1

    @property
    def _rate(self) -> Fraction:
        return Fraction(self.fps).limit_denominator(DENOMINATOR)

    @property
    def _before(self) -> Fraction:
        return Fraction(self.preroll).limit_denominator(DENOMINATOR)
