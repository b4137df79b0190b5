"""Carry particles through times of their own: to their hits, their ends and their next lives."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.nursery import Nursery
from graphfx.cook.particles import Particles, flagged, padded
from graphfx.cook.programs import Programs
from graphfx.cook.spawns import MOST, Occasion, Spawns
from graphfx.errors import CookError, Problem
from graphfx.motion.clock import Interval
from graphfx.motion.events import DIES, HELD, REBORN
from graphfx.plan.hits import HIT_TYPES

MOST_TURNS = 10_000
"""Lives and told hits of one particle within a frame."""
AFTER = 1e-30
"""A particle that goes on from an event at the very start of a frame does not meet that start again [s]."""


@dataclass
class Ends:
    """How far rows came in their own time: their fate, when that was, the last hit, in whole blocks."""

    fate: np.ndarray
    ended: np.ndarray
    hit: dict[str, tuple[np.ndarray, ...]] = field(default_factory=dict)


@dataclass
class Lives:
    """Runs the programs of one's own time, and what follows from them."""

    programs: Programs
    nursery: Nursery
    spawns: Spawns

    def begin(self, particles: Particles, interval: Interval, rows: np.ndarray, begin: np.ndarray) -> None:
        """Tell the births of rows to those who spawn at them."""
        self.spawns.at("birth", particles, interval, Occasion(rows, begin, np.zeros(len(rows)), {}))

    def go_on(self, particles: Particles, interval: Interval, rows: np.ndarray, begin: np.ndarray) -> None:
        """Carry rows from `begin` to the end of the interval, or to their deaths."""
        for _ in range(MOST_TURNS):
            if not len(rows):
                return
            rows, begin = self._turn(particles, interval, rows, begin)
        node = particles.plan.node
        message = (
            f"in frame {interval.frame} particles begin new lives, or hit something, more than {MOST_TURNS:,} times; "
            "give them a longer life, or the surfaces a higher event_speed"
        )
        raise CookError(Problem(message, node.location, f"nodes.{node.path}"))

    def _turn(
        self, particles: Particles, interval: Interval, rows: np.ndarray, begin: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Run to the next event of each row; return the rows that go on after it, and from when."""
        plan = particles.plan
        death = particles.death(rows) - interval.start if plan.mortal else np.full(len(rows), np.inf)
        ends = self._run(particles, interval, rows, begin, np.minimum(death, interval.length))
        held = ends.fate >= HELD
        dies = (ends.fate == DIES) | (ends.fate == HELD + DIES)
        natural = (ends.fate == 0) & (death <= interval.length)
        reborn = (ends.fate == REBORN) | (ends.fate == HELD + REBORN)
        when = np.where(natural, death, ends.ended)
        if held.any():
            self._tell_hits(particles, interval, rows[held], when[held], _kept(ends.hit, held))
        gone = dies | natural | reborn
        going, then = [rows[ends.fate == HELD]], [np.maximum(when[ends.fate == HELD], AFTER)]
        if gone.any():
            renewed = self._die(particles, interval, rows[gone], when[gone])
            again = reborn | natural
            again[gone] &= reborn[gone] | renewed
            self._renew(particles, interval, rows[again], when[again])
            over = gone & ~again
            particles.note_deaths(rows[over], interval.start + when[over])
            going.append(rows[again])
            then.append(when[again])
        return np.concatenate(going), np.concatenate(then)

    def _run(
        self, particles: Particles, interval: Interval, rows: np.ndarray, begin: np.ndarray, end: np.ndarray
    ) -> Ends:
        """Run the program of one's own time from `begin` to `end`."""
        made, real, count = particles.plan.own, self.programs.real, len(rows)
        if made is None:
            return Ends(np.zeros(count), end)
        zeros = padded(np.zeros(count), real)
        by_place: dict[str, Any] = {
            "begin": (padded(begin, real),),
            "end": (padded(end, real),),
            "unfinished": (padded(np.zeros(count), np.uint8),),
            "fate": (zeros.copy(),),
            "ended": (zeros.copy(),),
        }
        for name, type_ in HIT_TYPES.items():
            by_place[f"hit.{name}"] = tuple(zeros.copy() for _ in range(3 if type_ == "vec3" else 1))
        known = made.program.loads.keys() | made.program.stores.keys()
        by_place = {name: arrays for name, arrays in by_place.items() if name in known}
        self.programs.run(made, particles, interval, rows, by_place=by_place)
        if "unfinished" in by_place:
            particles.unfinished += int(by_place["unfinished"][0][:count].sum())
        if "fate" not in by_place:
            return Ends(np.zeros(count), end)
        hit = {name: arrays for name, arrays in by_place.items() if name.startswith("hit.")}
        return Ends(by_place["fate"][0][:count].astype(np.float64), by_place["ended"][0][:count].astype(np.float64), hit)

    def _tell_hits(
        self, particles: Particles, interval: Interval, rows: np.ndarray, when: np.ndarray, hit: dict[str, Any]
    ) -> None:
        numbers = particles.gathered("hits", rows, np.float64)[0][: len(rows)]
        self.spawns.at("hit", particles, interval, Occasion(rows, when, numbers, hit))

    def _die(self, particles: Particles, interval: Interval, rows: np.ndarray, when: np.ndarray) -> np.ndarray:
        """Do what is done at deaths; return which of the rows begin another life if they died of age."""
        made, real = particles.plan.at_death, self.programs.real
        renewed = np.zeros(len(rows), bool)
        if made is not None:
            by_place = {"begin": (padded(when, real),), "renewed": (padded(np.zeros(len(rows)), real),)}
            known = made.program.loads.keys() | made.program.stores.keys()
            self.programs.run(made, particles, interval, rows, by_place={k: v for k, v in by_place.items() if k in known})
            renewed = by_place["renewed"][0][: len(rows)] > 0
        self.spawns.at("death", particles, interval, Occasion(rows, when, np.zeros(len(rows)), {}))
        return renewed

    def _renew(self, particles: Particles, interval: Interval, rows: np.ndarray, when: np.ndarray) -> None:
        if len(rows):
            self.nursery.renew(particles, rows, interval.start + when, interval)
            self.begin(particles, interval, rows, when)

    def leave_trails(self, particles: Particles, interval: Interval, before: int, begin: np.ndarray) -> None:
        """Make children along the paths of all rows; those from `before` on begin within the interval.

        A child's parent is carried to the instant of its birth on a copy, so its path may bend and bounce.
        """
        for spawn in particles.plan.spawns:
            if spawn.rate is None:
                continue
            count = particles.store.count
            since = np.concatenate([np.zeros(before), begin])
            until = np.full(count, interval.length)
            if particles.plan.mortal:
                until = np.minimum(until, particles.death() - interval.start)
            rate = padded(np.zeros(count), self.programs.real)
            given: dict[str, Any] = {"begin": (padded(since, self.programs.real),), "rate": (rate,)}
            given = {name: arrays for name, arrays in given.items() if name in spawn.rate.program.loads or name == "rate"}
            self.programs.run(spawn.rate, particles, interval, np.arange(count), by_place=given)
            self._leave(spawn, particles, interval, since, until, rate[:count].astype(np.float64))

    def _leave(self, spawn: Any, particles: Particles, interval: Interval, since: Any, until: Any, rate: np.ndarray) -> None:
        store = particles.store
        made = store.column(f"made {spawn.path}")[0]
        done = made.copy()
        made += np.nan_to_num(rate, nan=0.0, posinf=float(MOST)) * np.maximum(until - since, 0.0)
        births = np.floor(made) - np.floor(done)
        self.spawns.refuse(spawn, float(births.sum()))
        counts = births.astype(np.int64)
        parents = np.repeat(np.arange(store.count), counts)
        if not len(parents):
            return
        number = np.arange(len(parents)) - np.repeat(np.cumsum(counts) - counts, counts) + 1 + np.floor(done)[parents]
        when = np.clip(since[parents] + (number - done[parents]) / rate[parents], since[parents], until[parents])
        added = store.duplicate(parents)
        copies = np.arange(added.start, added.stop)
        alive = self._carry_copies(particles, interval, copies, since[parents], when)
        self.spawns.make(spawn, particles, interval, Occasion(copies[alive], when[alive], number[alive], {}))
        store.kill(copies)
        store.compact()

    def _carry_copies(self, particles: Particles, interval: Interval, rows: Any, begin: Any, end: np.ndarray) -> np.ndarray:
        """Carry copies of particles to instants; return which are still in the same life then."""
        alive, going = np.ones(len(rows), bool), np.arange(len(rows))
        unfinished = particles.unfinished
        for _ in range(MOST_TURNS):
            if not len(going):
                break
            ends = self._run(particles, interval, rows[going], begin[going], end[going])
            alive[going[(ends.fate > 0) & (ends.fate != HELD)]] = False
            begin = begin.copy()
            begin[going] = np.maximum(ends.ended, AFTER)
            going = going[ends.fate == HELD]
        particles.unfinished = unfinished
        return alive

    def close(self, particles: Particles, interval: Interval) -> None:
        """Do what is set as a frame ends, and end the lives of those who are killed then."""
        made = particles.plan.closing
        assert made is not None
        count = particles.store.count
        kills = "fate" in made.program.stores
        fate = padded(np.zeros(count), self.programs.real)
        rows = np.arange(count)
        self.programs.run(made, particles, interval, rows if kills else None, by_place={"fate": (fate,)} if kills else None)
        if kills:
            ended = np.flatnonzero((fate[:count] > 0) & ~flagged(particles.dying, count))
            when = np.full(len(ended), interval.length)
            self._die(particles, interval, ended, when)
            particles.note_deaths(ended, interval.start + when)


def _kept(hit: dict[str, tuple[np.ndarray, ...]], chosen: np.ndarray) -> dict[str, tuple[np.ndarray, ...]]:
    rows = np.flatnonzero(chosen)
    return {name: tuple(padded(array[rows], array.dtype) for array in arrays) for name, arrays in hit.items()}

