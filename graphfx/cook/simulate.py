"""Simulate: carry the particles of a plan from frame to frame.

Within a frame each source goes once: births, trails, whole steps, then its particles with times of their
own. What is spawned on the way arrives at its source before that one's turn, or in a further round.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graphfx.cook.beginnings import NO_ROWS, Start, Starts
from graphfx.cook.births import Births
from graphfx.cook.closing import close
from graphfx.cook.executor import Executor
from graphfx.cook.lives import Lives
from graphfx.cook.meshes import Meshes
from graphfx.cook.moments import moments, pieces
from graphfx.cook.nursery import Nursery
from graphfx.cook.particles import Particles, flagged, padded
from graphfx.cook.polygons import PolygonMaker
from graphfx.cook.programs import Programs
from graphfx.cook.sample import Sample
from graphfx.cook.spawns import Spawns
from graphfx.errors import CookError, Problem
from graphfx.motion.clock import Clock, Interval, cuts_within
from graphfx.plan.make import EmitterPlan, Plan
from graphfx.store.processors import Column, ProcessorSet

MOST_ROUNDS = 1000
"""Rounds of spawning within one frame; a chain of events that goes on is stopped with a message."""


class Simulation:
    """All particles of a plan, or a sample of them, carried on a frame at a time."""

    def __init__(
        self,
        plan: Plan,
        executor: Executor,
        threads: int = 1,
        limit_particles: int | None = None,
        sample: Sample | None = None,
    ):
        time = plan.flat.time
        self.plan = plan
        self.clock = Clock(time.fps, time.first, time.preroll)
        meshes = Meshes(plan.flat)
        self.polygons = PolygonMaker(meshes)
        self.programs = Programs(plan, executor, meshes)
        self.particles: dict[str, Particles] = {}
        for path, emitter in plan.emitters.items():
            columns = {name: Column(type_) for name, type_ in emitter.attributes.columns.items()}
            store = ProcessorSet(columns, plan.precision, limit_particles, threads)
            self.particles[path] = Particles(emitter, store, self._births(emitter, meshes))
            if emitter.exposure.reach > 0:
                past = ProcessorSet(columns, plan.precision, None, threads)
                self.particles[path].past = Particles(emitter, past, None)
        self.interval = Interval(self.clock.start, self.clock.start, self.clock.beginning)
        """The time that was simulated last."""
        self.nursery = Nursery(self.programs, sample)
        self.spawns = Spawns(self.programs, self.particles, limit_particles, sample)
        self.lives = Lives(self.programs, self.nursery, self.spawns)

    def _births(self, emitter: EmitterPlan, meshes: Meshes) -> Births | None:
        """Return when an emitter's particles are born; a spawn has no such times."""
        if emitter.node.node_type.role != "emit":
            return None
        mesh = emitter.node.references.get("vertices")
        return Births(emitter, self.clock.start, meshes.vertices(mesh) if mesh else 0)

    def frames(self, last: int) -> Iterator[int]:
        """Simulate up to frame `last`, yielding each frame's number from the first on."""
        self.programs.prepare()
        self.polygons.prepare(self.plan.images)
        beginning = self.interval
        for particles in self.particles.values():
            if particles.births is not None:
                born, times = self.nursery.bear(particles, particles.births.at_start(), beginning)
                self.lives.begin(particles, beginning, Starts([(born, times)], beginning.start))
            self._arrive(particles, beginning)
        self._settle(beginning)
        if self.clock.preroll == 0 and last >= self.clock.first:
            yield self.clock.first
        for interval in self.clock.intervals(last):
            self.interval = interval
            for particles in self.particles.values():
                self._advance(particles, interval)
            self._settle(interval)
            if interval.frame >= self.clock.first:
                yield interval.frame

    def _settle(self, interval: Interval) -> None:
        """Let arrive what was spawned, until there is no more; then do what is done as the frame ends."""
        closed, maker = dict.fromkeys(self.particles, 0), ""
        for _ in range(MOST_ROUNDS):
            waiting = [particles for particles in self.particles.values() if particles.arrivals]
            maker = waiting[0].arrivals[0].maker if waiting else maker
            for particles in waiting:
                self._arrive(particles, interval)
            if waiting:
                continue
            unclosed = [path for path, particles in self.particles.items() if particles.store.count > closed[path]]
            for path in unclosed:
                first, closed[path] = closed[path], self.particles[path].store.count
                self._close(self.particles[path], interval, first)
            if not unclosed:
                return
        node = self.plan.flat.nodes[maker]
        message = (
            f"in frame {interval.frame} spawns follow one another without end; it was stopped after {MOST_ROUNDS:,} rounds; "
            "lower its generations, or its probability"
        )
        raise CookError(Problem(message, node.location, f"nodes.{node.path}"))

    def _arrive(self, particles: Particles, interval: Interval) -> None:
        rows, begin = self.nursery.receive(particles, interval)
        if len(rows):
            starts = Starts([(rows, begin)])
            self.lives.begin(particles, interval, starts)
            self.lives.leave_trails(particles, interval, starts)
            self.lives.go_on(particles, interval, starts)

    def _advance(self, particles: Particles, interval: Interval) -> None:
        """Carry one source's particles over an interval."""
        store, plan = particles.store, particles.plan
        particles.begin_frame(interval.end - plan.exposure.reach / self.clock.fps)
        before = store.count
        times = particles.births.within(interval) if particles.births is not None else moments()
        born, times = self.nursery.bear(particles, times, interval)
        self.lives.begin(particles, interval, Starts([(born, times)], interval.start))
        arrived, arrived_begin = self.nursery.receive(particles, interval)
        self.lives.begin(particles, interval, Starts([(arrived, arrived_begin)]))
        dying = particles.dead_by(interval.end, before) if plan.mortal else NO_ROWS
        new: list[Start] = [(born, times), (arrived, arrived_begin)]
        self.lives.leave_trails(particles, interval, Starts([(range(before), 0.0), *new], interval.start))
        old = self._carry(particles, interval, before, dying)
        particles.put_places(old, all_instants=False)
        self.lives.go_on(particles, interval, Starts([(old, 0.0), *new], interval.start))

    def _carry(self, particles: Particles, interval: Interval, before: int, dying: np.ndarray) -> range | np.ndarray:
        """Carry the rows before a number over whole steps; return those, the dying too, that need times of their own."""
        main, rejected = particles.plan.main, NO_ROWS
        if main is None and particles.plan.own is not None:
            return range(before)
        if main is not None:
            if interval.length * self.clock.fps <= 1 - 1e-9:
                return range(before)  # it begins the preroll; the shutter opens in another of its steps than is usual
            if cuts_within(particles.plan.motion.cuts, interval.start, interval.length):
                return range(before)
            rejected = self.programs.run(main, particles, interval, excluded=dying, count=before)
        if not len(rejected) or not len(dying):
            return dying if len(dying) else rejected
        either = flagged(dying, before)
        either[rejected] = True
        return np.flatnonzero(either)

    def _close(self, particles: Particles, interval: Interval, first: int) -> None:
        """Do what is done with rows from `first` on as the frame ends: places at instants, what is set, who is killed."""
        plan = particles.plan
        instants = self.programs.instants(particles, interval)
        for instant in plan.exposure.within if plan.places else []:
            at_instant, at_birth = plan.places[instant.column]
            if plan.main is None or instant.column not in plan.main.program.stores:
                particles.put_places(range(first, particles.store.count), all_instants=False)
            if not first:
                self.programs.run(at_instant, particles, interval)
            for start, stop in pieces(first, particles.store.count) if first or particles.beginnings.some else ():
                rows = np.arange(start, stop)
                if first:
                    self.programs.run(at_instant, particles, interval, rows)
                born = particles.beginnings.of(rows) - interval.start
                late = born > instants[instant.time]
                begin = padded(born[late], self.programs.real)
                self.programs.run(at_birth, particles, interval, rows[late], by_place={"begin": (begin,)})
        if plan.closing is not None:
            close(self.lives, particles, interval, first)
