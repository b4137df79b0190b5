"""Time writing pictures against rendering them: `python tests/benchmarks/output.py [streaks ...]`. Not a test.

Random streaks as in render.py, 1920 x 1080, and the same as flames. Every round does each task once, in turn, so that a busy
moment of the machine falls on all alike; the medians count. Prints milliseconds, megabytes, and each time over that of
the render of the same picture; what is below 1 is done before the next picture is there, on one thread beside it.
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
from PIL import Image
from render import CAMERA, HEIGHT, WIDTH, scene

from graphfx.cook.channels import Channels, deep_adder, deep_types
from graphfx.lanes.host import use_wide_registers
from graphfx.output.atomic import whole_file
from graphfx.output.deep import deep_file
from graphfx.output.display import displayed
from graphfx.output.exr import write_exr
from graphfx.output.png import write_png
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks
from graphfx.store.threads import available_threads

ROUNDS = 5
BLACK = (0.0, 0.0, 0.0)


def tasks(streaks: Streaks, folder: Path) -> dict[str, Callable[[], Any]]:
    """Return what is timed, by name; the file of each is its name without blanks."""
    threads, ids = available_threads(), np.arange(streaks.count + 1, dtype=np.uint32)
    film = render([streaks], CAMERA, None, WIDTH, HEIGHT, threads).pixels

    def png(name: str, bits: int, threads: int, background: Any = BLACK, display: str = "srgb") -> None:
        write_png(folder / name, displayed(film, background, display, bits, threads), threads=threads)

    def pillow() -> None:
        with whole_file(folder / "pillow") as stream:
            Image.fromarray(displayed(film, BLACK)).save(stream, "PNG", compress_level=4)

    def channels() -> None:
        made = Channels({"id": ids}, True, WIDTH, HEIGHT)
        render([streaks], CAMERA, None, WIDTH, HEIGHT, threads, sampler=made.add)
        write_exr(folder / "channels", film, made.made(), 16, {})

    def deep() -> None:
        with deep_file(folder / "deep", WIDTH, HEIGHT, deep_types(["id"], 16), {}, threads) as file:
            render([streaks], CAMERA, None, WIDTH, HEIGHT, threads, sampler=deep_adder(file, {"id": ids}, 0.0))

    return {
        "render": lambda: render([streaks], CAMERA, None, WIDTH, HEIGHT, threads),
        "PNG 8": lambda: png("PNG8", 8, threads),
        "PNG 8, one thread": lambda: png("PNG8,onethread", 8, 1),
        "PNG 8, filmic": lambda: png("PNG8,filmic", 8, threads, display="filmic"),
        "PNG 8, alpha": lambda: png("PNG8,alpha", 8, threads, None),
        "pillow": pillow,
        "PNG 16": lambda: png("PNG16", 16, threads),
        "PNG 16, one thread": lambda: png("PNG16,onethread", 16, 1),
        "EXR half": lambda: write_exr(folder / "EXRhalf", film, {}, 16, {}),
        "EXR float": lambda: write_exr(folder / "EXRfloat", film, {}, 32, {}),
        "channels": channels,
        "deep": deep,
    }


def main() -> None:
    """Print a table for each number of streaks, over and add."""
    use_wide_registers()
    for count in [int(text) for text in sys.argv[1:]] or [10_000, 100_000]:
        for blend in ("over", "add"):
            streaks = scene(count, "exposed")
            streaks.blend = blend
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                todo, times = tasks(streaks, folder), defaultdict(list)
                for _ in range(ROUNDS + 1):
                    for task, function in todo.items():
                        start = time.perf_counter()
                        function()
                        times[task].append(time.perf_counter() - start)
                print(f"\n{count:,} streaks, {blend}")
                render_time = median(times["render"][1:])
                for task in todo:
                    taken, file = median(times[task][1:]), folder / task.replace(" ", "")
                    size = f"{file.stat().st_size / 1e6:8.1f} MB" if file.exists() else ""
                    print(f"  {task:20}{taken * 1e3:8.0f} ms {taken / render_time:7.2f} {size}")


if __name__ == "__main__":
    main()
