"""Which rows began a life within an interval, and which ended, and when."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from graphfx.cook.moments import Moments, pieces

NO_ROWS = np.zeros(0, np.int64)
NO_TIMES = np.zeros(0)


@dataclass
class Beginnings:
    """When rows began a life [s]; of several beginnings of a row the last counts.

    Those born by an emitter are a range of rows, whose times are found when they are asked for.
    """

    born: list[tuple[range, Moments]] = field(default_factory=list)
    begun: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)

    def note(self, rows: range | np.ndarray, times: Moments | np.ndarray) -> None:
        """Note that rows, each once, begin a life."""
        if not len(rows):
            return
        if isinstance(rows, range):
            assert isinstance(times, Moments)
            self.born.append((rows, times))
            return
        assert isinstance(times, np.ndarray)
        order = np.argsort(rows, kind="stable")
        self.begun.append((rows[order], times[order]))

    def of(self, rows: np.ndarray) -> np.ndarray:
        """Return when each of some rows began, -infinity for those that did not."""
        found = np.full(len(rows), -np.inf)
        low, high = (rows.min(), rows.max()) if len(rows) else (0, -1)
        for span, moments in self.born:
            if span.start <= high and low < span.stop:
                inside = np.flatnonzero((rows >= span.start) & (rows < span.stop))
                found[inside] = moments.at(rows[inside] - span.start)
        for known, times in self.begun:
            if known[0] <= high and low <= known[-1]:
                here, places = places_in(known, rows)
                found[here] = times[places]
        return found

    @property
    def some(self) -> bool:
        """Return whether any row began."""
        return bool(self.born or self.begun)

    def any_after(self, time: float) -> bool:
        """Return whether any began after a time."""
        latest = [moments.between(len(moments) - 1, len(moments)) for _, moments in self.born]
        return any((times > time).any() for times in (*latest, *(times for _, times in self.begun)))

    def kept(self, kept: np.ndarray, new: np.ndarray) -> Beginnings:
        """Return what is left when only those `kept` are, whose new rows are `new`; nobody may have been born as a range."""
        assert not self.born
        made = Beginnings()
        for rows, times in self.begun:
            made.note(new[rows[kept[rows]]], times[kept[rows]])
        return made


@dataclass
class Endings:
    """The rows whose lives ended, in order, and when [s]."""

    parts: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)
    ordered: bool = True
    """Whether there is one part at most, whose rows ascend."""

    def note(self, rows: np.ndarray, times: np.ndarray) -> None:
        """Note that rows, which had not ended, end."""
        if len(rows):
            self.parts.append((rows, times))
            self.ordered = False

    def all(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the rows, ascending, and the times."""
        if not self.ordered:
            rows, times = (np.concatenate(column) for column in zip(*self.parts, strict=True))
            if (rows[1:] < rows[:-1]).any():
                order = np.argsort(rows, kind="stable")
                rows, times = rows[order], times[order]
            self.parts, self.ordered = [(rows, times)], True
        return self.parts[0] if self.parts else (NO_ROWS, NO_TIMES)

    def of(self, rows: np.ndarray) -> np.ndarray:
        """Return when each of some rows ended, infinity for those that did not."""
        ended, times = self.all()
        found = np.full(len(rows), np.inf)
        here, places = places_in(ended, rows)
        found[here] = times[places]
        return found


Start = tuple[range | np.ndarray, float | np.ndarray | Moments]


@dataclass
class Starts:
    """Rows and when they start [s from the start of an interval]: known, at one time, or as births are since a time [s]."""

    parts: list[Start]
    since: float = 0.0

    def pieces(self) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield rows and when they start, some at a time, in order."""
        for rows, times in self.parts:
            for start, stop in pieces(0, len(rows)):
                yield numbers_of(rows[start:stop]), self._begin(times, start, stop)

    def _begin(self, times: float | np.ndarray | Moments, start: int, stop: int) -> np.ndarray:
        if isinstance(times, Moments):
            return times.between(start, stop) - self.since
        return times[start:stop] if isinstance(times, np.ndarray) else np.full(stop - start, times)


def places_in(known: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the places of those rows that are known, and of each its place in `known`, which ascends."""
    if not len(known):
        return NO_ROWS, NO_ROWS
    places = np.searchsorted(known, rows)
    here = np.flatnonzero(known[np.minimum(places, len(known) - 1)] == rows)
    return here, places[here]


def index_of(rows: range | np.ndarray) -> slice | np.ndarray:
    """Return what picks some rows of an array: a view of it where they follow one another."""
    return slice(rows.start, rows.stop) if isinstance(rows, range) else rows


def numbers_of(rows: range | np.ndarray) -> np.ndarray:
    """Return rows as an array of their numbers."""
    return np.arange(rows.start, rows.stop) if isinstance(rows, range) else rows
