"""Simulate: carry the particles of a plan from frame to frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.births import Births
from graphfx.cook.executor import Executor, Job
from graphfx.cook.meshes import Meshes
from graphfx.motion.clock import Clock, Interval, cell_time
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.make import EmitterPlan, Plan
from graphfx.plan.values import find_step_values
from graphfx.store.processors import BLOCK, Column, ProcessorSet


@dataclass
class Particles:
    """One emitter's particles as they are at a frame.

    `dying` are the rows whose life ended in the interval before it; they are removed as the next begins.
    `share` is the part of the shutter for which each of `partial` lived.
    """

    plan: EmitterPlan
    store: ProcessorSet
    births: Births
    dying: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    born: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    born_at: np.ndarray = field(default_factory=lambda: np.zeros(0))
    unfinished: int = 0

    @property
    def alive(self) -> int:
        """Return how many particles live at the frame."""
        return self.store.count - len(self.dying)

    def living(self) -> np.ndarray:
        """Return the rows that live at the frame."""
        rows = np.ones(self.store.count, bool)
        rows[self.dying] = False
        return np.flatnonzero(rows)

    def value(self, name: str) -> Any:
        """Return an attribute: its arrays, or the constant that it is for all."""
        if name in self.store.columns:
            return self.store.column(name)
        return self.plan.constants[name]

    def death(self) -> np.ndarray:
        """Return when each particle dies [s]."""
        life = self.store.column("life")[0].astype(np.float64) if "life" in self.store.columns else float(self.value("life"))
        return self.store.column("birth")[0] + life


class Simulation:
    """All particles of a plan, carried on a frame at a time."""

    def __init__(self, plan: Plan, executor: Executor, threads: int = 1, limit_particles: int | None = None):
        time = plan.flat.time
        self.plan = plan
        self.executor = executor
        self.meshes = Meshes(plan.flat)
        self.clock = Clock(time.fps, time.first, time.preroll)
        self.particles = {
            path: Particles(
                emitter,
                ProcessorSet(
                    {name: Column(type_) for name, type_ in emitter.attributes.columns.items()},
                    plan.precision,
                    limit_particles,
                    threads,
                ),
                Births(emitter, self.clock.start),
            )
            for path, emitter in plan.emitters.items()
        }

    def frames(self, last: int) -> Iterator[int]:
        """Simulate up to frame `last`, yielding each frame's number from the first on."""
        for emitter in self.plan.emitters.values():
            for made in (emitter.birth, emitter.main, emitter.own):
                if made is not None:
                    self.meshes.prepare(made)
            for program in emitter.programs:
                self.executor.prepare(program)
        beginning = Interval(self.clock.start, self.clock.start, self.clock.first)
        for particles in self.particles.values():
            self._give_birth(particles, particles.births.at_start(), beginning)
        if self.clock.preroll == 0 and last >= self.clock.first:
            yield self.clock.first
        for interval in self.clock.intervals(last):
            for particles in self.particles.values():
                self._advance(particles, interval)
            if interval.frame >= self.clock.first:
                yield interval.frame

    def _give_birth(self, particles: Particles, times: np.ndarray, interval: Interval) -> None:
        """Add rows for the particles born at `times` and find their attributes."""
        store, plan = particles.store, particles.plan
        first = store.take_ordinals(len(times))
        added = store.allocate(len(times))
        particles.born = np.arange(added.start, added.stop, dtype=np.int64)
        particles.born_at = times
        if not len(times):
            return
        ordinals = np.arange(first, first + len(times), dtype=np.uint64)
        if "id" in store.columns:
            store.arrays("id")[0][added] = ordinals
        if "birth" in store.columns:
            store.arrays("birth")[0][added] = times
        by_place = {"birth_id": (_padded(ordinals, np.uint64),), "birth_time": (_padded(times, self._real),)}
        self._run(plan.birth, particles, interval, len(times), listed=particles.born, by_place=by_place)
        if "tail" in store.columns:
            for tail, position in zip(store.arrays("tail"), store.arrays("position"), strict=True):
                tail[added] = position[added]

    @property
    def _real(self) -> Any:
        return np.float32 if self.plan.precision == 32 else np.float64

    def _run(self, made: FrameProgram, particles: Particles, interval: Interval, count: int, **given: Any) -> np.ndarray:
        """Run a program over an interval; what is given besides is as in `Job`. Return the rows rejected."""
        program, store = made.program, particles.store
        names = {"birth" if name == "age" else name: name for name in (*program.loads, *program.stores)}
        arrays = {name: store.arrays(stored) for stored, name in names.items() if stored in store.columns}
        job = Job(count, arrays, uniforms=self._uniforms(made, interval), now=interval.start, **given)
        return self.executor.run(program, job)

    def _advance(self, particles: Particles, interval: Interval) -> None:
        """Carry one emitter's particles over an interval: births, whole steps, then those with times of their own."""
        store, plan = particles.store, particles.plan
        if len(particles.dying):
            store.kill(particles.dying)
            store.compact()
        before = store.count
        self._give_birth(particles, particles.births.within(interval), interval)
        death = particles.death() if plan.mortal else None
        particles.dying = np.flatnonzero(death <= interval.end) if death is not None else np.zeros(0, np.int64)
        if plan.main is None or plan.own is None:
            return
        dying = particles.dying[particles.dying < before]
        if interval.length * self.clock.fps > 1 - 1e-9:
            rejected = self._run(plan.main, particles, interval, before, excluded=dying)
        else:  # a shorter interval begins the preroll; the shutter opens in another of its steps than is usual
            rejected = np.arange(before)
        listed = np.concatenate([np.union1d(dying, rejected), particles.born]).astype(np.int64)
        if len(listed):
            self._own_time(particles, interval, listed, before, death)

    def _own_time(
        self, particles: Particles, interval: Interval, listed: np.ndarray, before: int, death: np.ndarray | None
    ) -> None:
        plan = particles.plan
        assert plan.own is not None
        begin, end = np.zeros(len(listed)), np.full(len(listed), interval.length)
        newborn = listed >= before
        begin[newborn] = particles.born_at[listed[newborn] - before] - interval.start
        if death is not None:
            end = np.minimum(end, death[listed] - interval.start)
        unfinished = np.zeros(_blocks(len(listed)) * BLOCK, np.uint8)
        by_place = {"begin": (_padded(begin, self._real),), "end": (_padded(end, self._real),), "unfinished": (unfinished,)}
        self._run(plan.own, particles, interval, len(listed), listed=listed, by_place=by_place)
        particles.unfinished += int(unfinished[: len(listed)].sum())

    def _uniforms(self, made: FrameProgram, interval: Interval) -> dict[int, Any]:
        """Return the values of a program's uniforms over an interval."""
        substeps = self.plan.flat.time.substeps
        length = interval.length / substeps
        opening = max(interval.length - self.plan.shutter / self.plan.flat.time.fps, 0.0)
        values: dict[int, Any] = {}
        for name, uniform in made.times.items():
            if isinstance(name, tuple) and name[0].startswith("cell"):
                kind, k, number = name
                values[id(uniform)] = cell_time(kind, interval.start, k * length, length, number, made.cells)
            elif isinstance(name, tuple):
                kind, k = name
                values[id(uniform)] = {
                    "start": k * length,
                    "end": (k + 1) * length,
                    "middle": (k + 0.5) * length,
                }[kind]
            else:
                values[id(uniform)] = {
                    "length": length,
                    "half": length / 2,
                    "opening": opening,
                    "frame start": interval.start,
                    "frame": interval.frame,
                    "frame word": interval.frame & 0xFFFFFFFF,
                }[name]
        values |= self.meshes.uniforms(made, interval.start, interval.length, substeps, interval.frame)
        for k, steps in enumerate(made.steps):
            values |= find_step_values(steps, interval.start + (k + 0.5) * length, interval.frame, self.plan.precision)
        return values


def _blocks(count: int) -> int:
    return (count + BLOCK - 1) // BLOCK


def _padded(values: np.ndarray, dtype: Any) -> np.ndarray:
    """Return values in whole blocks, the rest zero."""
    padded = np.zeros(_blocks(len(values)) * BLOCK, dtype)
    padded[: len(values)] = values
    return padded
