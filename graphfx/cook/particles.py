"""The particles of one source, as they are within and at a frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.beginnings import NO_ROWS, Beginnings, Endings, index_of, places_in
from graphfx.cook.births import Births
from graphfx.cook.moments import pieces
from graphfx.plan.make import EmitterPlan
from graphfx.store.processors import BLOCK, ProcessorSet


@dataclass
class Arrivals:
    """Children on their way to a source: made by `maker` at `times` [s], with what their birth reads of parents and hits.

    `order` are the ids of the parents and the numbers of the copies, by which births at one time are ordered.
    """

    maker: str
    times: np.ndarray
    ids: np.ndarray
    given: dict[str, tuple[np.ndarray, ...]]
    order: tuple[np.ndarray, np.ndarray]


@dataclass
class Bends:
    """Hits on the ways of particles: `rows`, `times` [s] and `places` (3, n). A row's own are in order of time."""

    rows: np.ndarray = field(default_factory=lambda: NO_ROWS)
    times: np.ndarray = field(default_factory=lambda: np.zeros(0))
    places: np.ndarray = field(default_factory=lambda: np.zeros((3, 0)))

    def chosen(self, which: np.ndarray, rows: np.ndarray | None = None) -> Bends:
        """Return some of them, `rows` telling the new row of each old one."""
        kept = self.rows[which]
        return Bends(kept if rows is None else rows[kept], self.times[which], self.places[:, which])

    def by_row(self) -> Bends:
        """Return the same, the rows ascending."""
        if (self.rows[1:] >= self.rows[:-1]).all():
            return self
        return self.chosen(np.argsort(self.rows, kind="stable"))

    def between(self, start: int, stop: int) -> Bends:
        """Return those of the rows start ... stop - 1, where the rows ascend."""
        low, high = np.searchsorted(self.rows, (start, stop))
        return Bends(self.rows[low:high], self.times[low:high], self.places[:, low:high])

    def joined(self, others: Bends) -> Bends:
        """Return these and others after them."""
        return Bends(
            np.concatenate([self.rows, others.rows]),
            np.concatenate([self.times, others.times]),
            np.concatenate([self.places, others.places], axis=1),
        )


@dataclass
class Particles:
    """One source's particles.

    `carried` counts particles and frames in which they took steps of their own, those at rest left out, `turns` those
    steps, refused ones too, `failed` those who found none short enough, `unfinished` who met surfaces too often, and `lost`
    the steps not taken, as they lead beyond the numbers.
    `endings` are of the rows whose life ended in the interval before the frame; they are removed as the next begins.
    `beginnings` are of the rows that began a life in it.
    Pictures look back to `since` [s]: `bends` are hits after that, and `past` holds those whose lives ended after it and
    that are gone, or live again; there, all are dying.
    """

    plan: EmitterPlan
    store: ProcessorSet
    births: Births | None
    beginnings: Beginnings = field(default_factory=Beginnings)
    endings: Endings = field(default_factory=Endings)
    unfinished: int = 0
    failed: int = 0
    lost: int = 0
    turns: int = 0
    carried: int = 0
    arrivals: list[Arrivals] = field(default_factory=list)
    seeds: dict[str, np.ndarray] = field(default_factory=dict)
    """The places of the seeds of clusters, by name."""
    since: float = -np.inf
    bends: Bends = field(default_factory=Bends)
    past: Particles | None = None

    @property
    def dying(self) -> np.ndarray:
        """Return the rows whose life ended in the interval, ascending."""
        return self.endings.all()[0]

    @property
    def ended_at(self) -> np.ndarray:
        """Return when the dying ended [s]."""
        return self.endings.all()[1]

    @property
    def alive(self) -> int:
        """Return how many particles live at the frame."""
        return self.store.count - len(self.dying)

    def living(self) -> np.ndarray:
        """Return the rows that live at the frame."""
        rows = np.ones(self.store.count, bool)
        rows[self.dying] = False
        return np.flatnonzero(rows)

    def has(self, name: str) -> bool:
        """Return whether an attribute is known: the plan leaves out what differs and nobody reads."""
        return name in self.store.columns or name in self.plan.constants

    def value(self, name: str) -> Any:
        """Return an attribute: its arrays, or the constant that it is for all."""
        if name in self.store.columns:
            return self.store.column(name)
        return self.plan.constants[name]

    def gathered(self, name: str, rows: np.ndarray, dtype: Any) -> tuple[np.ndarray, ...]:
        """Return an attribute of some rows as arrays of whole blocks."""
        if name in self.store.columns:
            return tuple(padded(array[rows], dtype) for array in self.store.column(name))
        constant = self.plan.constants[name]
        parts = constant if isinstance(constant, tuple) else (constant,)
        return tuple(padded(np.full(len(rows), part), dtype) for part in parts)

    def death(self, rows: Any = slice(None)) -> np.ndarray:
        """Return when particles die of age [s]: all, or those of some rows."""
        if "life" in self.store.columns:
            return self.store.column("birth")[0][rows] + self.store.column("life")[0][rows]
        return self.store.column("birth")[0][rows] + float(self.value("life"))

    def dead_by(self, time: float, count: int) -> np.ndarray:
        """Return which of the first rows die of age until a time [s]."""
        found = [start + np.flatnonzero(self.death(slice(start, stop)) <= time) for start, stop in pieces(0, count)]
        return np.concatenate(found) if found else NO_ROWS

    def begin_frame(self, since: float) -> None:
        """Remove the particles that died before the frame, and hand on the places that pictures need since `since` [s]."""
        self.since = since
        if self.past is not None:
            self.past._forget(self.past.ended_at <= since)
            recent = self.ended_at > since
            self._lay_aside(self.dying[recent], self.ended_at[recent])
            self.past._hand_on()
        self._remove(self.dying)
        self.bends = self.bends.chosen(self.bends.times > since)
        self.beginnings, self.endings = Beginnings(), Endings()
        self._hand_on()

    def _remove(self, dead: np.ndarray) -> None:
        """Remove rows."""
        if not len(dead):
            return
        if len(self.bends.rows):
            alive, rows = self._left(dead)
            self.bends = self.bends.chosen(alive[self.bends.rows], rows)
        self.store.kill(dead)
        self.store.compact()

    def _left(self, dead: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return which rows are left without the dead, and the new row of each."""
        alive = ~flagged(dead, self.store.count)
        return alive, np.cumsum(alive) - 1

    def _forget(self, which: np.ndarray) -> None:
        """Remove some of those that are past, where all are dying."""
        if not which.any():
            return
        self.beginnings = self.beginnings.kept(*self._left(np.flatnonzero(which)))
        self._remove(np.flatnonzero(which))
        self.endings = Endings([(np.arange(self.store.count), self.ended_at[~which])])

    def _hand_on(self) -> None:
        """Let the columns of instants take over what was found a frame before, the earliest first."""
        for instant in reversed(self.plan.exposure.instants):
            if instant.source:
                for target, source in zip(self.store.arrays(instant.column), self.store.arrays(instant.source), strict=True):
                    target[:] = source

    def end_lives(self, rows: np.ndarray, times: np.ndarray) -> None:
        """Keep what pictures show of rows whose lives end at `times` [s] and that live again."""
        if self.past is not None:
            recent = times > self.since
            self._lay_aside(rows[recent], times[recent])

    def _lay_aside(self, rows: np.ndarray, times: np.ndarray) -> None:
        """Put copies of rows whose lives ended at `times` [s] among those that are past."""
        past = self.past
        if past is None or not len(rows):
            return
        added = past.store.allocate(len(rows))
        for name in self.store.columns:
            for target, source in zip(past.store.arrays(name), self.store.arrays(name), strict=True):
                target[added] = source[rows]
        there = np.arange(added.start, added.stop)
        order = np.argsort(rows)
        here, places = places_in(rows[order], self.bends.rows)
        bends = Bends(there[order[places]], self.bends.times[here], self.bends.places[:, here])
        past.bends = past.bends.joined(bends)
        begun = self.beginnings.of(rows)
        late = begun > -np.inf
        past.beginnings.note(there[late], begun[late])
        past.endings = Endings([(np.arange(past.store.count), np.concatenate([past.ended_at, times]))])

    def put_places(self, rows: range | np.ndarray, all_instants: bool = True) -> None:
        """Put the places of rows at all instants, or at those within the frame, where they are."""
        which = index_of(rows)
        for instant in self.plan.exposure.instants if all_instants else self.plan.exposure.within:
            for place, position in zip(self.store.arrays(instant.column), self.store.arrays("position"), strict=True):
                place[which] = position[which]


def flagged(rows: np.ndarray, count: int) -> np.ndarray:
    """Return for each of `count` rows whether it is listed."""
    flags = np.zeros(count, bool)
    flags[rows] = True
    return flags


def repeated(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return for each of sum(counts) copies the place of its original, and its number among that one's copies."""
    places = np.repeat(np.arange(len(counts)), counts)
    return places, np.arange(len(places)) - np.repeat(np.cumsum(counts) - counts, counts)


def blocks(count: int) -> int:
    """Return how many blocks hold so many rows."""
    return (count + BLOCK - 1) // BLOCK


def padded(values: np.ndarray, dtype: Any) -> np.ndarray:
    """Return values in whole blocks, the rest zero."""
    made = np.zeros(blocks(len(values)) * BLOCK, dtype)
    made[: len(values)] = values
    return made
