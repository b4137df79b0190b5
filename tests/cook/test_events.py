"""Effects of events together: the same bits on the block machine and in plain Python, on any threads, with nothing left out."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.plan.make import make_plan

from .effects import bits, effect, graph

BALLS = {
    "rate": 300,
    "count": 20,
    "every": 0.1,
    "life": {"rand": [0.05, 0.6]},
    "set": {
        "position": {"in_box": {"min": [-1, 0.02, -1]}},
        "velocity": {"in_sphere": {"radius": 3}},
        "radius": {"rand": [0.01, 0.1]},
    },
    "clusters": {"spot": {"count": 4, "by": "nearest"}, "turn": {"count": 3}},
}
FALL: list[Any] = [{"type": "gravity"}, {"type": "bounce_plane", "resilience": 0.5, "friction": 0.1}]
WALL = {"type": "bounce_plane", "id": "wall", "normal": [1, 0, 0], "point": [-0.5, 0, 0]}
OWN = {"heat": {"type": "float", "default": 1}}
LOOK = {"type": "set", "from": "kid", "set": {"color": {"expr": "vec(age, generation, mass)"}, "opacity": {"rand": [0, 1]}}}

SCENES: dict[str, tuple[list[Any], dict[str, Any], list[str]]] = {
    "sets": (
        [
            *FALL,
            {
                "type": "set",
                "when": "hit",
                "set": {"heat": {"expr": "heat + hit.speed"}, "color": {"rand": [[0, 0, 0], [1, 1, 1]], "per": "hit"}},
            },
            {
                "type": "set",
                "id": "b",
                "when": "step",
                "set": {"velocity": {"expr": "velocity * (1 - heat / 100)"}},
                "only": {"share": {"fraction": 0.5}},
            },
            {"type": "set", "id": "c", "when": "birth", "set": {"mass": {"expr": "spot + 2"}}},
            {
                "type": "set",
                "id": "d",
                "set": {"radius": {"expr": "0.01 * heat * mass / birth.mass"}, "tail.opacity": {"expr": "age"}},
            },
            {"type": "fade", "rate": {"rand": [0, 9], "per": "turn"}, "set": {"heat": 0}},
        ],
        {},
        ["act"],
    ),
    "lives": (
        [
            *FALL,
            WALL,
            {"type": "recycle", "only": {"expr": "turn < 2"}},
            {"type": "kill", "when": "hit", "only": {"expr": "hits > 3"}},
            {"type": "recycle", "id": "top", "when": "step", "only": {"expr": "position.x > 1"}},
            {"type": "kill", "id": "late", "when": "frame", "only": {"share": {"fraction": 0.05}}},
            {"type": "set", "when": "hit", "only": {"expr": "hit.normal.x > 0.5"}, "set": {"life": {"expr": "age + 0.01"}}},
        ],
        {},
        ["act"],
    ),
    "splashes": (
        [*FALL, WALL],
        {
            "kid": {
                "type": "spawn",
                "from": "act",
                "when": "hit",
                "count": {"rand": [0, 3]},
                "spread": 1,
                "life": 0.3,
                "only": {"expr": "hit.speed > 1"},
                "set": {
                    "velocity": {"expr": "hit.normal * hit.speed + parent.velocity / 2"},
                    "mass": {"expr": "parent.age + turn"},
                },
            },
            "slip": {"type": "stack", "from": "kid", "ops": [*FALL[:1], FALL[1] | {"response": "slide"}]},
            "grand": {"type": "spawn", "from": "slip", "when": "death", "probability": 0.5, "life": 0.05, "inherit": ["mass"]},
            "look": LOOK | {"from": ["slip", "grand"]},
        },
        ["act", "look"],
    ),
    "rockets": (
        FALL[:1],
        {
            "burst": {
                "type": "spawn",
                "from": "act",
                "when": "death",
                "count": 2,
                "spread": 2,
                "into": "sky",
                "generations": 3,
                "life": {"rand": [0.05, 0.1]},
            },
            "kid": {
                "type": "spawn",
                "from": "act",
                "rate": {"rand": [10, 60]},
                "life": 0.2,
                "set": {"velocity": [0, 0, 0], "mass": {"expr": "parent.generation"}},
            },
            "look": LOOK,
        },
        ["act", "look"],
    ),
    "trails": (
        [*FALL, {"type": "recycle"}, {"type": "set", "set": {"heat": {"expr": "lives"}}}],
        {
            "kid": {
                "type": "spawn",
                "from": "act",
                "rate": 40,
                "life": 0.1,
                "during": [0.03, 0.4],
                "only": {"expr": "position.y > 0.1"},
            },
            "few": {"type": "share", "from": "kid", "fraction": 0.3},
            "look": LOOK | {"from": "few"},
            "dust": {"type": "spawn", "from": "few", "when": "birth", "count": 2, "life": 0.05},
        },
        ["act", "look", "dust"],
    ),
    "selections": (
        FALL,
        {
            "some": {"type": "share", "from": "act", "fraction": 0.4},
            "low": {"type": "inside_box", "from": "some", "min": [-9, 0, -9], "max": [9, 0.5, 9]},
            "a": {"type": "set", "from": "low", "set": {"heat": {"expr": "heat + 1"}}},
            "b": {"type": "vortex", "from": ["low", "sky"], "only": {"any": ["some", {"not": {"expr": "spot == 1"}}]}},
            "c": {"type": "set", "from": "b", "set": {"radius": {"expr": "0.01 * heat"}}},
        },
        ["c", "low", "a"],
    ),
}
TIMES = {"one step": {}, "two steps": {"substeps": 2, "preroll": 0.13}, "the paper's": {"method": "sims", "fps": 30}}


def scene(name: str, time: dict[str, Any], precision: int = 32, fewer: int = 1) -> Effect:
    """Return the effect of a scene of six frames."""
    ops, nodes, show = SCENES[name]
    emit = BALLS | {"rate": BALLS["rate"] // fewer, "count": BALLS["count"] // fewer}
    return effect(graph(ops, emit, {"frames": [1, 6], "precision": precision} | time, {"from": show}, nodes, attributes=OWN))


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("name", SCENES)
def test_machine_gives_the_bits_of_plain_python(name, time):
    """To the last bit, in the precision that comes in turn, for all columns of all sources."""
    precision = 32 if (list(TIMES).index(time) + list(SCENES).index(name)) % 2 else 64
    found = scene(name, TIMES[time], precision, fewer=10)
    assert bits(found.simulate(6)) == bits(found.simulate(6, reference=True))


@pytest.mark.parametrize("name", SCENES)
def test_threads_change_no_bit(name):
    """One thread or three: the same particles in the same order, over many blocks."""
    emit = {"rate": 20000}
    ops, nodes, show = SCENES[name]
    found = effect(graph(ops, BALLS | emit, {"frames": [1, 4], "substeps": 2}, {"from": show}, nodes, attributes=OWN))
    one, three = found.simulate(4, threads=1), found.simulate(4, threads=3)
    assert bits(one) == bits(three) and len(one["sky"]["position"]) > 600


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("name", SCENES)
def test_leaving_out_changes_no_bit(name, time):
    """With nothing left out, what is stored otherwise is the same, and so is the picture."""
    pruned = scene(name, TIMES[time])
    whole = Effect(pruned.flat)
    whole.__dict__["plan"] = make_plan(whole.flat, prune=False)
    one, other = pruned.simulate(6), whole.simulate(6)
    assert bits(one) == bits({path: {column: other[path][column] for column in given} for path, given in one.items()})
    assert pruned.film(6).pixels.tobytes() == whole.film(6).pixels.tobytes()


@pytest.mark.parametrize("name", SCENES)
def test_all_stays_finite_and_something_happens(name):
    """In each scene particles are there, all of their numbers are finite, and ids are their own."""
    for path, columns in scene(name, {}).simulate(6).items():
        assert all(np.isfinite(values).all() for values in columns.values())
        assert len(columns["position"]) > 10 or path == "grand"
        if "id" in columns:
            assert len(np.unique(columns["id"])) == len(columns["id"])
