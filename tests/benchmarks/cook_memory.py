"""Cook many streaks in little memory: `python tests/benchmarks/cook_memory.py [particles] [megabytes ...]`. Not a test. Unix.

Each cook is `graphfx cook --memory` in a process of its own, whose peak of resident memory the system tells: the interpreter,
the kernels, the particles, the pictures and what is needed for a while. They fall from a box, all born at once as the first
frame begins, all at once between two frames, or one after another over two frames. Prints the bytes of the particles, the peak,
the seconds, and whether the pictures have the same bytes whatever is allowed. Kernels are compiled before.
"""

from __future__ import annotations

import hashlib
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import graphfx

MEGABYTE = 10**6
FPS = 24
BORN: dict[str, dict[str, Any]] = {
    "at once": {"count": 1.0}, "at once between two frames": {"count": 1.0, "during": [0.5 / FPS, 9]},
    "over two frames": {"rate": FPS / 2, "during": [0, 2 / FPS]},
}


def graph(born: dict[str, Any], count: int) -> dict[str, Any]:
    """Return a document whose particles keep their position, their velocity and where they were when the shutter opened."""
    emit = {name: value if name == "during" else count * value for name, value in born.items()}
    box = {"in_box": {"min": [-8, -5, -8], "max": [8, 5, 8]}}
    return {
        "graphfx": 1, "seed": 7, "time": {"fps": FPS, "frames": [1, 3]},
        "nodes": {
            "cloud": {"type": "emit", **emit, "set": {"position": box, "radius": 0.01, "opacity": 0.1}},
            "fall": {"type": "stack", "from": "cloud", "ops": [{"type": "gravity"}]},
            "view": {"type": "camera", "position": [0, 0, 14]},
            "frames": {"type": "image", "from": "fall", "camera": "view", "size": [1920, 1080], "shutter": 0.5},
        },
    }


def cook(file: Path, out: Path, *options: str) -> tuple[int, float]:
    """Cook in a process of its own; return its peak of resident memory in bytes, and the seconds."""
    began = time.perf_counter()
    process = subprocess.Popen([sys.executable, "-m", "graphfx", "cook", str(file), "--out", str(out), "--json", *options],
                               stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(process.returncode)
    return peak_of(used), time.perf_counter() - began


def peak_of(used: resource.struct_rusage) -> int:
    """Return the most resident memory that a process had, in bytes."""
    return used.ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def main() -> None:
    """Cook each graph under each budget."""
    count, *budgets = [int(argument) for argument in sys.argv[1:]] or [20_000_000]
    with tempfile.TemporaryDirectory() as folder:
        for name, born in BORN.items():
            file, out, digests = Path(folder, "cloud.json"), Path(folder, "out"), set()
            file.write_text(json.dumps(graph(born, 1000)))
            cook(file, out)
            file.write_text(json.dumps(graph(born, count)))
            store = next(iter(graphfx.load(file).simulation().particles.values())).store.bytes_per_row
            for budget in budgets or [1100 if "rate" in born else 1000, 4000]:
                peak, seconds = cook(file, out, "--memory", f"{budget}MB")
                digests.add(hashlib.sha256(b"".join(made.read_bytes() for made in sorted(out.iterdir()))).hexdigest())
                print(f"{count:,} born {name}, {store} bytes each, {count * store / MEGABYTE:,.0f} MB together; "
                      f"{budget:,} MB allowed: peak {peak / MEGABYTE:,.0f} MB, {seconds:.1f} s; load {os.getloadavg()[0]:.1f}",
                      flush=True)
            print("all pictures have the same bytes" if len(digests) == 1 else "THE PICTURES DIFFER")


if __name__ == "__main__":
    main()
