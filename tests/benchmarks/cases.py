"""The two effects of the simulation benchmark: their graphs on the real engine, and their parameters for the others."""

from __future__ import annotations

import json
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

import graphfx
from graphfx.cook.executor import BlockExecutor, Job
from graphfx.cook.simulate import Simulation
from graphfx.math import Vec3, unit
from graphfx.math.random import counter_of, philox4x32, uniform, word_of
from graphfx.motion.clock import Interval
from graphfx.plan.evaluate import timed_value
from graphfx.program import Draw

HERE = Path(__file__).resolve().parent
BLOCK = 256
FIRST = {"ten_operators": 2, "snow": 12}
"""The frame after which the clock is watched: all are born, and the gust blows."""
SUBSTEPS = {"ten_operators": 4, "snow": 1}
BORN = {"ten_operators": 0.04, "snow": 0.04}
"""Seconds within which all are born."""


class Watched(BlockExecutor):
    """The block machine with a clock on the program of whole steps."""

    seconds = (0.0, 0.0)
    rejected = np.zeros(0, np.int64)

    def run(self, program: Any, job: Job) -> np.ndarray:
        """Run a program and note its CPU and wall time."""
        began = time.process_time(), time.perf_counter()
        result = super().run(program, job)
        if program.name.endswith(": motion"):
            self.seconds = time.process_time() - began[0], time.perf_counter() - began[1]
            self.rejected = result
        return result


class Engine:
    """An effect on graphfx: the real graph, planned and run as `cook` does."""

    def __init__(self, effect: str, particles: int, threads: int):
        graph = json.loads((HERE / f"{effect}.json").read_text())
        next(node for node in graph["nodes"].values() if node["type"] == "emit")["rate"] = particles / BORN[effect]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / f"{effect}.json"
            file.write_text(json.dumps(graph))
            self.plan = graphfx.load(file).plan
        self.effect = effect
        self.executor = Watched(self.plan.precision, threads)
        self.simulation = Simulation(self.plan, self.executor, threads)
        self.particles = next(iter(self.simulation.particles.values()))
        self.intervals = list(self.simulation.clock.intervals(self.plan.flat.time.last))
        for frame in self.simulation.frames(FIRST[effect]):
            self.intervals = [interval for interval in self.intervals if interval.frame > frame]
        self.free = np.ones(self.particles.store.count, bool)
        """Particles that have met nothing while the clock ran."""

    @property
    def upcoming(self) -> Interval:
        """Return the interval that comes next."""
        return self.intervals[0]

    def advance(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Carry the particles over the next interval; return (CPU, wall) seconds of the main program, and of everything."""
        interval = self.intervals.pop(0)
        began = time.process_time(), time.perf_counter()
        self.simulation._advance(self.particles, interval)
        whole = time.process_time() - began[0], time.perf_counter() - began[1]
        self.free[self.executor.rejected] = False
        return self.executor.seconds, whole

    def columns(self) -> list[np.ndarray]:
        """Return copies of the columns in the order of the C side, whole blocks, each at a line of the cache."""
        names = ["position", "velocity", "spiral_axis", *(["tail"] if self.effect == "snow" else ["mass"])]
        arrays = [aligned(array) for name in names for array in self.particles.store.arrays(name)]
        if self.effect == "snow":
            arrays += [aligned(self.speeds()), aligned(self.particles.store.arrays("id")[0])]
            arrays.append(aligned(np.zeros(len(arrays[0]), np.uint8)))
        return arrays

    def speeds(self) -> np.ndarray:
        """Return the turning rates that the snow's particles draw."""
        ids = self.particles.store.arrays("id")[0]
        words = philox4x32([word_of(part) for part in counter_of(ids)], self._key())
        return np.float32(2) + (np.float32(5) - np.float32(2)) * uniform(words[0], np.float32)

    def _key(self) -> tuple[int, int]:
        assert self.particles.plan.main is not None
        return next(step.key for step in self.particles.plan.main.program.walk() if isinstance(step, Draw))

    def parameters(self, interval: Interval) -> np.ndarray:
        """Return the C side's struct for an interval, as float32."""
        substeps = SUBSTEPS[self.effect]
        length = (interval.end - interval.start) / substeps
        middle = interval.start + 0.5 * length
        operators = {node.path.rpartition("fall/")[2]: node for node in self.particles.plan.operators}

        def of(name: str, *wanted: str) -> list[Any]:
            node = operators[name]
            numbers: list[Any] = []
            for parameter in wanted:
                value = node.arguments[parameter]
                found = timed_value(value, middle, interval.frame, 32)
                if value.type == "direction":
                    found = tuple(unit(Vec3(*map(np.float32, found))))
                numbers += found if isinstance(found, tuple) else [found]
            return numbers

        vortex = ("center", "axis", "magnitude", "tightness", "range", "lift")
        response = ("resilience", "friction", "friction_threshold")
        if self.effect == "ten_operators":
            spheres = [number for name in ("bounce_sphere", "second", "third")
                       for number in (0, 0, 0, *of(name, "center", "sphere_radius", *response))]
            plane = [*of("bounce_plane", "normal", "point"), 0, *of("bounce_plane", *response)]
            numbers = [*of("gravity", "acceleration"), *of("damp", "damping"), *of("vortex", *vortex), *of("other", *vortex),
                       *plane, *spheres, length]
            return np.array(numbers, np.float32)
        opening = max(interval.length - self.plan.images[0].window()[1] / self.plan.flat.time.fps, 0.0)
        numbers = [*of("gust/left", *vortex), *of("gust/right", *vortex), *of("bounce_plane", "point", "normal"), 2, 5,
                   length, length / 2, 0, length, opening]
        return np.concatenate([np.array(numbers, np.float32), np.array(self._key(), np.uint32).view(np.float32)])


def aligned(values: np.ndarray) -> np.ndarray:
    """Return a copy in whole blocks that begins at a line of the cache."""
    count = (len(values) + BLOCK - 1) // BLOCK * BLOCK
    room = np.zeros(count * values.itemsize + 64, np.uint8)
    begin = -room.ctypes.data % 64
    copy = room[begin : begin + count * values.itemsize].view(values.dtype)
    copy[: len(values)] = values
    return copy


__all__ = ["BLOCK", "FIRST", "SUBSTEPS", "Engine", "aligned"]
