"""Compile the renderer beside the simulation, on the first cook ever: two processes, two cores.

Compiled code is cached on disk; a mark beside it says that the renderer's is there. Without the mark, a
second process draws a small picture, which fills the cache while this one compiles the graph's kernels.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from graphfx.lanes.cache import cache_folder, digest_of, engine_digest, listeners

ENOUGH = 4096
"""Particles that make the renderer sort by itself."""


def _mark(polygons: bool) -> Path:
    processor = [os.environ.get(name, "").encode() for name in ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES")]
    digest = digest_of([engine_digest("math", "lanes", "store", "render").encode(), *processor])
    return cache_folder() / f"renderer{'-polygons' * polygons}-{digest}.ready"


def start(polygons: bool) -> subprocess.Popen[bytes] | None:
    """Begin to compile the renderer, unless that was done before or there is no second process to be had."""
    if _mark(polygons).exists() or not sys.executable:
        return None
    for listener in listeners:
        listener("the renderer")
    try:
        return subprocess.Popen(
            [sys.executable, "-m", "graphfx.cook.warm", *["polygons"] * polygons],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except OSError:
        return None


def draw_small(polygons: bool) -> None:
    """Draw a small picture with everything in it that is compiled, and leave the mark."""
    from graphfx.geometry import box
    from graphfx.render.camera import Camera
    from graphfx.render.polygons import Polygons
    from graphfx.render.renderer import render
    from graphfx.render.streaks import Streaks
    from graphfx.render.ways import Ways, chords_of

    head = np.random.default_rng(0).uniform(-1, 1, (3, ENOUGH)).astype(np.float32)
    camera, cube = Camera(), box((1, 1, 1))
    drawn = [Polygons(cube.vertices, cube.triangles)] if polygons else []
    render([Streaks(head=head, tail=head + np.float32(0.1))], camera, camera, 64, 64, 1, memory=1e9, polygons=drawn)
    chords_of(Ways(np.zeros((1, 1)), np.zeros((3, 1, 1))), np.zeros(1), np.zeros(1), 1.0)
    _mark(polygons).touch()


if __name__ == "__main__":
    draw_small("polygons" in sys.argv)
