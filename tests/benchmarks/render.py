"""Time the renderer: `python tests/benchmarks/render.py [streaks ...]`. Not a test.

Streaks up to 40 pixels long of radius 0.5 to 6, in random places of 1920 x 1080 and in depth, 169
fragments each. Prints the best of some runs: milliseconds, million fragments a second, and each step's share.
"""

from __future__ import annotations

import sys
import time

import numpy as np

from graphfx.render.camera import Camera
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks
from graphfx.store.threads import available_threads

WIDTH, HEIGHT = 1920, 1080
RUNS = 5


def scene(count: int, streak: str, comets: bool = False, falloff: str = "linear") -> Streaks:
    """Return random streaks in pixels, seen by `CAMERA`."""
    draw = np.random.default_rng(3)
    x, y, z = draw.uniform(0, WIDTH, count), draw.uniform(0, HEIGHT, count), draw.uniform(1, 101, count)
    length, angle = draw.uniform(0, 40, count), draw.uniform(0, 2 * np.pi, count)
    tail = np.stack([x + length * np.cos(angle), y + length * np.sin(angle), z + draw.uniform(-2, 2, count)])
    return Streaks(
        np.stack([x, y, z]).astype(np.float32), tail.astype(np.float32),
        head_radius=draw.uniform(0.5, 6, count).astype(np.float32),
        head_color=draw.random((3, count), np.float32), head_opacity=draw.uniform(0.1, 0.9, count).astype(np.float32),
        tail_color=(1.0, 0.5, 0.0) if comets else None, streak=streak, falloff=falloff,
    )


def piercing(count: int) -> Streaks:
    """Return streaks that reach through each other in depth, so that pending lists overflow."""
    streaks = scene(count, "solid")
    streaks.head[2] = 1.0
    streaks.tail[2] = 101.0
    return streaks


CAMERA = Camera(
    position=(WIDTH / 2, HEIGHT / 2, 0.0), target=(WIDTH / 2, HEIGHT / 2, 1.0), up=(0.0, -1.0, 0.0),
    projection="orthographic", width_of_view=WIDTH, near=-10.0,
)
PERSPECTIVE = Camera(
    position=(WIDTH / 2, HEIGHT / 2, -1919.0), target=(WIDTH / 2, HEIGHT / 2, 1.0), up=(0.0, -1.0, 0.0), lens=36.0
)


def measure(name: str, streaks: Streaks, camera: Camera, threads: int) -> None:
    """Render a few times; print the best."""
    best: tuple[float, list[tuple[str, float]], int] | None = None
    for _ in range(RUNS):
        steps: list[tuple[str, float]] = []

        def listen(step: str, steps: list[tuple[str, float]] = steps) -> None:
            steps.append((step, time.perf_counter()))

        film = render([streaks], camera, None, WIDTH, HEIGHT, threads, listen)
        end = time.perf_counter()
        whole = end - steps[0][1]
        if best is None or whole < best[0]:
            stops = [*(moment for _, moment in steps[1:]), end]
            shares = [(step, (stop - start) / whole) for (step, start), stop in zip(steps, stops, strict=True)]
            best = whole, shares, film.fragments
    seconds, shares, fragments = best
    parts = "  ".join(f"{step} {100 * share:.0f} %" for step, share in shares)
    print(f"{name:34s} {1000 * seconds:8.0f} ms {fragments / seconds / 1e6:7.1f} M fragments/s   {parts}", flush=True)


def main() -> None:
    """Measure every scene."""
    threads = available_threads()
    start = time.perf_counter()
    render([scene(100, "solid")], CAMERA, None, 64, 64)
    print(f"compiled or loaded in {time.perf_counter() - start:.1f} s; {threads} threads")
    for count in [int(argument) for argument in sys.argv[1:]] or [100_000, 1_000_000]:
        for streak in ("solid", "exposed"):
            measure(f"{count} {streak}", scene(count, streak), CAMERA, threads)
        measure(f"{count} exposed perspective", scene(count, "exposed"), PERSPECTIVE, threads)
        measure(f"{count} piercing", piercing(count), CAMERA, threads)
        measure(f"{count} exposed comets perspective", scene(count, "exposed", comets=True), PERSPECTIVE, threads)


if __name__ == "__main__":
    main()
