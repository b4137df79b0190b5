"""Error and time of motion beside others': `python tests/benchmarks/motion.py`.

Every problem is carried by graphfx with the method `auto` at a tolerance, and by others with the cheapest of their settings
that was found to keep it: 95 % of the particles end within the tolerance of the truth. The truth is a closed form where
there is one, or else the method `adaptive` of order 8 at 1e-12, beside which the table says how far DOP853 at 1e-13 is from it.
Settings are tried from the loosest; nothing is extrapolated. What is tried too long is given up, which the table says.
All run on one thread, the same particles (the slow ones fewer of them); those that were chosen take turns, and the least
CPU time counts, by particle and simulated second. graphfx gives the states of all frames (24 a second), the others the last.
What finds graphfx's settings, once for a graph, is told beside. Aims: 10 times as fast as the best of SciPy on every problem,
and faster than the paper's scheme on all but the loosest.

Needs SciPy; REBOUND is left out where it is not installed.

    --problems WORD    those alone whose names contain it
    --page FILE        write the tables as a page, too
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from motion_page import Row, page, row_text
from motion_peers import loop_run, rebound_run, scipy_run
from motion_problems import PROBLEMS, Problem
from motion_share import share_rows

from graphfx.cook.pilot import Pilot
from graphfx.cook.trial import Trials
from graphfx.graph.flat import FlatGraph
from graphfx.lanes.host import use_wide_registers
from graphfx.plan.make import make_plan
from graphfx.plan.method import Choice

TOLERANCES = (1e-3, 1e-6)
PARTICLES, MANY, FEW, PATIENCE = 2048, 100_000, 24, 1.0
"""Particles of graphfx, of its longer run, and of the slow ones; CPU seconds after which a finer setting is not tried."""
ROUNDS = 3
TIGHTER = [10.0 ** (-k / 2) for k in range(4, 27)]
ONE_STEP = 0.0
MORE_STEPS = [1.5 * 2.0**k for k in range(18)]


@dataclass
class Contender:
    """What carries the first `count` particles: settings from the loosest, and what each was found to come to."""

    name: str
    run: Callable[[np.ndarray, float], tuple[np.ndarray, float]]
    settings: list[float]
    kind: str
    count: int
    tried: list[tuple[float, float, float, float]] = field(default_factory=list)
    given_up: bool = False

    def scan(self, start: np.ndarray, truth: np.ndarray, tolerance: float) -> tuple[float, float, float, float] | None:
        """Return setting, error, evaluations and seconds of the first that keeps the tolerance, if any was found."""
        for setting in self.settings[len(self.tried) :]:
            if self.given_up or (self.tried and self.tried[-1][1] <= tolerance):
                break
            ends, evaluations, seconds = self.timed(start, setting)
            self.tried.append((setting, error_of(ends, truth[: self.count]), evaluations, seconds))
            self.given_up = seconds > PATIENCE
        return min((each for each in self.tried if each[1] <= tolerance), key=lambda each: each[3], default=None)

    def timed(self, start: np.ndarray, setting: float) -> tuple[np.ndarray, float, float]:
        """Return the ends, evaluations and CPU seconds of a run."""
        begun = time.process_time()
        ends, evaluations = self.run(start[: self.count], setting)
        return ends, evaluations, time.process_time() - begun


def error_of(ends: np.ndarray, truth: np.ndarray) -> float:
    """Return the error of position that 95 % of particles do not exceed [m]; what is no number is infinitely far away."""
    apart = np.linalg.norm(ends[:, :3] - truth[:, :3], axis=1)
    return float(np.quantile(np.where(np.isfinite(apart), apart, np.inf), 0.95, method="higher"))


class Engine:
    """graphfx on a problem under one choice of method; preparation is not timed."""

    def __init__(self, flat: FlatGraph, choices: dict[str, Choice] | None = None):
        self.last = flat.time.last
        self.trials = Trials(flat, choices=choices)

    @property
    def method(self) -> str:
        """Return the method that was chosen, and its tolerance or steps."""
        motion = self.trials.plan.emitters["some"].motion
        scheme = motion.scheme
        if scheme.paced:
            return f"{motion.method} {2 * len(scheme.counts)}, {scheme.tolerance:.0e} m/s"
        return motion.method if scheme.counts == (1,) else f"{motion.method}, {scheme.counts[0]} steps a frame"

    def run(self) -> tuple[np.ndarray, np.ndarray, float, float]:
        """Return the states at the start and the end, in the order of ids, evaluations of a particle, and CPU seconds."""
        trial = self.trials.run([0, self.last])
        found = []
        for states in (trial.states["some"][0], trial.states["some"][self.last]):
            order = np.argsort(states.ids, kind="stable")
            velocity = states.velocity[order] if states.velocity.shape[1] == 3 else np.zeros((len(states), 3))
            found.append(np.hstack([states.position[order], velocity]))
        evaluations = max(trial.work.values(), default=0.0) * self.last
        return found[0], found[1], evaluations, trial.seconds


def chosen(flat: FlatGraph) -> tuple[dict[str, Choice] | None, float]:
    """Return what the pilot of `auto` chooses, and the CPU seconds that this took."""
    begun = time.process_time()
    waiting = [path for path, emitter in make_plan(flat).emitters.items() if emitter.method == "strang"]
    choices = Pilot.of(flat, waiting).choices() if waiting else None
    return choices, time.process_time() - begun


def truth_of(problem: Problem) -> tuple[np.ndarray, np.ndarray, str]:
    """Return the states at the start and, as truly as can be, at the end, and how they are known."""
    if problem.truth is not None:
        start = Engine(problem.graph(PARTICLES, method="strang")).run()[0]
        return start, problem.truth(start, problem.seconds), "closed form"
    graph = problem.graph(PARTICLES, method="adaptive", order=8, tolerance=1e-12)
    start, truth, _, _ = Engine(graph).run()
    other = scipy_run(problem, "DOP853")(start[:16], 1e-13)[0]
    return start, truth, f"adaptive 8; DOP853 differs by {np.abs(other - truth[:16])[:, :3].max():.0e} m"


def paper(problem: Problem) -> Contender:
    """Return the paper's scheme by graphfx; the setting is steps a second."""

    def run(start: np.ndarray, setting: float) -> tuple[np.ndarray, float]:
        _, ends, evaluations, seconds = engine(setting).run()
        clock.append(seconds)
        return ends, evaluations

    engines: dict[float, Engine] = {}
    clock: list[float] = []

    def engine(setting: float) -> Engine:
        if setting not in engines:
            steps = round(setting / 24)
            frames, substeps = max(steps // 8, 1), min(steps, 8)
            engines[setting] = Engine(problem.graph(PARTICLES, frames, method="sims", substeps=substeps))
        return engines[setting]

    made = Contender("the paper's scheme", run, MORE_STEPS[4:], "steps a second", PARTICLES)

    def timed(start: np.ndarray, setting: float) -> tuple[np.ndarray, float, float]:
        ends, evaluations = run(start, setting)
        return ends, evaluations, clock[-1]

    made.timed = timed  # type: ignore[method-assign]
    return made


def contenders(problem: Problem) -> list[Contender]:
    """Return the others that can carry a problem."""
    found = [
        paper(problem),
        Contender("SciPy DOP853", scipy_run(problem, "DOP853"), TIGHTER, "rtol = atol", FEW),
        Contender("SciPy Radau", scipy_run(problem, "Radau"), TIGHTER, "rtol = atol", FEW // 2),
        Contender("naive Numba RK4", loop_run(problem), MORE_STEPS, "steps a second", 256),
        Contender("naive Numba RK4, each frame", loop_run(problem), MORE_STEPS[4:], "steps a second", 256),
    ]
    if problem.orbits and importlib.util.find_spec("rebound"):
        loosest = [10.0**-k for k in range(1, 12)]
        found += [
            Contender("REBOUND IAS15, each alone", rebound_run(problem, "ias15", False), loosest, "epsilon", 256),
            Contender("REBOUND IAS15, together", rebound_run(problem, "ias15", True), loosest, "epsilon", 256),
            Contender("REBOUND WHFast, whole time", rebound_run(problem, "whfast", True), [ONE_STEP], "one step", PARTICLES),
            Contender("REBOUND WHFast, each frame", rebound_run(problem, "whfast", True), [24.0], "steps a second", PARTICLES),
        ]
    return found


def measure(problem: Problem) -> list[Row]:
    """Return the rows of one problem, for all tolerances."""
    start, truth, known = truth_of(problem)
    others, rows = contenders(problem), []
    for other in others:
        other.run(start[:1], other.settings[0])
    for tolerance in TOLERANCES:
        flat = problem.graph(PARTICLES, tolerance=tolerance)
        choices, piloting = chosen(flat)
        engine, many = Engine(flat, choices), Engine(problem.graph(MANY, tolerance=tolerance), choices)
        found = [(other, other.scan(start, truth, tolerance)) for other in others]
        _, ends, evaluations, seconds = engine.run()
        least = {"": seconds, **{other.name: best[3] for other, best in found if best}}
        for _ in range(ROUNDS):
            least[""] = min(least[""], engine.run()[3])
            for other, best in found:
                if best and best[3] < PATIENCE:
                    least[other.name] = min(least[other.name], other.timed(start, best[0])[2])
        own = least[""] / PARTICLES / problem.seconds
        crowd = many.run()[3] / MANY / problem.seconds
        name = f"graphfx auto: {engine.method}"
        rows.append(Row(problem.name, tolerance, name, "", error_of(ends, truth), evaluations, own, 1.0, crowd, piloting, known))
        for other, best in found:
            if best is None:
                rows.append(Row(problem.name, tolerance, other.name, not_kept(other), math.nan, math.nan, math.nan, math.nan))
                continue
            each = least[other.name] / other.count / problem.seconds
            setting = setting_text(best[0], other.kind)
            rows.append(Row(problem.name, tolerance, other.name, setting, best[1], best[2], each, each / own))
        for row in rows[-len(found) - 1 :]:
            print(row_text(row), flush=True)
    return rows


def setting_text(setting: float, kind: str) -> str:
    """Return a setting as words."""
    return kind if setting == ONE_STEP else f"{setting:.2g} {kind}" if setting < 1 else f"{setting:,.0f} {kind}"


def not_kept(other: Contender) -> str:
    """Say how far a contender that keeps no tolerance was tried."""
    setting, error, _, _ = other.tried[-1]
    return f"not kept: {error:.1e} m at {setting_text(setting, other.kind)}" + (", given up" if other.given_up else "")


def main() -> None:
    """Measure all problems, print the tables, and write the page."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--problems", default="")
    parser.add_argument("--page", type=Path)
    options = parser.parse_args()
    use_wide_registers()
    print(f"one thread, CPU time; load {os.getloadavg()[0]:.1f}")
    begun, rows = time.perf_counter(), []
    with np.errstate(all="ignore"):
        for problem in PROBLEMS:
            if options.problems in problem.name:
                rows += measure(problem)
        shares = share_rows()
    for share in shares:
        print(share)
    if options.page:
        options.page.write_text(page(rows, shares))
    print(f"{time.perf_counter() - begun:.0f} s; load {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
