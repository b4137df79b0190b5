"""Time the renderer against C and an approximation: `python tests/benchmarks/render.py [streaks ...]`. Not a test.

Streaks up to 40 pixels long of radius 0.5 to 6, in random places of 1920 x 1080 and in depth, 169 fragments each. Every
round renders each scene once by each contender, in turn, so that a busy moment of the machine falls on all alike; the medians
count. Prints milliseconds, million exactly ordered fragments a second, the share of each step, and the ratios that are aimed at:
C (the textbook form: tiles, a buffer, insertion sort per pixel) at least twice the time, at most twice the time of the order
by one depth a particle, 10 times the streaks at most 11 times the time.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from textbook import Textbook, by_one_depth

from graphfx.lanes.host import use_wide_registers
from graphfx.render.camera import Camera
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks
from graphfx.store.threads import available_threads

WIDTH, HEIGHT = 1920, 1080
ROUNDS = 7
CAMERA = Camera(
    position=(WIDTH / 2, HEIGHT / 2, 0.0), target=(WIDTH / 2, HEIGHT / 2, 1.0), up=(0.0, -1.0, 0.0),
    projection="orthographic", view_width=WIDTH, near=-10.0,
)
PERSPECTIVE = Camera(
    position=(WIDTH / 2, HEIGHT / 2, -1919.0), target=(WIDTH / 2, HEIGHT / 2, 1.0), up=(0.0, -1.0, 0.0), lens=36.0
)


def scene(count: int, streak: str, comets: bool = False, falloff: str = "linear", radius: float = 0.5) -> Streaks:
    """Return random streaks in pixels, seen by `CAMERA`."""
    draw = np.random.default_rng(3)
    x, y, z = draw.uniform(0, WIDTH, count), draw.uniform(0, HEIGHT, count), draw.uniform(1, 101, count)
    length, angle = draw.uniform(0, 40, count), draw.uniform(0, 2 * np.pi, count)
    tail = np.stack([x + length * np.cos(angle), y + length * np.sin(angle), z + draw.uniform(-2, 2, count)])
    return Streaks(
        np.stack([x, y, z]).astype(np.float32), tail.astype(np.float32),
        head_radius=draw.uniform(radius, 6, count).astype(np.float32),
        head_color=draw.random((3, count), np.float32), head_opacity=draw.uniform(0.1, 0.9, count).astype(np.float32),
        tail_color=(1.0, 0.5, 0.0) if comets else None, streak=streak, falloff=falloff,
    )


def piercing(count: int) -> Streaks:
    """Return streaks that reach through each other in depth, so that pending lists overflow."""
    streaks = scene(count, "solid")
    streaks.head[2] = 1.0
    streaks.tail[2] = 101.0
    return streaks


class Contender:
    """One way to render a scene, and how long it took."""

    def __init__(self, name: str, run: Callable[[Callable[[str], Any]], int | None]):
        self.name, self.run = name, run
        self.seconds: list[float] = []
        self.steps: dict[str, list[float]] = defaultdict(list)
        self.fragments: int | None = None

    def once(self) -> None:
        """Render, and note the time of all and of each step."""
        steps: list[tuple[str, float]] = []
        start = time.perf_counter()
        self.fragments = self.run(lambda step: steps.append((step, time.perf_counter())))
        end = time.perf_counter()
        self.seconds.append(end - start)
        stops = [moment for _, moment in steps[1:]] + [end]
        for (step, begun), stop in zip(steps, stops, strict=False):
            self.steps[step].append((stop - begun) / (end - start))

    def report(self) -> float:
        """Print and return the median."""
        seconds = median(self.seconds)
        rate = f"{self.fragments / seconds / 1e6:7.1f} M fragments/s" if self.fragments else " " * 22
        parts = "  ".join(f"{step} {100 * median(shares):.0f} %" for step, shares in self.steps.items())
        print(f"{self.name:42s} {1000 * seconds:8.0f} ms  {rate}  {parts}", flush=True)
        return seconds


def exactly(streaks: Streaks, camera: Camera, threads: int) -> Callable[[Callable[[str], Any]], int]:
    """Return a run of the renderer."""
    return lambda listen: render([streaks], camera, None, WIDTH, HEIGHT, threads, listen).fragments


def check(textbook: Textbook, threads: int) -> None:
    """See that C makes the same picture, of streaks that are not made even for being small."""
    streaks = scene(20_000, "solid", radius=2.0)
    ours, theirs = render([streaks], CAMERA, None, WIDTH, HEIGHT, threads).pixels, textbook.render(streaks)[0]
    print(f"greatest difference from C, of 20 000 streaks: {np.abs(ours - theirs).max():.1e}")


def contenders_for(count: int, textbook: Textbook, threads: int) -> list[Contender]:
    """Return all ways to render so many streaks."""
    solid, exposed, comets = scene(count, "solid"), scene(count, "exposed"), scene(count, "exposed", comets=True)
    runs: dict[str, Callable[[Callable[[str], Any]], int | None]] = {
        "solid": exactly(solid, CAMERA, threads),
        "solid, C": lambda listen: textbook.render(solid)[1],
        "solid, one depth each": lambda listen: by_one_depth(solid, CAMERA, WIDTH, HEIGHT, threads) is None,
        "exposed": exactly(exposed, CAMERA, threads),
        "exposed, perspective": exactly(exposed, PERSPECTIVE, threads),
        "exposed comets, perspective": exactly(comets, PERSPECTIVE, threads),
        "piercing": exactly(piercing(count), CAMERA, threads),
    }
    return [Contender(f"{count} {name}", run) for name, run in runs.items()]


def main() -> None:
    """Measure every scene."""
    use_wide_registers()
    threads = available_threads()
    counts = [int(argument) for argument in sys.argv[1:]] or [100_000, 1_000_000]
    with tempfile.TemporaryDirectory() as folder:
        textbook = Textbook(Path(folder), WIDTH, HEIGHT, threads)
        check(textbook, threads)
        groups: list[list[Contender]] = []
        for count in counts:
            groups.append(contenders_for(count, textbook, threads))
        contenders = [each for group in groups for each in group]
        for each in contenders:
            each.once()
            each.seconds.clear()
        for _ in range(ROUNDS):
            for each in contenders:
                each.once()
    medians = [[each.report() for each in group] for group in groups]
    for count, (ours, c, one_depth, *_) in zip(counts, medians, strict=True):
        print(f"{count}: C takes {c / ours:.2f} times the time; exact order {ours / one_depth:.2f} times that of one depth each")
    for count, before, after in zip(counts[1:], medians, medians[1:], strict=False):
        ratios = [f"{each.name.split(' ', 1)[1]} {b / a:.1f}" for each, a, b in zip(groups[0], before, after, strict=True)]
        print(f"up to {count}, times the time: {'; '.join(ratios)}")


if __name__ == "__main__":
    main()
