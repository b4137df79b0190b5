"""Render many streaks in little memory: `python tests/benchmarks/memory.py [streaks] [megabytes ...]`. Not a test. Linux.

Each run is a process of its own, whose peak of resident memory the system tells: the interpreter, the kernels, the streaks'
heads and tails (24 bytes each), the film, and what the renderer takes. Prints that peak, the time, the share of each step, and
whether all pictures have the same bytes.
"""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
import time
from collections import Counter
from itertools import pairwise
from pathlib import Path

import numpy as np

WIDTH, HEIGHT = 1920, 1080
MEGABYTE = 10**6


def streaks(count: int) -> list[np.ndarray]:
    """Return heads and tails (3, n) in pixels and depth, up to fourteen pixels apart, taking no more memory than they need."""
    draw = np.random.default_rng(1)
    head, tail = np.empty((3, count), np.float32), np.empty((3, count), np.float32)
    for axis, (low, high, way) in enumerate(((0, WIDTH, 20), (0, HEIGHT, 20), (1, 101, 2))):
        for start in range(0, count, 1 << 20):
            piece = slice(start, min(start + (1 << 20), count))
            head[axis, piece] = draw.random(piece.stop - start, np.float32) * (high - low) + low
            tail[axis, piece] = head[axis, piece] + (draw.random(piece.stop - start, np.float32) - 0.5) * way
    return [head, tail]


def run(count: int, allowed: int) -> None:
    """Render in this process, and print what it took as JSON."""
    from render import CAMERA

    from graphfx.cook.memory import working_memory
    from graphfx.lanes.host import use_wide_registers
    from graphfx.render.renderer import render
    from graphfx.render.streaks import Streaks
    from graphfx.store.threads import available_threads

    use_wide_registers()
    threads = available_threads()
    head, tail = streaks(count)
    steps: list[tuple[str, float]] = []
    film = render(
        [Streaks(head, tail, 1.5, head_opacity=0.1)], CAMERA, None, WIDTH, HEIGHT, threads,
        lambda step: steps.append((step, time.perf_counter())), memory=working_memory(allowed, WIDTH * HEIGHT),
    )
    steps.append(("end", time.perf_counter()))
    shares: Counter[str] = Counter()
    for (step, start), (_, stop) in pairwise(steps):
        shares[step] += stop - start
    peak = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
    print(json.dumps({
        "peak": int(peak.split()[1]) * 1024, "steps": shares, "patches": sum(step == "tiles" for step, _ in steps),
        "fragments": film.fragments, "digest": hashlib.sha256(film.pixels.tobytes()).hexdigest(),
    }))


def main() -> None:
    """Render under each budget."""
    if "--run" in sys.argv:
        run(*(int(number) for number in sys.argv[-2:]))
        return
    count, *budgets = [int(argument) for argument in sys.argv[1:]] or [20_000_000]
    digests = set()
    for budget in budgets or [1000, 4000]:
        given = [sys.executable, __file__, "--run", str(count), str(budget * MEGABYTE)]
        found = json.loads(subprocess.run(given, check=True, capture_output=True, text=True).stdout)
        seconds = sum(found["steps"].values())
        parts = "  ".join(f"{step} {100 * share / seconds:.0f} %" for step, share in found["steps"].items())
        print(f"{count:,} streaks, {budget:,} MB allowed: peak {found['peak'] / MEGABYTE:,.0f} MB, {found['patches']} patches, "
              f"{seconds:.1f} s, {found['fragments'] / seconds / 1e6:.0f} M fragments/s   {parts}", flush=True)
        digests.add(found["digest"])
    print("all pictures have the same bytes" if len(digests) == 1 else "THE PICTURES DIFFER")


if __name__ == "__main__":
    main()
