"""The same graph gives the same bytes: alone or among frames, on any threads, registers, and with nothing left out."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import llvmlite.binding
import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.plan.make import make_plan

from .effects import bits, effect, graph, particles

OPS = [
    {"type": "gravity"},
    {"type": "damp", "damping": {"rand": [0, 1]}},
    {"type": "spiral", "speed": {"rand": [-3, 3]}},
    {"type": "vortex", "magnitude": {"keys": [[0, 0], [1, 3]]}, "range": 4, "only": {"expr": "radius > 0.05"}},
    {"type": "vortex", "id": "late", "during": [0.3, 0.6], "center": [1, 0, 0], "axis": [0, 0, 1]},
    {"type": "bounce_plane", "resilience": 0.5, "friction": 0.2},
]
EMIT = {
    "rate": 120,
    "life": {"rand": [0.2, 1]},
    "set": {
        "position": {"in_sphere": {"center": [0, 1, 0]}},
        "velocity": {"in_cone": {"length": 2}},
        "radius": {"rand": [0.02, 0.1]},
        "spiral_axis": {"on_sphere": {}},
        "color": {"rand": [[1, 0, 0], [0, 1, 1]]},
    },
}
TIME = {"frames": [1, 24], "substeps": 2, "preroll": 0.3}
DOCUMENT = graph(OPS, EMIT, TIME, {"shutter": 0.7})


def cooked(out: Path, document=DOCUMENT, **how) -> dict[str, bytes]:
    """Cook; return the bytes of each file by name."""
    return {file.name: file.read_bytes() for file in effect(document).cook(out, **how)}


def test_a_frame_alone_is_that_of_the_whole_cook(tmp_path):
    """Frames 17 and 22 alone are, byte for byte, the files that a cook of all frames writes."""
    whole = cooked(tmp_path / "whole", threads=1)
    assert len(whole) == 24 and len(set(whole.values())) == 24
    for frames in ([22], [17, 22]):
        part = cooked(tmp_path / str(len(frames)), frames=frames, threads=1)
        assert part == {name: whole[name] for name in part} and len(part) == len(frames)


@pytest.mark.parametrize("threads", [2, 7])
def test_threads_change_no_byte(threads, tmp_path):
    """Pictures and particles are the same for any number of threads, with more blocks than threads."""
    document = graph(OPS, EMIT | {"rate": 9000}, TIME | {"frames": [1, 6]}, {"shutter": 0.7})
    assert bits(effect(document).simulate(6, threads=1)) == bits(effect(document).simulate(6, threads=threads))
    assert cooked(tmp_path / "1", document, frames=[6], threads=1) == cooked(
        tmp_path / "n", document, frames=[6], threads=threads
    )


IDLE = {
    "idle": {"type": "emit", "rate": 9, "set": {"position": {"in_box": {}}}},
    "off": {"type": "vortex", "from": "sky", "enabled": False},
    "unread": {"type": "damp", "from": "idle"},
}
DRAG, NOISE = {"type": "drag"}, {"type": "random_translate"}
STACKS = {"linear": OPS[:3], "flows": OPS[3:5], "all": OPS, "none": [], "drag": [DRAG], "noise": [NOISE, {"type": "spring"}]}


def unpruned(found: Effect) -> Effect:
    """Return the effect with nothing left out."""
    whole = Effect(found.flat)
    whole.__dict__["plan"] = make_plan(whole.flat, prune=False)
    return whole


@pytest.mark.parametrize("method", ["strang", "adaptive", "sims"])
@pytest.mark.parametrize("stack", STACKS)
def test_leaving_out_changes_no_byte(stack, method):
    """Attributes that nothing reads and nodes that nothing needs change nothing: without pruning, all is the same."""
    pruned = effect(graph(STACKS[stack], EMIT, TIME | {"method": method}, {"shutter": 0.7}, IDLE))
    whole = unpruned(pruned)
    assert {*pruned.simulate(1)["sky"]} < {*whole.simulate(1)["sky"]} and "idle" in whole.simulate(1)
    for frame in (1, 13, 24):
        assert pruned.film(frame).pixels.tobytes() == whole.film(frame).pixels.tobytes()
        one, other = pruned.simulate(frame)["sky"], whole.simulate(frame)["sky"]
        assert all(np.array_equal(one[name], other[name]) for name in one)


NEVER = [
    {"type": "vortex", "id": "no_vortex", "during": [90, 91]},
    {"type": "damp", "id": "no_damp", "during": [90, 91]},
    {"type": "gravity", "id": "no_gravity", "during": [-9, -8]},
    {"type": "bounce_sphere", "id": "no_sphere", "during": [90, 91]},
    {"type": "drag", "id": "no_drag", "during": [90, 91]},
    {"type": "random_acceleration", "id": "no_noise", "during": [90, 91]},
    {"type": "curl_noise", "id": "no_curl", "during": [90, 91]},
    {"type": "spring", "id": "no_spring", "during": [90, 91]},
]


@pytest.mark.parametrize("method", ["strang", "adaptive", "sims"])
@pytest.mark.parametrize("stack", STACKS)
def test_operators_of_another_time_change_no_byte(stack, method):
    """Operators that act outside the simulated time are left out; kept, they change no byte."""
    pruned = effect(graph([*NEVER[:2], *STACKS[stack], *NEVER[2:]], EMIT, TIME | {"method": method}))
    whole = unpruned(pruned)
    paths = {f"act/{op['id']}" for op in NEVER}
    assert paths <= pruned.plan.schedule.dropped.keys() and not paths & whole.plan.schedule.dropped.keys()
    for frame in (1, 24):
        one, other = pruned.simulate(frame)["sky"], whole.simulate(frame)["sky"]
        assert all(one[name].tobytes() == other[name].tobytes() for name in one)


def test_particle_alone_moves_as_among_many():
    """The first five births, alone because the emitter stops then, move as they do among thousands."""
    emit = EMIT | {"life": 9}
    few = particles(graph(OPS, emit | {"rate": 2400, "during": [0, 0.0018]}, TIME | {"preroll": 0}), 24)
    many = particles(graph(OPS, emit | {"rate": 2400}, TIME | {"preroll": 0}), 24)
    assert len(few["radius"]) == 5 and len(many["radius"]) == 2301
    assert all(few[name].tobytes() == many[name][:5].tobytes() for name in few)


def test_cooking_twice_gives_the_same_bytes(tmp_path):
    """An effect keeps nothing of a cook that would change the next."""
    found = effect(DOCUMENT)
    first = [file.read_bytes() for file in found.cook(tmp_path / "a", frames=[5, 9])]
    assert first == [file.read_bytes() for file in found.cook(tmp_path / "b", frames=[5, 9])]


DIGEST = """
import hashlib, json, sys
from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
found = Effect(flatten(document_of(json.load(open(sys.argv[1]))), Library(library_roots())))
for path, columns in found.simulate(24).items():
    for name, array in sorted(columns.items()):
        print(path, name, hashlib.sha256(array.tobytes()).hexdigest())
"""


@pytest.mark.skipif(not llvmlite.binding.get_host_cpu_features().get("avx512f"), reason="this processor has no AVX-512")
def test_registers_of_256_bits_give_the_same_bits(tmp_path):
    """Code for AVX2 gives the bits that code for AVX-512 gives."""
    script, document = tmp_path / "digest.py", tmp_path / "graph.json"
    script.write_text(DIGEST)
    document.write_text(json.dumps(graph([*OPS[:2], *OPS[3:]], EMIT | {"rate": 30}, TIME, {"shutter": 0.7})))
    narrow = {"NUMBA_CPU_NAME": "haswell", "NUMBA_CPU_FEATURES": "+avx,+avx2,+fma,+bmi,+bmi2,+sse4.2,+popcnt,+f16c"}

    def start(given: dict[str, str]) -> subprocess.Popen[str]:
        command = [sys.executable, str(script), str(document)]
        return subprocess.Popen(command, env=os.environ | given, stdout=subprocess.PIPE, text=True)

    outputs = [process.communicate(timeout=300)[0] for process in (start(narrow), start({}))]
    assert outputs[0] == outputs[1] and outputs[0].count("\n") > 8
