"""Give particles their attributes at birth, and again when they begin another life."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.cook.beginnings import NO_ROWS, index_of, numbers_of
from graphfx.cook.moments import Moments, pieces
from graphfx.cook.particles import Arrivals, Particles, padded
from graphfx.cook.programs import Programs
from graphfx.cook.sample import Sample
from graphfx.lanes.compile import compiled
from graphfx.math.random import key_of
from graphfx.motion.clock import Interval
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.rounding import REMAINDER
from graphfx.store.threads import parallel

SEED_ID = 1 << 62
"""Seeds of clusters draw as particles of ids from here on, which none has; those of each cluster as others."""
PIECE = 4096


@dataclass
class Nursery:
    """Adds rows for new particles and runs the programs of births."""

    programs: Programs
    sample: Sample | None = None

    def bear(self, particles: Particles, times: Moments, interval: Interval) -> tuple[range, Moments]:
        """Add the particles that an emitter makes at `times`, as far as they are simulated, some at a time.

        Return their rows and times.
        """
        path, store, first = particles.plan.path, particles.store, particles.store.take_ordinals(len(times))
        chosen = self.sample.births(path, first, len(times)) if self.sample is not None and path in self.sample.ordinals else None
        if chosen is not None:
            times = times.chosen(chosen)
        if not len(times):
            return range(0), times
        added = store.allocate(len(times))
        for start, stop in pieces(0, len(times)):
            places = np.arange(start, stop) if chosen is None else chosen[start:stop]
            ids = (places + first).astype(np.uint64)
            rows = range(added.start + start, added.start + stop)
            self._name(particles, rows, ids)
            self._give(particles, path, rows, times.between(start, stop), ids, interval, {})
        born = range(added.start, added.stop)
        particles.beginnings.note(born, times)
        return born, times

    def receive(self, particles: Particles, interval: Interval) -> tuple[np.ndarray, np.ndarray]:
        """Add the children that have arrived, in order of time, parent and copy; return their rows and when they begin."""
        waiting, particles.arrivals = particles.arrivals, []
        rows, begins = [NO_ROWS], [np.zeros(0)]
        for maker in dict.fromkeys(arrivals.maker for arrivals in waiting):
            batch = _merged([arrivals for arrivals in waiting if arrivals.maker == maker])
            added = particles.store.allocate(len(batch.times))
            rows.append(np.arange(added.start, added.stop))
            self._name(particles, rows[-1], batch.ids)
            self._give(particles, maker, rows[-1], batch.times, batch.ids, interval, batch.given)
            particles.beginnings.note(rows[-1], batch.times)
            begins.append(np.maximum(batch.times - interval.start, 0.0))
        return np.concatenate(rows), np.concatenate(begins)

    def renew(self, particles: Particles, rows: np.ndarray, times: np.ndarray, interval: Interval) -> None:
        """Begin another life of particles."""
        store = particles.store
        for name in ("resting", REMAINDER, *(f"made {spawn.path}" for spawn in particles.plan.spawns)):
            for part in store.arrays(name) if name in store.columns else ():
                part[rows] = 0
        lives = particles.gathered("lives", rows, self.programs.real)[0]
        given: dict[str, tuple[np.ndarray, ...]] = {"number lives": (lives + self.programs.real(1),)}
        given |= {
            f"number {name}": particles.gathered(name, rows, self.programs.real)
            for name in particles.plan.holder.clusters
            if name in store.columns
        }
        ids = store.column("id")[0][rows]
        self._give(particles, particles.plan.path, rows, times, ids, interval, given)
        particles.beginnings.note(rows, times)

    @staticmethod
    def _name(particles: Particles, rows: range | np.ndarray, ids: np.ndarray) -> None:
        if "id" in particles.store.columns:
            particles.store.arrays("id")[0][index_of(rows)] = ids

    def _give(
        self,
        particles: Particles,
        maker: str,
        rows: range | np.ndarray,
        times: np.ndarray,
        ids: np.ndarray,
        interval: Interval,
        given: dict[str, tuple[np.ndarray, ...]],
    ) -> None:
        """Find the attributes of rows that begin a life at `times`."""
        store, real = particles.store, self.programs.real
        if "birth" in store.columns:
            store.arrays("birth")[0][index_of(rows)] = times
        made = particles.plan.births[maker]
        by_place: dict[str, tuple[np.ndarray, ...]] = {
            "birth_id": (padded(ids, np.uint64),),
            "birth_time": (padded(times, real),),
            "number lives": (padded(np.zeros(len(rows)), real),),
        }
        by_place |= given
        for name in particles.plan.holder.clusters:
            if f"number {name}" in made.program.loads and f"number {name}" not in given:
                by_place[f"number {name}"] = (padded(self._numbers(particles, name, by_place, interval, len(rows)), real),)
        self.programs.run(made, particles, interval, numbers_of(rows), by_place=by_place)
        particles.put_places(rows)

    def _numbers(self, particles: Particles, name: str, by_place: dict[str, Any], interval: Interval, count: int) -> np.ndarray:
        """Return the numbers of new particles in a cluster."""
        cluster = particles.plan.holder.clusters[name]
        if cluster.by == "turn":
            return by_place["birth_id"][0][:count] % np.uint64(cluster.count)
        made = particles.plan.seeds
        assert made is not None
        if name not in particles.seeds:
            many, real = cluster.count, self.programs.real
            given = {
                "birth_id": (padded(np.arange(many, dtype=np.uint64) + np.uint64(SEED_ID + (key_of(name)[0] << 28)), np.uint64),),
                "birth_time": (padded(np.full(many, interval.start), real),),
                "number lives": (padded(np.zeros(many), real),),
            }
            particles.seeds[name] = self._positions(made, particles, interval, many, given)
        given = {known: by_place[known] for known in ("birth_id", "birth_time", "number lives")}
        places = self._positions(made, particles, interval, count, given)
        return nearest(places, particles.seeds[name], particles.store.threads)

    def _positions(
        self, made: FrameProgram, particles: Particles, interval: Interval, count: int, given: dict[str, Any]
    ) -> np.ndarray:
        """Return where the emitter's distribution puts particles, (count, 3)."""
        place = tuple(padded(np.zeros(count), self.programs.real) for _ in range(3))
        self.programs.run(made, particles, interval, np.arange(count), by_place=given | {"position": place})
        return np.stack([part[:count] for part in place], axis=1).astype(np.float64)


def _merged(batches: list[Arrivals]) -> Arrivals:
    """Return several arrivals of one maker as one, by time, then parent, then copy."""
    times = np.concatenate([batch.times for batch in batches])
    parents, copies = (np.concatenate([batch.order[k] for batch in batches]) for k in range(2))
    order = np.lexsort((copies, parents, times))
    counts = [len(batch.times) for batch in batches]

    def joined(name: str, k: int) -> np.ndarray:
        parts = [batch.given[name][k][:count] for batch, count in zip(batches, counts, strict=True)]
        return padded(np.concatenate(parts)[order], parts[0].dtype)

    given = {name: tuple(joined(name, k) for k in range(len(arrays))) for name, arrays in batches[0].given.items()}
    ids = np.concatenate([batch.ids for batch in batches])[order]
    return Arrivals(batches[0].maker, times[order], ids, given, (parents[order], copies[order]))


@compiled
def _nearest(places, seeds, first, last, found):
    for i in range(first, last):
        best = np.inf
        for k in range(len(seeds)):
            x, y, z = places[i, 0] - seeds[k, 0], places[i, 1] - seeds[k, 1], places[i, 2] - seeds[k, 2]
            distance = x * x + y * y + z * z
            if distance < best:
                best = distance
                found[i] = k


def nearest(places: np.ndarray, seeds: np.ndarray, threads: int = 1) -> np.ndarray:
    """Return the number of the nearest seed to each place; of equals the least. Both are (n, 3) float64."""
    found = np.zeros(len(places), np.int64)

    def piece(number: int) -> None:
        _nearest(places, seeds, number * PIECE, min((number + 1) * PIECE, len(places)), found)

    parallel(piece, (len(places) + PIECE - 1) // PIECE, threads)
    return found
