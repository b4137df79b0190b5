"""Time bounces off a mesh of 20 480 faces against those off the sphere that it stands for: `python tests/benchmarks/meshes.py`.

A million particles, one thread, CPU time; frames of both simulations are taken in turn, and the least and the median
of each counted, less nothing: whole frames, births and deaths, which there are none of, included. Aim: a mesh costs at
most 20 times a sphere.
"""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from graphfx.lanes.host import use_wide_registers

SCENES: dict[str, tuple[dict[str, Any], bool]] = {
    "inside, all over": ({"position": {"in_sphere": {"radius": 0.95}}, "velocity": {"in_sphere": {"radius": 2}}}, True),
    "outside, around": ({"position": {"in_box": {"min": [-1.5] * 3, "max": [1.5] * 3}},
                         "velocity": {"in_sphere": {"radius": 2}}}, False),
    "all close to it": ({"position": {"on_sphere": {"radius": 1.02}}, "velocity": {"in_sphere": {"radius": 0.2}}}, False),
}
SPHERE, MESH = "sphere", "mesh"
TURNS = 12


def frames_of(kind: str, emit: dict[str, Any], inside: bool, count: int) -> Any:
    """Return the frames of a simulation in which particles fall and bounce off one of the two."""
    import graphfx

    surface = {SPHERE: {"type": "bounce_sphere", "inside": inside}, MESH: {"type": "bounce_mesh", "mesh": "shape"}}[kind]
    nodes = {
        "shape": {"type": "mesh_sphere", "subdivisions": 5},
        "dust": {"type": "emit", "count": count, "set": emit},
        "way": {"type": "stack", "from": "dust", "ops": [{"type": "gravity"}, {**surface, "resilience": 1}]},
        "view": {"type": "camera", "position": [0, 0, 9]},
        "picture": {"type": "image", "from": "way", "camera": "view", "size": [16, 16]},
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bounce.json"
        path.write_text(json.dumps({"graphfx": 1, "time": {"frames": [1, TURNS + 3]}, "nodes": nodes}))
        return graphfx.load(path).simulation(1).frames(TURNS + 3)


def main(count: int) -> None:
    """Print a line for each scene."""
    for name, (emit, inside) in SCENES.items():
        frames = {kind: frames_of(kind, emit, inside, count) for kind in (SPHERE, MESH)}
        times: dict[str, list[float]] = {kind: [] for kind in frames}
        for turn in range(TURNS + 2):
            for kind, each in frames.items():
                began = time.process_time()
                next(each)
                if turn > 1:  # the births, and the first frame, which compiles
                    times[kind].append(time.process_time() - began)
        least = {kind: min(each) / count * 1e9 for kind, each in times.items()}
        median = {kind: statistics.median(each) / count * 1e9 for kind, each in times.items()}
        print(f"{name:18} sphere {least[SPHERE]:6.1f} ns, mesh {least[MESH]:6.1f} ns a particle and frame: "
              f"{least[MESH] / least[SPHERE]:.1f} times (medians {median[MESH] / median[SPHERE]:.1f})", flush=True)


if __name__ == "__main__":
    use_wide_registers()
    main(int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000)
