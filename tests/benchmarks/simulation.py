"""Time the simulation of a million particles against C, naive Numba and Taichi: `python tests/benchmarks/simulation.py`.

All contenders advance the same particles by the same frames in turn, A B C D B C D A C D A B, so that a busy moment
of the machine falls on each alike, and none always has the same before it; medians count. One thread is measured in
CPU time, two in wall time. Before the clock runs, every way to build the C side is tried and the fastest taken; in
the end the results are compared. C's arithmetic is graphfx's, operation for operation; without contraction its bits
are too. What stays the same for a particle through a frame both find once.
Aims: graphfx within 1.25 times the time of C, and 3.5 times as fast as naive Numba.

    --taichi PYTHON   an interpreter that has Taichi, if this one has not
"""

from __future__ import annotations

import argparse
import dataclasses
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import naive
import numpy as np
from c_library import Build, Library, builds
from cases import BLOCK, SUBSTEPS, Engine, aligned
from taichi_side import TaichiSide

from graphfx.lanes.host import use_wide_registers
from graphfx.store.threads import parallel

PIECE = 64 * BLOCK
"""Particles that a thread takes at a time, as graphfx does."""
MAIN, WHOLE = "graphfx, the program of whole steps", "graphfx, everything between two frames"
Run = Callable[[list[np.ndarray], np.ndarray, int, int], Any]


class Contender:
    """Columns of its own, advanced by a function over ranges of particles."""

    def __init__(self, name: str, columns: list[np.ndarray], run: Run, threads: int):
        self.name, self.run, self.threads = name, run, threads
        self.columns = [aligned(column) for column in columns]

    def advance(self, parameters: np.ndarray) -> tuple[float, float]:
        """Advance all particles by a frame; return CPU and wall seconds."""
        count = len(self.columns[0])
        began = time.process_time(), time.perf_counter()
        if self.threads == 1:
            self.run(self.columns, parameters, 0, count)
        else:
            def piece(k: int) -> None:
                self.run(self.columns, parameters, k * PIECE, min((k + 1) * PIECE, count))

            parallel(piece, (count + PIECE - 1) // PIECE, self.threads)
        return time.process_time() - began[0], time.perf_counter() - began[1]


def fastest(engine: Engine, folder: Path, draw: int) -> Build:
    """Return the honest build that is fastest on one thread now."""
    parameters, columns = engine.parameters(engine.upcoming), engine.columns()
    made = [Contender(str(build), columns, Library(build, folder).run, 1) for build in builds(engine.effect, draw)]
    times = [min(contender.advance(parameters)[0] for _ in range(5)) for contender in made]
    return builds(engine.effect, draw)[int(np.argmin(times))]


def contenders(engine: Engine, folder: Path, threads: int, taichi: str) -> list[Any]:
    """Return the others on so many threads."""
    columns, effect = engine.columns(), engine.effect

    def c(name: str, build: Build) -> Contender:
        return Contender(f"{name}: {build}", columns, Library(build, folder).run, threads)

    best = fastest(engine, folder, 1)
    variants = (best, dataclasses.replace(best, contract="off"), dataclasses.replace(best, contract="fast", fast=True))
    found: list[Any] = [c("C", build) for build in dict.fromkeys(variants)]
    if effect == "snow":
        found.append(c("C, rates from a column", fastest(engine, folder, 0)))
    found.append(Contender("naive Numba", columns, lambda *given: naive.run(effect, *given), threads))
    if taichi:
        found.append(TaichiSide(taichi, effect, columns, threads))
    return found


def difference(engine: Engine, contender: Any) -> str:
    """Say how far positions and velocities [m, m/s] are from graphfx's, of particles that met no plane of snow.

    Where surfaces bounce, a last digit decides whether a particle bounces in this substep or in the next; so the
    99th percentile is told besides the greatest.
    """
    columns = contender.state()[:6] if isinstance(contender, TaichiSide) else contender.columns[:6]
    own = [array for name in ("position", "velocity") for array in engine.particles.store.column(name)]
    apart = np.max([np.abs(a - b[: len(a)]) for a, b in zip(own, columns, strict=True)], axis=0)[engine.free]
    return "equal bits" if not apart.any() else f"{np.percentile(apart, 99):.0e}, at most {apart.max():.0e}"


def measure(effect: str, particles: int, rounds: int, folder: Path, taichi: str) -> None:
    """Time one effect on one thread and two, and print the table."""
    for threads in (1, 2):
        engine = Engine(effect, particles, threads)
        others = contenders(engine, folder, threads, taichi)
        warm_up(engine, others)
        clock = 0 if threads == 1 else 1
        times: dict[str, list[float]] = {MAIN: [], WHOLE: [], **{other.name: [] for other in others}}
        for number in range(rounds):
            parameters = engine.parameters(engine.upcoming)
            turns: list[Any] = [engine, *others]
            start = number % len(turns)
            for contender in turns[start:] + turns[:start]:
                if isinstance(contender, Engine):
                    main, whole = contender.advance()
                    times[MAIN].append(main[clock])
                    times[WHOLE].append(whole[clock])
                else:
                    times[contender.name].append(contender.advance(parameters)[clock])
        report(effect, threads, engine, times, others)


def warm_up(engine: Engine, others: list[Any]) -> None:
    """Have all compiled; then put the others back to where the engine stands."""
    for other in others:
        other.advance(engine.parameters(engine.upcoming))
        if isinstance(other, TaichiSide):
            other.reset(engine.columns())
        else:
            other.columns = engine.columns()


def report(effect: str, threads: int, engine: Engine, times: dict[str, list[float]], others: list[Any]) -> None:
    """Print nanoseconds per particle and substep, and each contender's ratio to graphfx."""
    scale = 1e9 / engine.particles.store.count / SUBSTEPS[effect]
    own = np.array(next(iter(times.values())))
    load = os.getloadavg()[0]
    kind = "CPU time" if threads == 1 else "wall time"
    print(f"\n{effect}, {engine.particles.store.count} particles, {threads} thread{'s' * (threads > 1)}, {kind}; load {load:.1f}")
    print(f"{'':58} {'ns':>7} {'25 to 75 %':>15} {'/ graphfx':>10}  difference")
    differences = {other.name: difference(engine, other) for other in others}
    for name, measured in times.items():
        values = np.array(measured) * scale
        low, high = np.percentile(values, (25, 75))
        ratio = np.median(np.array(measured) / own)
        print(f"{name:58} {np.median(values):7.2f} {low:7.2f} {high:7.2f} {ratio:10.2f}  {differences.get(name, '')}", flush=True)


def has_taichi(python: str) -> bool:
    """Return whether an interpreter has Taichi."""
    found = shutil.which(python) is not None
    return found and subprocess.run([python, "-c", "import taichi"], capture_output=True).returncode == 0


def main() -> None:
    """Measure both effects."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--particles", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--taichi", default=sys.executable)
    parser.add_argument("--effect", choices=tuple(SUBSTEPS))
    options = parser.parse_args()
    use_wide_registers()
    taichi = options.taichi if has_taichi(options.taichi) else ""
    if not taichi:
        print("no Taichi: install it beside some Python and give --taichi PYTHON")
    with tempfile.TemporaryDirectory() as folder:
        for effect in [options.effect] if options.effect else SUBSTEPS:
            measure(effect, options.particles, options.rounds, Path(folder), taichi)


if __name__ == "__main__":
    main()
