"""Run the programs of a plan over particles: find what each run must be given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.cook.executor import Executor, Job
from graphfx.cook.meshes import Meshes
from graphfx.cook.particles import Particles
from graphfx.motion.clock import Interval, cell_time, cuts_within
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.make import Plan
from graphfx.plan.matrix_motion import find_matrices
from graphfx.plan.pacing import ALLOWED, MOST_TURNS
from graphfx.plan.values import find_step_values

ENGINE_COLUMNS = {"age": "birth"}
"""Names in programs of columns that the store calls otherwise."""


@dataclass
class Programs:
    """Runs programs by an executor."""

    plan: Plan
    executor: Executor
    meshes: Meshes

    @property
    def real(self) -> Any:
        """Return the type of a real."""
        return np.float32 if self.plan.precision == 32 else np.float64

    def prepare(self) -> None:
        """Make all programs ready, so that what is wrong with one shows before any work."""
        selections = [drawn.selection for image in self.plan.images for drawn in image.streams if drawn.selection is not None]
        for made in (*(made for emitter in self.plan.emitters.values() for made in emitter.made_programs), *selections):
            self.meshes.prepare(made)
            self.executor.prepare(made.program)

    def run(
        self,
        made: FrameProgram,
        particles: Particles,
        interval: Interval,
        listed: np.ndarray | None = None,
        excluded: np.ndarray | None = None,
        by_place: Mapping[str, tuple[np.ndarray, ...]] | None = None,
        count: int | None = None,
        turns: int = MOST_TURNS,
    ) -> np.ndarray:
        """Run a program over an interval, on all rows, the first `count`, or those listed; return the rows rejected.

        Of `by_place` those arrays are taken that the program knows. Particles with steps of their own take `turns` of them.
        """
        program, store = made.program, particles.store
        known = program.loads.keys() | program.stores.keys()
        by_place = {name: arrays for name, arrays in (by_place or {}).items() if name in known}
        names = {name: ENGINE_COLUMNS.get(name, name) for name in (*program.loads, *program.stores) if name not in by_place}
        arrays = {name: store.arrays(stored) for name, stored in names.items() if stored in store.columns}
        job = Job(
            count if count is not None else store.count if listed is None else len(listed),
            arrays,
            listed,
            excluded,
            self.uniforms(made, particles, interval, turns),
            by_place,
            interval.start,
        )
        return self.executor.run(program, job)

    def instants(self, particles: Particles, interval: Interval) -> dict[str, float]:
        """Return the instants at which the programs of a frame find places, from the start of an interval [s]."""
        fps = self.plan.flat.time.fps
        return {each.time: max(interval.length - each.back / fps, 0.0) for each in particles.plan.exposure.within}

    def _cuts(self, particles: Particles, interval: Interval) -> dict[str, float]:
        """Return the times at which steps are cut, from the start of an interval [s]; before it where there are fewer."""
        motion = particles.plan.motion
        found = cuts_within(motion.cuts, interval.start, interval.length)
        found += [-1.0] * (motion.most_cuts - len(found))
        return {f"cut {number}": time for number, time in enumerate(found)}

    def uniforms(self, made: FrameProgram, particles: Particles, interval: Interval, turns: int = MOST_TURNS) -> dict[int, Any]:
        """Return the values of a program's uniforms over an interval."""
        substeps = self.plan.flat.time.substeps
        length = interval.length / substeps
        shares = {"start": 0.0, "middle": 0.5, "end": 1.0}
        named = {
            "length": length,
            "half": length / 2,
            **self.instants(particles, interval),
            **self._cuts(particles, interval),
            "frame start": interval.start,
            "frame end": interval.length,
            "frame": interval.frame,
            ALLOWED: turns,
            "frame word": interval.frame & 0xFFFFFFFF,
        }

        def at(name: Any) -> float:
            if isinstance(name, str):
                return named[name]
            return (name[1] + (name[2] / name[3] if name[0] == "part" else shares[name[0]])) * length

        values: dict[int, Any] = {}
        for name, uniform in made.times.items():
            if isinstance(name, tuple) and len(name) == 3:
                kind, k, number = name
                values[id(uniform)] = cell_time(kind, interval.start, k * length, length, number, made.cells)
            else:
                values[id(uniform)] = at(name)
        if made.matrices:
            values |= find_matrices(made, values, lambda k: interval.start + at(("middle", k)), interval.frame, length)
        values |= self.meshes.uniforms(made, interval.start, interval.length, substeps, interval.frame)
        for time, steps in made.steps:
            values |= find_step_values(steps, interval.start + at(time), interval.frame, self.plan.precision)
        return values
