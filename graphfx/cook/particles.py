"""The particles of one source, as they are within and at a frame."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.births import Births
from graphfx.plan.make import EmitterPlan
from graphfx.store.processors import BLOCK, ProcessorSet

NO_ROWS = np.zeros(0, np.int64)


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
class Particles:
    """One source's particles.

    `dying` are the rows whose life ended in the interval before the frame; they are removed as the next begins.
    `born` are the rows that began a life in it, at the times `born_at`; `ended_at` says when the dying did.
    """

    plan: EmitterPlan
    store: ProcessorSet
    births: Births | None
    dying: np.ndarray = field(default_factory=lambda: NO_ROWS)
    ended_at: np.ndarray = field(default_factory=lambda: np.zeros(0))
    born: np.ndarray = field(default_factory=lambda: NO_ROWS)
    born_at: np.ndarray = field(default_factory=lambda: np.zeros(0))
    unfinished: int = 0
    arrivals: list[Arrivals] = field(default_factory=list)
    seeds: dict[str, np.ndarray] = field(default_factory=dict)
    """The places of the seeds of clusters, by name."""

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

    def remove_dead(self) -> None:
        """Remove the particles that died before the frame, and forget who was born before it."""
        if len(self.dying):
            self.store.kill(self.dying)
            self.store.compact()
        self.dying, self.ended_at = NO_ROWS, np.zeros(0)
        self.born, self.born_at = NO_ROWS, np.zeros(0)

    def note_births(self, rows: np.ndarray, times: np.ndarray) -> None:
        """Note which rows begin a life within the interval, and when; the last beginning counts."""
        if len(self.born):
            kept = ~flagged(rows, self.store.count)[self.born]
            self.born, self.born_at = self.born[kept], self.born_at[kept]
        self.born = np.concatenate([self.born, rows])
        self.born_at = np.concatenate([self.born_at, times])

    def note_deaths(self, rows: np.ndarray, times: np.ndarray) -> None:
        """Note which rows end within the interval, and when."""
        rows, times = np.concatenate([self.dying, rows]), np.concatenate([self.ended_at, times])
        order = np.argsort(rows, kind="stable")
        self.dying, self.ended_at = rows[order], times[order]

    def put_tails(self, rows: np.ndarray) -> None:
        """Put the tails of rows where they are."""
        if "tail" in self.store.columns and len(rows):
            for tail, position in zip(self.store.arrays("tail"), self.store.arrays("position"), strict=True):
                tail[rows] = position[rows]


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
