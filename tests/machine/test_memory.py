"""Particles take the bytes that the plan tells, in the store and in the process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from graphfx.cook.effect import load
from graphfx.plan.listing import plan_data

ROOT = Path(__file__).resolve().parents[2]
SNOW = ROOT / "tests/snow.json"
PARTICLES = 1_000_000
MEASURE = """
import ctypes, gc, json, resource, sys
from graphfx.cook.effect import load

def resident():
    gc.collect()
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # what is free already, the C library would keep for later
    trim and trim(0)
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()

def simulated(graph):
    simulation = load(graph).simulation(1)
    for _ in simulation.frames(5):
        pass
    return next(iter(simulation.particles.values())).store

small = simulated(sys.argv[1])
before = resident()
store = simulated(sys.argv[2])
arrays = [array for name in store.columns for array in store.arrays(name)]
print(json.dumps({"count": store.count, "store": sum(array.nbytes for array in arrays), "resident": resident() - before}))
"""


def snow_of(particles: int, folder: Path) -> Path:
    """Write snow with all particles born in the first 0.04 s; return the file."""
    graph = json.loads(SNOW.read_text())
    graph["time"].update(preroll=0)
    graph["nodes"]["sky"].update(rate=particles / 0.04, during=[0, 0.04], life=1000)
    file = folder / f"snow_{particles}.json"
    file.write_text(json.dumps(graph))
    return file


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """Simulate a million particles in a process of their own; return what they took, and what the plan tells."""
    folder = tmp_path_factory.mktemp("memory")
    graph = snow_of(PARTICLES, folder)
    command = [sys.executable, "-c", MEASURE, str(snow_of(1000, folder)), str(graph)]
    paths = os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])])
    done = subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, "PYTHONPATH": paths})
    return {**json.loads(done.stdout), "plan": plan_data(load(graph).plan)["emitters"][0]["bytes"]}


def test_the_store_takes_what_the_plan_tells(measured):
    """A million particles' columns are within 5 % of the plan's bytes."""
    assert measured["store"] / measured["count"] == pytest.approx(measured["plan"], rel=0.05)


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc to read the memory of a process from")
def test_the_process_grows_by_what_the_plan_tells(measured):
    """The memory that a simulation of a million particles keeps is within 5 % of the plan's bytes."""
    assert measured["resident"] / measured["count"] == pytest.approx(measured["plan"], rel=0.05)
