"""Make children of particles: at their births, hits and deaths, and along their paths."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.cook.particles import Arrivals, Particles, padded, repeated
from graphfx.cook.programs import Programs
from graphfx.cook.sample import Sample
from graphfx.errors import LimitError, Problem
from graphfx.math.random import key_of, spawned_id
from graphfx.motion.clock import Interval
from graphfx.plan.spawning import SpawnPlan

MOST = 1 << 30
"""Particles of one source, whatever the limit."""
BYTES_ON_THE_WAY = 300
"""What a child takes, about, until it has arrived."""


def memory() -> int:
    """Return the bytes of memory that the machine has; without end where that is not told."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return 1 << 62


@dataclass
class Occasion:
    """What children are made of: rows of parents, when it befell them (from the start of the interval, in seconds).

    `numbers` tell the events of one life apart. `hit` are the arrays of hit.normal and so on, in whole blocks.
    """

    rows: np.ndarray
    begin: np.ndarray
    numbers: np.ndarray
    hit: dict[str, tuple[np.ndarray, ...]]


@dataclass
class Spawns:
    """Finds how many children there are, and sends them on their way."""

    programs: Programs
    particles: dict[str, Particles]
    limit: int | None = None
    """Particles alive at once, of one source."""
    sample: Sample | None = None

    def at(self, moment: str, parents: Particles, interval: Interval, occasion: Occasion) -> None:
        """Let all spawns that wait for a moment make their children."""
        if not len(occasion.rows):
            return
        for spawn in parents.plan.spawns:
            if spawn.moment == moment:
                self.make(spawn, parents, interval, occasion)

    def make(self, spawn: SpawnPlan, parents: Particles, interval: Interval, occasion: Occasion) -> None:
        """Make one spawn's children; they arrive at its home."""
        real, count = self.programs.real, len(occasion.rows)
        offspring = padded(np.zeros(count), real)
        by_place: dict[str, Any] = {
            "begin": (padded(occasion.begin, real),),
            "event": (padded(occasion.numbers, real),),
            "offspring": (offspring,),
        } | occasion.hit
        self.programs.run(spawn.offspring, parents, interval, occasion.rows, by_place=by_place)
        counts = self._counts(spawn, offspring[:count], parents, occasion.rows)
        if counts.any():
            self._send(spawn, parents, interval, occasion, counts)

    def _counts(self, spawn: SpawnPlan, offspring: np.ndarray, parents: Particles, rows: np.ndarray) -> np.ndarray:
        """Return how many children each parent has."""
        offspring = np.nan_to_num(offspring, nan=0.0, posinf=float(MOST))
        if np.isfinite(spawn.generations):
            offspring[self._generation(parents, rows) + 1 > spawn.generations] = 0.0
        self.refuse(spawn, float(offspring.sum(dtype=np.float64)))
        return offspring.astype(np.int64)

    def refuse(self, spawn: SpawnPlan, made: float) -> None:
        """Raise LimitError where so many more children of a spawn would not fit."""
        home = self.particles[spawn.home]
        waiting = sum(len(arrivals.times) for arrivals in home.arrivals)
        total, limit = home.store.count + waiting + made, min(self.limit or MOST, MOST)
        needed = (waiting + made) * BYTES_ON_THE_WAY
        if total > limit or needed > memory() / 2:
            what = f"the limit is {limit:,}" if total > limit else f"{needed / 2**30:,.0f} GiB would be needed"
            message = (
                f"{total:,.0f} particles would be alive at once, and {what}; lower its count, its rate, its probability or its "
                "generations" + (", or allow more with --limit-particles" if total > limit else "")
            )
            raise LimitError(Problem(message, spawn.node.location, f"nodes.{spawn.path}"))

    @staticmethod
    def _generation(parents: Particles, rows: np.ndarray) -> np.ndarray:
        return parents.gathered("generation", rows, np.float64)[0][: len(rows)]

    def _send(
        self, spawn: SpawnPlan, parents: Particles, interval: Interval, occasion: Occasion, counts: np.ndarray
    ) -> None:
        places, copies = repeated(counts)
        home = self.particles[spawn.home]
        made = self._ids(spawn, parents, occasion, places, copies)
        if self.sample is not None:
            kept = self.sample.children(spawn.home, made)
            places, copies, made = places[kept], copies[kept], made[kept]
            if not len(made):
                return
        rows = occasion.rows[places]
        ids = parents.store.column("id")[0][rows]
        times = interval.start + occasion.begin[places]
        given = {}
        for name in home.plan.births[spawn.path].program.loads:
            if name.startswith("hit."):
                given[name] = tuple(padded(array[places], array.dtype) for array in occasion.hit[name])
            elif name.startswith("parent."):
                given[name] = self._of_parent(name[7:], parents, rows, times)
            elif name.startswith("number ") and name[7:] in parents.store.columns and name != "number lives":
                given[name] = parents.gathered(name[7:], rows, self.programs.real)
        home.arrivals.append(Arrivals(spawn.path, times, made, given, (ids, copies)))

    @staticmethod
    def _ids(
        spawn: SpawnPlan, parents: Particles, occasion: Occasion, places: np.ndarray, copies: np.ndarray
    ) -> np.ndarray:
        """Return the ids of children: the `copies`-th of the parents at `places` of the occasion."""
        rows = occasion.rows[places]
        lives = (
            parents.store.column("lives")[0][rows].astype(np.uint64)
            if "lives" in parents.store.columns
            else np.zeros(len(rows), np.uint64)
        )
        low, high = key_of(spawn.parents, spawn.node.seed)
        own = parents.store.column("id")[0][rows] ^ np.uint64(low | high << 32)
        events = occasion.numbers[places].astype(np.uint64)
        return np.asarray(spawned_id(own, lives, events, copies.astype(np.uint64)), np.uint64)

    def _of_parent(self, name: str, parents: Particles, rows: np.ndarray, times: np.ndarray) -> tuple[np.ndarray, ...]:
        real = self.programs.real
        if name in ("age", "normalized_age"):
            age = times - parents.store.column("birth")[0][rows]
            if name == "normalized_age":
                age = np.fmin(age / parents.gathered("life", rows, np.float64)[0][: len(rows)], 1.0)
            return (padded(age, real),)
        return parents.gathered(name, rows, real)
