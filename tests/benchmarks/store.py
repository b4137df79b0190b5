"""Time the store's primitives against NumPy: `python tests/benchmarks/store.py`.

Every round times all of them in turn, so that a busy moment of the machine falls on each alike;
the least time of each counts. Aim: the sort on 2 threads at least 4 times as fast as NumPy's stable one.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from graphfx.store import (
    Column,
    ProcessorSet,
    exclusive_scan,
    gather,
    partition,
    segmented_scan,
    stable_argsort,
    stable_argsort_words,
)

ROWS = 1_000_000
ROUNDS = 9
COLUMNS = {
    "position": Column("vec3"), "velocity": Column("vec3"), "color": Column("color"),
    "id": Column("id"), "birth": Column("time"),
}


def grow() -> ProcessorSet:
    """Return a set that has grown to a million rows in a thousand steps, all written."""
    particles = ProcessorSet(COLUMNS, threads=2)
    for _ in range(1000):
        rows = particles.allocate(ROWS // 1000)
        for name in COLUMNS:
            for array in particles.column(name):
                array[rows] = 1
            del array  # a view kept over the next step would make it copy
    return particles


def cases() -> dict[str, dict[str, Callable[[], Any]]]:
    """Return what to time, by group; the first of a group is what the others are compared with."""
    rng = np.random.default_rng(1)
    keys, words = rng.normal(size=ROWS).astype(np.float32), rng.integers(0, 2**63, ROWS, np.uint64)
    counts, mask = rng.integers(0, 9, ROWS, np.int32), rng.random(ROWS) < 0.5
    rows, starts = rng.permutation(ROWS), np.arange(0, ROWS, 20)
    particles = grow()

    def churn() -> None:
        particles.kill(mask)
        particles.allocate(particles.compact())

    def numpy_copies() -> None:
        for name in COLUMNS:
            for array in particles.column(name):
                array[~mask]

    return {
        "sort float32": {
            "numpy.argsort stable": lambda: np.argsort(keys, kind="stable"),
            "1 thread": lambda: stable_argsort(keys), "2 threads": lambda: stable_argsort(keys, 2),
        },
        "sort uint64": {
            "numpy.argsort stable": lambda: np.argsort(words, kind="stable"),
            "1 thread": lambda: stable_argsort_words(words), "2 threads": lambda: stable_argsort_words(words, 2),
        },
        "scan int32": {"numpy.cumsum": lambda: np.cumsum(counts, dtype=np.int64), "1 thread": lambda: exclusive_scan(counts)},
        "segmented scan": {
            "numpy.cumsum": lambda: np.cumsum(keys),
            "1 thread": lambda: segmented_scan(keys, starts), "2 threads": lambda: segmented_scan(keys, starts, threads=2),
        },
        "gather": {
            "numpy": lambda: keys[rows],
            "1 thread": lambda: gather(keys, rows), "2 threads": lambda: gather(keys, rows, threads=2),
        },
        "partition": {"numpy.flatnonzero": lambda: np.flatnonzero(mask), "1 thread": lambda: partition(mask)},
        "set of 1 M": {
            "numpy masks": numpy_copies, "kill half, compact, allocate": churn, "grow in 1000 steps": grow,
        },
    }


def main() -> None:
    """Print milliseconds and ratios."""
    groups = cases()
    times: dict[tuple[str, str], list[float]] = {}
    for _ in range(ROUNDS):
        for group, members in groups.items():
            for name, function in members.items():
                began = time.perf_counter()
                function()
                times.setdefault((group, name), []).append(time.perf_counter() - began)
    for (group, name), measured in times.items():
        base = min(times[group, next(iter(groups[group]))])
        print(f"{group:16} {name:30} {1e3 * min(measured):8.2f} ms   {base / min(measured):5.1f} x")


if __name__ == "__main__":
    main()
