"""Time the preview: `python tests/benchmarks/preview.py [particles] [frames]`. Not a test.

The snow with so many flakes alive, drawn as lines at 640 x 360. In one run, frame by frame in turn: simulating, drawing,
encoding one after the other; and the first two while another thread encodes, as the command has it.
"""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.pictures import draw
from graphfx.cook.preview import QUALITY, preview_of
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.lanes.host import use_wide_registers
from graphfx.node import Library, library_roots
from graphfx.output.animation import animated_webp
from graphfx.output.display import displayed
from graphfx.store.threads import available_threads

LIFE, FPS = 14, 24
BACKGROUND = (0.004, 0.008, 0.022)
Times = list[tuple[float, float, float]]


def snow(particles: int, frames: int) -> Effect:
    """Return the preview of a snow with so many flakes alive from the first frame on."""
    library = Library(library_roots())
    graph = json.loads((Path(__file__).parents[1] / "snow.json").read_text())
    graph["time"] |= {"preroll": LIFE, "frames": [1, frames]}
    graph["nodes"]["sky"]["rate"] = particles / LIFE
    return Effect(preview_of(flatten(document_of(graph), library), library, "snow.webp"))


def run(effect: Effect, threads: int, beside: bool) -> Times:
    """Return the seconds that each frame's simulation, drawing and encoding took; 0 for what went on beside."""
    image, simulation = effect.plan.images[0], effect.simulation(threads)
    times: Times = []
    with (tempfile.TemporaryDirectory() as folder, animated_webp(Path(folder, "snow.webp"), FPS, QUALITY) as add,
          ThreadPoolExecutor(1) as writer):
        def encode(pixels: np.ndarray) -> None:
            add(displayed(pixels, BACKGROUND))

        waiting: Future[None] | None = None
        begun = time.perf_counter()
        for frame in simulation.frames(effect.frames[-1]):
            simulated = time.perf_counter()
            film = draw(image, simulation, frame, threads)
            drawn = time.perf_counter()
            if beside:
                if waiting is not None:
                    waiting.result()
                waiting = writer.submit(encode, film.pixels)
            else:
                encode(film.pixels)
            ended = time.perf_counter()
            times.append((simulated - begun, drawn - simulated, ended - drawn))
            begun = ended
    return times[1:]


def told(seconds: float) -> str:
    """Return a time a frame, and how many frames a second that is."""
    return f"{1000 * seconds:6.1f} ms, {1 / seconds:5.0f} frames a second"


def main() -> None:
    """Measure both ways, and print medians."""
    use_wide_registers()
    given = [int(argument) for argument in sys.argv[1:]]
    particles, frames = (*given, *(100_000, 72)[len(given):])
    threads = available_threads()
    effect = snow(particles, frames)
    alive = sum(len(columns["birth"]) for columns in effect.simulate(1, threads).values())
    print(f"{alive:,} flakes, {frames} frames of 640 x 360, {threads} threads")
    alone = run(effect, threads, beside=False)
    for name, k in (("simulation", 0), ("drawing", 1), ("encoding", 2)):
        print(f"{name:34} {told(statistics.median(each[k] for each in alone))}")
    print(f"{'simulation and drawing':34} {told(statistics.median(each[0] + each[1] for each in alone))}")
    together = run(effect, threads, beside=True)
    print(f"{'all, encoding beside':34} {told(statistics.median(sum(each) for each in together))}")


if __name__ == "__main__":
    main()
