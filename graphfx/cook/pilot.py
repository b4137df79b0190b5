"""Choose how motion is computed by trying it on some of a graph's particles: the cheapest setting that is accurate enough.

A setting is accurate enough if 95 % of the particles tried are, at frames spread over the whole graph, within the
graph's tolerance of where the method `adaptive` of order 8 puts them at a thousandth of it; in 64 bits, where the tolerance
is not far above what 32 bits can tell. What it costs is counted in evaluations of the forces, not in seconds. So the choice
is a function of the graph alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from graphfx.cook.matching import distances, quantile
from graphfx.cook.sample import Sample
from graphfx.cook.trial import States, Trial, Trials, sample_of, spread_frames
from graphfx.errors import Problem
from graphfx.graph.flat import FlatGraph
from graphfx.plan.make import Plan, make_plan
from graphfx.plan.method import Choice
from graphfx.plan.scheme import COUNTS, Scheme

PARTICLES = 256
"""Particles of each source that are tried: one block."""
FRAMES = 12
"""Frames at which they are compared."""
FINER = 1e-3
"""The tolerance of what they are compared with, as a share of the graph's."""
SAFETY = 0.5
"""The share of the tolerance that a setting may use up: the particles tried are not all."""
TRIES = 6
"""How often a tolerance is made smaller, or larger, until the error is right."""
MOST_STEPS = 64
ROUNDING = 2.0**-17
"""The tolerance, as a share of the greatest coordinate, from which on down rounding in 32 bits is looked at: 128 last digits."""
LOOSEST = 1e4
"""The greatest local tolerance that is tried, as a multiple of the graph's."""


@dataclass(frozen=True)
class Setting:
    """A method with its scheme, and what both are called."""

    method: str
    scheme: Scheme
    name: str


@dataclass(frozen=True)
class Found:
    """What a setting came to for one source: the error of 95 % [m], the share of states that are farther off than is allowed,
    and evaluations of each particle in each frame."""

    setting: Setting
    error: float
    over: float
    evaluations: float


def strang(steps: int) -> Setting:
    """Return the symmetric scheme with some steps in each of the graph's."""
    words = "one step" if steps == 1 else f"{steps} steps"
    return Setting("strang", Scheme((steps,)), f"composed symmetrically, second order, {words} each time")


def adaptive(order: int, tolerance: float) -> Setting:
    """Return extrapolation with steps of each particle's own; `tolerance` is for a second [m/s]."""
    return Setting("adaptive", Scheme(COUNTS[order], tolerance), f"order {order} by extrapolation, steps of each particle's own")


def planned(flat: FlatGraph) -> Plan:
    """Return the plan of a graph; where its method is `auto` and no motion is exact, after trying."""
    plan = make_plan(flat)
    choices = choices_for(plan)
    return make_plan(flat, choices=choices) if choices else plan


def choices_for(plan: Plan) -> dict[str, Choice]:
    """Return what `auto` chooses for the sources of a plan that wait for a choice."""
    waiting = [path for path, emitter in plan.emitters.items() if emitter.method == "strang"]
    return Pilot.of(plan.flat, waiting).choices() if plan.flat.time.method == "auto" and waiting else {}


@dataclass
class Pilot:
    """Tries settings on a sample of a graph's particles; `paths` are the sources that wait for a choice."""

    flat: FlatGraph
    paths: list[str]
    sample: Sample
    frames: list[int]
    first: Trial = field(init=False)
    reference: Trial = field(init=False)
    known: dict[str, list[Found]] = field(default_factory=dict)

    @classmethod
    def of(cls, flat: FlatGraph, paths: list[str]) -> Pilot:
        """Choose the particles and carry them as accurately as can be."""
        frames = spread_frames(range(flat.time.first, flat.time.last + 1), FRAMES)
        made = cls(flat, paths, sample_of(flat, PARTICLES, frames[-1]), frames)
        made.known = {path: [] for path in paths}
        made.first = made.run(dict.fromkeys(paths, strang(1)))
        best = dict.fromkeys(paths, adaptive(8, flat.time.tolerance * FINER))
        made.reference = made.run(best, 64 if made.is_near_rounding else flat.time.precision)
        return made

    @property
    def is_near_rounding(self) -> bool:
        """Return whether what 32 bits can tell is not far below the tolerance."""
        states = [states for frames in self.first.states.values() for states in frames.values()]
        greatest = max((float(np.nanmax(np.abs(each.position), initial=0.0)) for each in states), default=0.0)
        return self.flat.time.precision == 32 and self.flat.time.tolerance < greatest * ROUNDING

    def run(self, settings: Mapping[str, Setting], precision: int | None = None) -> Trial:
        """Carry the particles under a setting for each source."""
        flat = replace(self.flat, time=replace(self.flat.time, precision=precision or self.flat.time.precision))
        choices = {path: Choice(setting.method, setting.name, setting.scheme) for path, setting in settings.items()}
        return Trials(flat, self.sample, choices=choices).run(self.frames)

    def choices(self) -> dict[str, Choice]:
        """Return what is chosen for each source."""
        wanted = self.flat.time.tolerance * SAFETY
        self.note(dict.fromkeys(self.paths, strang(1)), self.first)
        open_ = [path for path in self.paths if self.known[path][0].error > wanted]
        for order in (6, 4, 8) if open_ else ():
            self.calibrate(open_, order, wanted)
        self.attempt({path: strang(steps) for path in open_ if (steps := self.promising(path, wanted)) > 1})
        return {path: self.choice(path, wanted) for path in self.paths}

    def attempt(self, settings: Mapping[str, Setting]) -> None:
        """Try a setting for some sources; the others go on with the first that was tried."""
        if settings:
            self.note(settings, self.run({path: settings.get(path, strang(1)) for path in self.paths}))

    def note(self, settings: Mapping[str, Setting], trial: Trial) -> None:
        """Keep what settings came to in a trial."""
        for path, setting in settings.items():
            errors = errors_of(self.reference.states[path], trial.states[path])
            error = quantile(errors, 0.95) if len(errors) else 0.0
            error = math.inf if trial.failures.get(path) else error
            over = float(np.mean(errors > self.flat.time.tolerance)) if len(errors) else 0.0
            self.known[path].append(Found(setting, error, over, trial.work[path]))

    def calibrate(self, paths: list[str], order: int, wanted: float) -> None:
        """Try an order with tolerances that bring the error just below what is wanted."""
        tolerances = dict.fromkeys(paths, self.flat.time.tolerance)
        for _ in range(TRIES):
            self.attempt({path: adaptive(order, tolerance) for path, tolerance in tolerances.items()})
            following = {path: self._next(path, tolerance, wanted) for path, tolerance in tolerances.items()}
            tolerances = {path: tolerance for path, tolerance in following.items() if tolerance > 0}
            if not tolerances:
                return

    def _next(self, path: str, tolerance: float, wanted: float) -> float:
        """Return the next tolerance to try, 0 where there is none: the error was right, or turned."""
        last, before = self.known[path][-1], self.known[path][-2]
        graph = self.flat.time.tolerance
        if last.error > wanted:
            if before.setting.scheme.counts == last.setting.scheme.counts and before.error <= wanted:
                return 0.0
            return tolerance / 16 if tolerance > graph * FINER * 4 else 0.0
        if last.error * 16 > wanted or last.evaluations <= last.setting.scheme.evaluations * 1.01 or tolerance < graph:
            return 0.0
        return tolerance * 16 if tolerance < graph * LOOSEST else 0.0

    def promising(self, path: str, wanted: float) -> int:
        """Return how many steps the symmetric scheme needs for the error, from that of one; 1 if others need fewer."""
        first, *others = self.known[path]
        if not math.isfinite(first.error):
            return 1
        steps = 2 ** math.ceil(math.log2(max(math.sqrt(first.error / wanted), 1.0)))
        least = min((found.evaluations for found in others if found.error <= wanted), default=math.inf)
        return steps if steps * first.evaluations < least and steps <= MOST_STEPS else 1

    def choice(self, path: str, wanted: float) -> Choice:
        """Return the setting with the fewest evaluations among those that are accurate enough, or else the most accurate."""
        known = self.known[path]
        enough = [found for found in known if found.error <= wanted]
        best = min(enough, key=lambda found: found.evaluations) if enough else min(known, key=lambda found: found.error)
        told = (
            f"95 % of {PARTICLES} tried are within {best.error:.2g} m, {100 * best.over:.2g} % over the "
            f"{self.flat.time.tolerance:g} m allowed, at {best.evaluations:.3g} evaluations a frame"
        )
        way = ', and "precision": 64, as 32 bits tell no more of places so far out' if self.is_near_rounding else ""
        told += "" if enough else f"; none tried was accurate enough, see `graphfx study`{way}"
        doubt = "" if best.error <= self.flat.time.tolerance else (
            f"no way tried of computing its motion keeps time.tolerance, {self.flat.time.tolerance:g} m: the best leaves 95 % of "
            f"particles within {best.error:.2g} m; allow as much, or see `graphfx study`{way}"
        )
        return Choice(best.setting.method, f"{best.setting.name}; {told}", best.setting.scheme, doubt)


def doubts(plan: Plan, choices: Mapping[str, Choice]) -> Iterator[Problem]:
    """Yield what is to be told of motions that are not as accurate as was asked."""
    for path, choice in choices.items():
        if choice.doubt:
            yield Problem(choice.doubt, plan.emitters[path].node.location, f"nodes.{path}")


def errors_of(true: Mapping[int, States], other: Mapping[int, States]) -> np.ndarray:
    """Return the distances of all particles at all frames, ascending [m]; what is missing is infinitely far away."""
    return np.sort(np.concatenate([np.zeros(0), *(distances(states, other[frame])[0] for frame, states in true.items())]))
