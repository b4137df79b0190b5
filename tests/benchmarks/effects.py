"""What the effects take: `python tests/benchmarks/effects.py [NAME ...]`; all if none is named.

Of each effect, as it comes: the particles alive in its poster's frame; the nodes that its plan keeps; the bytes of a particle,
on average over those; what a frame takes to simulate, up to the poster's and without what goes before the first, and to draw at
its full size, on average over some of the frames. Both are measured in one run, each by itself, by the clock, on so many threads;
everything was compiled in a short run before. Then what `graphfx study` recommends, and the error that 95 % of particles keep
with it; the study has a limited time, and cannot tell where its references disagree from the first frame on.

Each effect has a process of its own. With --page its row is in the README as soon as it is measured, and the others stay.

    --threads N        2 if not given
    --seconds S        processor time of the settings of a study; 0 leaves it out
    --page             write the rows into the README
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np
from motion_page import processor

from graphfx.cook.effect import Effect
from graphfx.cook.frames import spread
from graphfx.cook.writing import Writer
from graphfx.graph.flatten import flatten
from graphfx.lanes.host import use_wide_registers
from graphfx.plan.listing import bytes_of
from graphfx.study.recommend import advice, length
from graphfx.study.study import Maker
from tests.effects.goldens import EFFECTS, LIBRARY, data_of
from tests.marked import part_of, with_part

README = Path(__file__).parents[2] / "README.md"
DRAWN = 8
"""Frames that are drawn."""
STUDIED, SECONDS = 256, 20.0
"""Births of each source that a study follows, and the processor time of its settings [s]."""
PATIENCE = 600
"""Seconds after which an effect is given up."""
HEAD = ("effect", "particles", "nodes kept", "bytes a particle", "simulating a frame", "drawing it",
        "recommended by `graphfx study`", "its error")


@dataclass(frozen=True)
class Row:
    """What an effect takes; times in seconds."""

    name: str
    particles: int
    kept: int
    nodes: int
    bytes: float
    simulating: float
    drawing: float
    recommended: str
    error: str

    def cells(self) -> tuple[str, ...]:
        """Return the row as a table shows it."""
        return (self.name, f"{self.particles:,}", f"{self.kept} of {self.nodes}", f"{self.bytes:.0f}",
                f"{_rounded(1000 * self.simulating)} ms", f"{_rounded(1000 * self.drawing)} ms", self.recommended, self.error)


def _rounded(number: float) -> str:
    return f"{number:.0f}" if number >= 10 else f"{number:.1f}"


def compiled(effect: Effect, threads: int) -> None:
    """Simulate and draw the first frame, with all that is compiled on the way."""
    simulation, writer = effect.simulation(threads), Writer(effect.plan, threads)
    simulation.programs.prepare()
    frames = simulation.frames(effect.frames[0])
    writer.draw(None, effect.plan.images[0], simulation, next(frames))


def measured(name: str, threads: int, seconds: float) -> Row:
    """Measure an effect."""
    effect = Effect(flatten(EFFECTS[name], LIBRARY))
    compiled(effect, threads)
    poster, image = data_of(name)["x-poster"], effect.plan.images[0]
    drawn = set(spread(range(effect.frames[0], poster + 1), DRAWN))
    simulation, writer = effect.simulation(threads), Writer(effect.plan, threads)
    simulation.programs.prepare()
    simulating: list[float] = []
    drawing: list[float] = []
    begun = time.perf_counter()
    for frame in simulation.frames(poster):
        simulating.append(time.perf_counter() - begun)
        if frame in drawn:
            begun = time.perf_counter()
            writer.displayed(image, writer.draw(None, image, simulation, frame), frame)
            drawing.append(time.perf_counter() - begun)
        begun = time.perf_counter()
    alive = {path: particles.alive for path, particles in simulation.particles.items()}
    each = {path: sum(bytes_of(type_, effect.plan.precision) for type_ in emitter.attributes.columns.values())
            for path, emitter in effect.plan.emitters.items()}
    schedule, particles = effect.plan.schedule, sum(alive.values())
    bytes_ = sum(alive[path] * each[path] for path in alive) / max(particles, 1)
    recommended, error = studied(effect, seconds) if seconds > 0 else ("", "")
    return Row(name, particles, len(schedule.order), len(schedule.order) + len(schedule.dropped), bytes_,
               float(np.mean(simulating[1:])), float(np.mean(drawing)), recommended, error)


def studied(effect: Effect, seconds: float) -> tuple[str, str]:
    """Return what a study recommends, and its error."""
    study = Maker(effect.flat, STUDIED, seconds=seconds, precisions=(effect.flat.time.precision,), repeats=1).make()
    found = advice(study)
    if found.result is not None:
        return found.result.candidate.name, length(found.result.errors.p95)
    known = study.truth is not None and study.truth.until is not None
    return ("none that it tried" if known else "cannot tell"), ""


def apart(name: str, threads: int, seconds: float) -> Row | None:
    """Measure an effect in a process of its own; say what keeps it from that."""
    command = [sys.executable, __file__, name, "--alone", "--threads", str(threads), "--seconds", str(seconds)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        print(f"{name}: given up after {PATIENCE} s", file=sys.stderr)
        return None
    if done.returncode:
        print(f"{name}: {done.stderr.strip()}", file=sys.stderr)
        return None
    return Row(**json.loads(done.stdout.splitlines()[-1]))


def line(cells: tuple[str, ...]) -> str:
    """Return a row of Markdown."""
    return f"| {' | '.join(cells)} |\n"


def page(rows: list[Row], before: str, where: str) -> str:
    """Return the README's part: a table with these rows, and those of other effects as they were."""
    known = {text.split("|")[1].strip(): text + "\n" for text in before.splitlines() if text.startswith("| ")}
    known |= {row.name: line(row.cells()) for row in rows}
    table = [line(HEAD), "|---" * len(HEAD) + "|\n", *(known[name] for name in EFFECTS if name in known)]
    return "".join([*table, "\n", f"{where}\n"])


def write(rows: list[Row], threads: int) -> None:
    """Write rows into the README."""
    text = README.read_text(encoding="utf-8")
    where = (f"{datetime.date.today()}, {threads} threads on {processor()}; `python tests/benchmarks/effects.py --page` "
             f"writes this table (load {os.getloadavg()[0]:.1f} at the end).")
    README.write_text(with_part(text, "effects", page(rows, part_of(text, "effects"), where)), encoding="utf-8")


def main() -> None:
    """Measure effects, print their rows, and write them."""
    use_wide_registers()
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=SECONDS)
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--alone", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if unknown := [name for name in options.names if name not in EFFECTS]:
        parser.error(f"there is no effect '{unknown[0]}'; there are {', '.join(EFFECTS)}")
    if options.alone:
        print(json.dumps(asdict(measured(options.names[0], options.threads, options.seconds))))
        return
    rows: list[Row] = []
    print(line(HEAD), end="")
    for name in options.names or EFFECTS:
        begun = time.monotonic()
        row = apart(name, options.threads, options.seconds)
        if row is not None:
            rows.append(row)
            print(line(row.cells()).rstrip(), f"({time.monotonic() - begun:.0f} s)", flush=True)
            if options.page:
                write(rows, options.threads)


if __name__ == "__main__":
    main()
