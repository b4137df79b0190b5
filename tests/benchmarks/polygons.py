"""Time polygons among particles: `python tests/benchmarks/polygons.py [streaks]`. Not a test.

A million streaks as in render.py at 1920 x 1080, alone and with sheets: opaque before all (whole picture, half of it), between,
behind, transparent, with a texture. Every round renders each scene once, in turn; medians, and their ratio to the streaks alone.
Aimed at: an opaque sheet before the streaks makes the frame cheaper. Then spheres of many triangles alone.
"""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Callable
from statistics import median

import numpy as np
from render import CAMERA, HEIGHT, WIDTH, scene

from graphfx.geometry import sphere
from graphfx.lanes.host import use_wide_registers
from graphfx.render import Polygons, Streaks
from graphfx.render.camera import Camera
from graphfx.render.renderer import render
from graphfx.render.textures import textured
from graphfx.store.threads import available_threads

ROUNDS = 5


def sheet(z: float, width: float = WIDTH, **look: object) -> Polygons:
    """Return a rectangle over the left `width` pixels of the picture, at depth z."""
    corners = np.array([[0, 0, z], [width, 0, z], [width, HEIGHT, z], [0, HEIGHT, z]])
    coordinates = np.array([[[0, 0], [4, 0], [4, 3]], [[0, 0], [4, 3], [0, 3]]], float)
    return Polygons(corners, np.array([[0, 1, 2], [0, 2, 3]]), coordinates=coordinates, **look)  # type: ignore[arg-type]


def rounds(scenes: dict[str, Callable[[], object]]) -> dict[str, float]:
    """Return the median seconds of each scene, rendered in turn."""
    times: dict[str, list[float]] = defaultdict(list)
    for number in range(ROUNDS + 1):
        for name, draw in scenes.items():
            start = time.perf_counter()
            draw()
            if number:
                times[name].append(time.perf_counter() - start)
    return {name: median(each) for name, each in times.items()}


def among(streaks: Streaks, threads: int) -> None:
    """Print the times of streaks with sheets, and their ratios to the streaks alone."""
    picture = textured(np.random.default_rng(1).random((1024, 1024, 3), np.float32))
    sheets = {
        "streaks alone": [],
        "opaque before all": [sheet(0.0)],
        "opaque before all, left half": [sheet(0.0, WIDTH / 2)],
        "opaque in the middle": [sheet(51.0)],
        "opaque behind all": [sheet(104.0)],
        "textured behind all": [sheet(104.0, color_map=picture)],
        "transparent in the middle": [sheet(51.0, opacity=0.5)],
        "ten transparent": [sheet(5.0 + 10 * k, opacity=0.2) for k in range(10)],
    }

    def drawn(polygons: list[Polygons]) -> Callable[[], object]:
        return lambda: render([streaks], CAMERA, None, WIDTH, HEIGHT, threads, polygons=polygons)

    found = rounds({name: drawn(polygons) for name, polygons in sheets.items()})
    for name, seconds in found.items():
        print(f"{name:32s} {1000 * seconds:7.0f} ms   {seconds / found['streaks alone']:5.2f} of the streaks alone", flush=True)


def alone(threads: int) -> None:
    """Print the times of spheres without particles."""
    camera = Camera(position=(0, 0, 3.2), lens=35.0)
    for subdivisions in (3, 5, 7, 8):
        mesh = sphere(1.0, subdivisions)
        ball = Polygons(mesh.vertices, mesh.triangles, mesh.vertices, mesh.coordinates, shading="smooth")

        def draw(ball: Polygons = ball) -> object:
            return render([], camera, None, WIDTH, HEIGHT, threads, polygons=[ball])

        seconds = rounds({"ball": draw})["ball"]
        print(f"sphere of {len(mesh.triangles):8d} triangles     {1000 * seconds:7.0f} ms", flush=True)


def main() -> None:
    """Measure all."""
    use_wide_registers()
    threads = available_threads()
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    print(f"{count} streaks, {threads} threads")
    among(scene(count, "exposed"), threads)
    alone(threads)


if __name__ == "__main__":
    main()
