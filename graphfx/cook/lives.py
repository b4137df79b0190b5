"""Carry particles through times of their own: to their hits, their ends and their next lives."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.beginnings import NO_ROWS, NO_TIMES, Starts
from graphfx.cook.bends import bends_of
from graphfx.cook.moments import pieces
from graphfx.cook.nursery import Nursery
from graphfx.cook.particles import Particles, padded, repeated
from graphfx.cook.programs import Programs
from graphfx.cook.rounds import MOST_ROUNDS, count_turns, longest_first, new_room, put_back, taken
from graphfx.cook.spawns import Occasion, Spawns
from graphfx.errors import CookError, Problem
from graphfx.motion.clock import Interval
from graphfx.motion.events import DIES, HELD, REBORN
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.pacing import FIRST_TURNS, SHARE
from graphfx.plan.pacing import MOST_TURNS as MOST_STEPS
from graphfx.plan.spawning import SpawnPlan

MOST_TURNS = 10_000
"""Lives and told hits of one particle within a frame."""


@dataclass
class Ends:
    """How far rows came in their own time: their fate, when that was, how many steps they began, the surface they hit.

    `hit` tells of the last hit, in whole blocks.
    """

    fate: np.ndarray
    ended: np.ndarray
    begun: np.ndarray
    surface: np.ndarray
    hit: dict[str, tuple[np.ndarray, ...]] = field(default_factory=dict)


Going = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Rows, from when they go on [s from the start of the interval], and how many steps of the frame they began."""
NOBODY: Going = NO_ROWS, NO_TIMES, NO_TIMES


@dataclass
class Lives:
    """Runs the programs of one's own time, and what follows from them."""

    programs: Programs
    nursery: Nursery
    spawns: Spawns

    def begin(self, particles: Particles, interval: Interval, starts: Starts) -> None:
        """Tell the births of rows to those who spawn at them."""
        if any(spawn.moment == "birth" for spawn in particles.plan.spawns):
            for rows, begin in starts.pieces():
                self.spawns.at("birth", particles, interval, Occasion(rows, begin, np.zeros(len(rows)), {}))

    def go_on(self, particles: Particles, interval: Interval, starts: Starts) -> None:
        """Carry rows from when they start to the end of the interval, or to their deaths."""
        going = self._turns(particles, interval, ((rows, begin, np.zeros(len(rows))) for rows, begin in starts.pieces()))
        for _ in range(MOST_TURNS - 1):
            if not len(going[0]):
                return
            cut = (tuple(column[start:stop] for column in going) for start, stop in pieces(0, len(going[0])))
            going = self._turns(particles, interval, cut)
        recycles = particles.plan.holder.of_role("recycle")
        node = recycles[0] if recycles else particles.plan.node
        what, way = "hit something", "give the surfaces a higher event_speed"
        if recycles:
            what, way = "begin new lives", "give them a longer life, or the surfaces a higher event_speed"
        message = f"in frame {interval.frame} particles {what} more than {MOST_TURNS:,} times; {way}"
        raise CookError(Problem(message, node.location, f"nodes.{node.path}"))

    def _turns(self, particles: Particles, interval: Interval, cut: Iterable[tuple[np.ndarray, ...]]) -> Going:
        """Run some rows after others to their next events; return who goes on: first who met something, then who lives again."""
        made = [self._turn(particles, interval, *piece) for piece in cut]
        parts = [NOBODY, *(held for held, _ in made), *(again for _, again in made)]
        rows, begin, begun = (np.concatenate(column) for column in zip(*parts, strict=True))
        return rows, begin, begun

    def _turn(
        self, particles: Particles, interval: Interval, rows: np.ndarray, begin: np.ndarray, begun: np.ndarray
    ) -> tuple[Going, Going]:
        """Run to the next event of each row; return the rows that go on after it, from when, and the steps they began.

        First those who met something, then those who live again.
        """
        plan = particles.plan
        death = np.maximum(particles.death(rows) - interval.start, begin) if plan.mortal else np.full(len(rows), np.inf)
        ends = self._run(particles, interval, rows, begin, np.minimum(death, interval.length), begun)
        if not ends.fate.any() and not (death <= interval.length).any():
            return NOBODY, NOBODY
        held = ends.fate >= HELD
        dies = (ends.fate == DIES) | (ends.fate == HELD + DIES)
        natural = (ends.fate == 0) & (death <= interval.length)
        reborn = (ends.fate == REBORN) | (ends.fate == HELD + REBORN)
        when = np.where(natural, death, ends.ended)
        if held.any():
            self._tell_hits(particles, interval, rows, when, ends)
        gone = dies | natural | reborn
        kept = ends.fate == HELD
        held_on, again_from = (rows[kept], when[kept], ends.begun[kept]), NOBODY
        if gone.any():
            renewed = self.die(particles, interval, rows[gone], when[gone])
            again = reborn | natural
            again[gone] &= reborn[gone] | renewed
            self._renew(particles, interval, rows[again], when[again])
            over = gone & ~again
            particles.endings.note(rows[over], interval.start + when[over])
            steps = np.where(reborn, ends.begun, 0.0)  # a condition is looked at once a step
            again_from = rows[again], when[again], steps[again]
        return held_on, again_from

    def _run(
        self,
        particles: Particles,
        interval: Interval,
        rows: np.ndarray,
        begin: np.ndarray,
        end: np.ndarray,
        begun: np.ndarray,
        kept: bool = True,
    ) -> Ends:
        """Run the program of one's own time from `begin` to `end`; `begun` of the frame's steps were begun before.

        Hits on the way are `kept` for pictures.
        """
        made, real, count = particles.plan.own, self.programs.real, len(rows)
        if made is None:
            return Ends(np.zeros(count), end, begun, np.full(count, -1.0))
        by_place = new_room(made.program, count, real)
        by_place |= {"begin": (padded(begin, real),), "end": (padded(end, real),)}
        if "begun" in by_place:
            by_place["begun"][0][:count] = begun
        self._run_rounds(made, particles, interval, rows, by_place, kept)
        if "unfinished" in by_place:
            particles.unfinished += int(by_place["unfinished"][0][:count].sum())
        if "lost" in by_place:
            particles.lost += int(by_place["lost"][0][:count].sum())
        if "fate" not in by_place:
            return Ends(np.zeros(count), end, begun, np.full(count, -1.0))
        hit = {name: arrays for name, arrays in by_place.items() if name.startswith("hit.")}
        told = [by_place[name][0][:count].astype(np.float64) for name in ("fate", "ended", "begun", "surface")]
        return Ends(told[0], told[1], told[2], told[3], hit)

    def _run_rounds(
        self, made: FrameProgram, particles: Particles, interval: Interval, rows: np.ndarray, by_place: dict[str, Any], kept: bool
    ) -> None:
        """Run a program, and again those who wait for another run, gathered with their like, until none waits."""
        store, given, going = particles.store, by_place, rows
        particles.carried += len(rows)
        if "resting" in store.columns:
            particles.carried -= int(np.count_nonzero(store.column("resting")[0][rows]))
        for _ in range(MOST_ROUNDS):
            listed = None if len(going) == store.count and np.array_equal(going, np.arange(store.count)) else going
            turns = FIRST_TURNS if given is by_place else MOST_STEPS
            self.programs.run(made, particles, interval, listed, by_place=given, turns=turns)
            if kept and "knots" in given:
                particles.bends = particles.bends.joined(bends_of(going, interval, given, particles.since))
            if "waiting" not in given:
                return
            count_turns(particles, given, len(going))
            who = np.flatnonzero(given["waiting"][0][: len(going)])
            if given is by_place:
                places = who
            else:
                put_back(by_place, given, places)
                places = places[who]
            if not len(places):
                return
            places = longest_first(places, store.column(SHARE)[0][rows[places]])
            given, going = taken(by_place, places), rows[places]
        particles.failed += len(places)

    def _tell_hits(self, particles: Particles, interval: Interval, rows: np.ndarray, when: np.ndarray, ends: Ends) -> None:
        """Tell each spawn of the hits of the surfaces to which it listens."""
        for spawn in particles.plan.spawns:
            if spawn.moment != "hit":
                continue
            heard = (ends.fate >= HELD) & np.isin(ends.surface, spawn.surfaces)
            if heard.any():
                numbers = particles.gathered("hits", rows[heard], np.float64)[0][: np.count_nonzero(heard)]
                occasion = Occasion(rows[heard], when[heard], numbers, _kept(ends.hit, heard))
                self.spawns.make(spawn, particles, interval, occasion)

    def die(self, particles: Particles, interval: Interval, rows: np.ndarray, when: np.ndarray) -> np.ndarray:
        """Do what is done at deaths; return which of the rows begin another life if they died of age."""
        made, real = particles.plan.at_death, self.programs.real
        renewed = np.zeros(len(rows), bool)
        if made is not None:
            by_place = {"begin": (padded(when, real),), "renewed": (padded(np.zeros(len(rows)), real),)}
            self.programs.run(made, particles, interval, rows, by_place=by_place)
            renewed = by_place["renewed"][0][: len(rows)] > 0
        self.spawns.at("death", particles, interval, Occasion(rows, when, np.zeros(len(rows)), {}))
        return renewed

    def _renew(self, particles: Particles, interval: Interval, rows: np.ndarray, when: np.ndarray) -> None:
        if len(rows):
            particles.end_lives(rows, interval.start + when)
            self.nursery.renew(particles, rows, interval.start + when, interval)
            starts = Starts([(rows, when)])
            self.begin(particles, interval, starts)
            self.leave_trails(particles, interval, starts)

    def leave_trails(self, particles: Particles, interval: Interval, starts: Starts) -> None:
        """Make children along the paths of rows, from the times `since` on to the end of the interval or of their lives.

        A child's parent is carried to the instant of its birth on a copy, so its path may bend and bounce.
        """
        for spawn in particles.plan.spawns:
            if spawn.rate is None:
                continue
            for rows, since in starts.pieces():
                self._leave_trail(spawn, spawn.rate, particles, interval, rows, since)

    def _leave_trail(
        self, spawn: SpawnPlan, made: FrameProgram, particles: Particles, interval: Interval, rows: np.ndarray, since: np.ndarray
    ) -> None:
        real = self.programs.real
        until = np.full(len(rows), interval.length)
        if particles.plan.mortal:
            until = np.clip(particles.death(rows) - interval.start, since, until)
        rate = padded(np.zeros(len(rows)), real)
        given: dict[str, Any] = {"begin": (padded(since, real),), "rate": (rate,)}
        self.programs.run(made, particles, interval, rows, by_place=given)
        steady = np.where(rate > 0, rate, 0.0)[: len(rows)].astype(np.float64)
        self._leave(spawn, particles, interval, rows, since, until, steady)

    def _leave(
        self,
        spawn: SpawnPlan,
        particles: Particles,
        interval: Interval,
        rows: np.ndarray,
        since: np.ndarray,
        until: np.ndarray,
        rate: np.ndarray,
    ) -> None:
        """Make the children of a trail; the k-th of a parent is born where the integral of its rate passes k."""
        store = particles.store
        done = store.column(f"made {spawn.path}")[0][rows]
        with np.errstate(invalid="ignore"):
            made = done + np.where(until > since, rate * (until - since), 0.0)
        self.spawns.refuse(spawn, float(np.sum(made - done)))
        store.column(f"made {spawn.path}")[0][rows] = made
        counts = (np.floor(made) - np.floor(done)).astype(np.int64)
        parents, copies = repeated(counts)
        number = copies + 1 + np.floor(done)[parents]
        when = np.clip(since[parents] + (number - done[parents]) / rate[parents], since[parents], until[parents])
        begin, end = spawn.node.during or (-np.inf, np.inf)
        within = (interval.start + when >= begin) & (interval.start + when < end)
        parents, number, when = parents[within], number[within], when[within]
        if not len(parents):
            return
        added = store.duplicate(rows[parents])
        copies = np.arange(added.start, added.stop)
        alive = self._carry_copies(particles, interval, copies, since[parents], when)
        self.spawns.make(spawn, particles, interval, Occasion(copies[alive], when[alive], number[alive], {}))
        store.kill(copies)
        store.compact()

    def _carry_copies(self, particles: Particles, interval: Interval, rows: Any, begin: Any, end: np.ndarray) -> np.ndarray:
        """Carry copies of particles to instants; return which are still in the same life then."""
        alive, going = np.ones(len(rows), bool), np.arange(len(rows))
        begin, begun, counted = begin.copy(), np.zeros(len(rows)), (particles.unfinished, particles.lost)
        for _ in range(MOST_TURNS):
            if not len(going):
                break
            ends = self._run(particles, interval, rows[going], begin[going], end[going], begun[going], kept=False)
            alive[going[(ends.fate > 0) & (ends.fate != HELD)]] = False
            begin[going], begun[going] = ends.ended, ends.begun
            going = going[ends.fate == HELD]
        particles.unfinished, particles.lost = counted
        if particles.plan.mortal:
            alive &= particles.death(rows) >= interval.start + end
        return alive


def _kept(hit: dict[str, tuple[np.ndarray, ...]], chosen: np.ndarray) -> dict[str, tuple[np.ndarray, ...]]:
    rows = np.flatnonzero(chosen)
    return {name: tuple(padded(array[rows], array.dtype) for array in arrays) for name, arrays in hit.items()}

