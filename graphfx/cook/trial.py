"""Simulate a graph under other time settings, without pictures, for some of its particles: what a method does to them.

Particles are told apart by (source, id, life), which no method changes.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from graphfx.cook.births import Births
from graphfx.cook.executor import BlockExecutor
from graphfx.cook.particles import Particles
from graphfx.cook.sample import Census, Sample, ordinals_of
from graphfx.cook.simulate import Simulation
from graphfx.graph.flat import FlatGraph
from graphfx.motion.clock import Clock
from graphfx.plan.make import Plan, make_plan
from graphfx.plan.method import Choice

MEASURED = ("id", "lives", "position", "velocity")


@dataclass
class States:
    """The particles of one source at one frame: ids, numbers of lives, positions [m] and velocities [m/s], (n, 3) float64."""

    ids: np.ndarray
    lives: np.ndarray
    position: np.ndarray
    velocity: np.ndarray

    def __len__(self) -> int:
        """Return how many particles there are."""
        return len(self.ids)


@dataclass
class Trial:
    """What came of a simulation: `states` by source and frame, and the `seconds` of processor time that it took.

    All preparation is done before, and taking the states is not counted.

    `evaluations` are force evaluations of each moving particle in each frame, on average; `restless` counts contacts that were
    given up.
    """

    states: dict[str, dict[int, States]] = field(default_factory=dict)
    seconds: float = 0.0
    evaluations: float = 0.0
    work: dict[str, float] = field(default_factory=dict)
    """Evaluations by source."""
    restless: int = 0
    failures: dict[str, int] = field(default_factory=dict)
    """How many times a method could not carry a particle further in a frame, by source."""

    @property
    def failed(self) -> int:
        """Return how many times a method reported that it could not carry a particle."""
        return sum(self.failures.values())


@dataclass
class Trials:
    """Runs trials of one graph under one setting: the plan is made and compiled once, and every run begins anew."""

    flat: FlatGraph
    sample: Sample | None = None
    threads: int = 1
    choices: Mapping[str, Choice] | None = None
    plan: Plan = field(init=False)
    executor: BlockExecutor = field(init=False)

    def __post_init__(self) -> None:
        """Make the plan; raise GraphError where the method cannot carry the graph."""
        self.plan = make_plan(self.flat, measured=MEASURED, choices=self.choices)
        self.executor = BlockExecutor(self.plan.precision, self.threads)

    def simulation(self, sample: Sample | None = None) -> Simulation:
        """Return a simulation from the beginning."""
        return Simulation(self.plan, self.executor, self.threads, sample=sample or self.sample)

    def run(self, frames: Sequence[int]) -> Trial:
        """Simulate up to the last of some frames, and keep the states at them."""
        simulation, wanted, made = self.simulation(), set(frames), Trial()
        simulation.programs.prepare()
        made.states = {path: {} for path in simulation.particles}
        begun = time.process_time()
        with np.errstate(all="ignore"):
            for frame in simulation.frames(max(wanted)):
                if frame in wanted:
                    paused = time.process_time()
                    for path, particles in simulation.particles.items():
                        made.states[path][frame] = states_of(particles)
                    begun += time.process_time() - paused
        made.seconds = time.process_time() - begun
        made.restless = sum(particles.unfinished for particles in simulation.particles.values())
        made.failures = {path: particles.failed + particles.lost for path, particles in simulation.particles.items()}
        moving = {path: each for path, each in simulation.particles.items() if each.plan.own is not None}
        made.work = {path: self._evaluations(particles) for path, particles in moving.items()}
        made.evaluations = float(np.mean(list(made.work.values()))) if moving else 0.0
        return made

    def _evaluations(self, particles: Particles) -> float:
        """Return the evaluations of each particle of a source in each frame."""
        scheme = particles.plan.motion.scheme
        if not scheme.paced:
            return float(self.flat.time.substeps * scheme.evaluations)
        return scheme.evaluations * particles.turns / max(particles.carried, 1)


def sample_of(flat: FlatGraph, most: int, last: int, threads: int = 1) -> Sample:
    """Choose at most `most` births of each emitter up to a frame, and as many of their children, of each source."""
    trials = Trials(replace(flat, time=replace(flat.time, method="strang", substeps=1)), threads=threads)
    simulation = trials.simulation()
    clock = simulation.clock
    ordinals = {
        path: ordinals_of(flat.seed, path, _born(particles.births, clock, last), most)
        for path, particles in simulation.particles.items()
        if particles.births is not None
    }
    if not any(emitter.spawns for emitter in trials.plan.emitters.values()):
        return Sample(ordinals)
    census = Census(ordinals, most=most)
    with np.errstate(all="ignore"):
        for _ in trials.simulation(census).frames(last):
            pass
    return census.found()


def _born(births: Births, clock: Clock, last: int) -> int:
    """Return how many particles an emitter makes up to a frame."""
    return len(births.at_start()) + sum(len(births.within(interval)) for interval in clock.intervals(last))


def states_of(particles: Particles) -> States:
    """Return the particles that live at the frame."""
    rows = particles.living()
    count = particles.store.count

    def column(name: str, type_: Any) -> np.ndarray:
        value = particles.value(name) if particles.has(name) else 0.0
        parts = value if isinstance(value, tuple) else (value,)
        return np.stack([np.broadcast_to(np.asarray(part), count)[rows].astype(type_) for part in parts], axis=1)

    position, velocity = column("position", np.float64), column("velocity", np.float64)
    return States(column("id", np.uint64)[:, 0], column("lives", np.int64)[:, 0], position, velocity)


def spread_frames(frames: Iterable[int], most: int) -> list[int]:
    """Return at most `most` of some frames, evenly spread, the last among them."""
    known = sorted(set(frames))
    places = {len(known) * (k + 1) // min(most, len(known)) - 1 for k in range(min(most, len(known)))}
    return [known[place] for place in sorted(places)]
