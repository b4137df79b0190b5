"""What a processor set takes of memory and of time to grow."""

import subprocess
import sys
import time

import pytest

from graphfx.store import Column, ProcessorSet

COLUMNS = {
    "position": Column("vec3"), "color": Column("color", (1, 0.5, 0)), "id": Column("id"), "birth": Column("time"),
    "radius": Column("float", 0.25), "hits": Column("count", -1), "on": Column("mask"),
}


def grow_to_a_million():
    """Fill a set a thousand rows at a time; return (set, seconds in allocate, capacities had)."""
    particles, seconds, capacities = ProcessorSet(COLUMNS), 0.0, set()
    for _ in range(1000):
        began = time.perf_counter()
        rows = particles.allocate(1000)
        seconds += time.perf_counter() - began
        capacities.add(particles.capacity)
        for name in COLUMNS:
            for growable in particles._arrays[name]:
                growable.array[rows] = 1
    return particles, seconds, capacities


def test_growing_is_cheap():
    """A million rows in a thousand steps take under 150 resizes, spare room within 5 % always, and no copy."""
    particles, seconds, capacities = grow_to_a_million()
    assert len(capacities) < 150
    assert particles.capacity <= 1.05 * particles.count
    if sys.platform == "linux":
        assert sum(growable.copies for growable in particles._growables()) == 0
    assert seconds < 1  # 0.05 s on an idle machine; copying all at each step would move 25 GB


RESIDENT = """
import sys
sys.path[:0] = {path!r}
import numpy as np
from graphfx.store import Column, ProcessorSet

def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096

columns = {{"position": Column("vec3"), "velocity": Column("vec3"), "id": Column("id"), "on": Column("mask")}}
unused = np.ones(30_000_000, np.uint8)
del unused  # from now on malloc would take arrays up to this size from the heap, where growing copies
warm = ProcessorSet(columns)
warm.allocate(10)
before = resident()
particles = ProcessorSet(columns)
for _ in range(1000):
    rows = particles.allocate(1000)
    for name in columns:
        for growable in particles._arrays[name]:
            growable.array[rows] = 1
print((resident() - before) / (particles.count * particles.bytes_per_row))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_memory_stays_near_what_the_rows_take():
    """After growing to a million rows step by step the process has taken at most 5 % more than the rows' bytes."""
    script = RESIDENT.format(path=[folder for folder in sys.path if folder])
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert 0.95 < float(done.stdout) < 1.05
