"""The clock: whole frames counted from integers, so that no time is ever a sum of steps.

Frame n shows t = (n - first) / fps. The simulation begins at -preroll; the first interval is shorter
if preroll is not a whole number of frames.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

DENOMINATOR = 1_000_000
"""Rates and prerolls are taken as fractions with at most this denominator: 23.976 is exact, as is 1/3."""
CELL_RATE = 24
"""Cells of held noise in a second: a draw of noise holds for 1/24 s, whatever the frames and steps are."""
NEAR = 1e-9
"""Times that are so close together are one [s]."""
ON_THE_EDGE = 1e-6
"""A step that begins so little before a cell's end [cells] begins in the next."""
GRID = 16 * 25 * 4096
"""Places in a cell at which Brownian noise is found; the ends of most steps are such places, whole numbers from 0 to GRID."""


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

    @property
    def beginning(self) -> int:
        """Return the number of the frame at which the simulation begins, or of the last before that."""
        return self.first - math.ceil(self._before * self._rate)

    def intervals(self, last: int) -> Iterator[Interval]:
        """Yield the intervals from the start up to frame `last`."""
        frame = self.beginning + 1
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


def cuts_within(cuts: Iterable[float], start: float, length: float) -> list[float]:
    """Return which of some times [s] fall inside an interval, from its start; one within 1e-9 s of an end is at that end."""
    return [cut - start for cut in sorted(cuts) if NEAR < cut - start < length - NEAR]


def most_cuts(cuts: Iterable[float], fps: float) -> int:
    """Return how many of some times may fall into one frame."""
    times = sorted(cuts)
    return max((sum(first <= cut <= first + 1 / fps for cut in times) for first in times), default=0)


def most_cells(fps: float, preroll: float, substeps: int) -> int:
    """Return how many cells of noise, of 1/24 s from time 0, one of `substeps` equal steps of a frame may meet at most."""
    rate = Fraction(fps).limit_denominator(DENOMINATOR)
    cells = Fraction(CELL_RATE) / (rate * substeps)
    whole_frames = (Fraction(preroll).limit_denominator(DENOMINATOR) * rate).denominator == 1
    if whole_frames and 1 in (cells.numerator, cells.denominator):
        return math.ceil(cells)
    return math.ceil(cells) + 1


def cell_time(kind: str, start: float, begin: float, length: float, number: int, cells: int) -> float:
    """Return a time of the `number`-th of `cells` cells that a step may meet [s from `start`], or the "cell" number.

    `start` is the frame's [s]; the step begins at `start + begin`. By `kind`: "cell begin" and "cell end" are where cells
    part the step, so the first cell begins, and the last ends, beyond it; "cell start" is where the cell really begins.
    "piece begin" and "piece end" are the ends of what of the step lies in the cell, "first place" and "last place" those
    in the cell, from 0 to GRID. Numbers count modulo 2^32. A step that meets one cell alone is in that of its middle, as
    is cell -1.
    """
    middle = math.floor((start + begin + length / 2) * CELL_RATE)
    cell = middle if cells == 1 or number < 0 else math.floor((start + begin) * CELL_RATE + ON_THE_EDGE) + number
    if kind == "cell":
        return cell & 0xFFFFFFFF
    if kind == "cell begin":
        return cell / CELL_RATE - start if number > 0 else -math.inf
    if kind == "cell end":
        return (cell + 1) / CELL_RATE - start if number < cells - 1 else math.inf
    if kind == "cell start":
        return cell / CELL_RATE - start
    time = begin if kind in ("piece begin", "first place") else begin + length
    inside = min(max((start + time) * CELL_RATE - cell, 0.0), 1.0)
    if kind.startswith("piece"):
        return time if 0.0 < inside < 1.0 else min((cell + inside) / CELL_RATE - start, begin + length)
    return float(round(inside * GRID))
