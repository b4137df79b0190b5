"""The block machine gives what plain Python gives, to the last bit, for every feature of the language."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from graphfx.graph.functions import FUNCTIONS

from .effects import bits, effect, graph, made

RAND = {"rand": [0.5, 2.5]}
EVERY_NUMBER = (
    "sin(x) + cos(x) * exp(-x) + log(x + 1) / sqrt(x + 2) + abs(x - 1) + floor(3 * x) + min(x, 1) - max(x, 2, 3)"
    " + clamp(x, 0.5, 1) + mix(1, x, 0.3) + step(1, x) + smoothstep(0, 2, x) + x % 0.3 + x ** 1.5 + pow(2, -x)"
    " + length(vec(x, 1, -x)) + dot(vec(x, 0, 1), vec(1, x, x)) + cross(vec(x, 1, 0), vec(0, x, 1)).z"
    " + normalize(vec(x, x, 1)).y + (1 if x > 1 and not x >= 2 or x == 0 else -x) + (2 if x != 1 and x <= 1.5 and x < 2 else 3)"
)
DISTRIBUTIONS = {
    "position": {"in_sphere": {"center": [0, 1, 0], "radius": RAND}},
    "velocity": {"on_sphere": {"radius": 2}},
    "spiral_axis": {"in_cone": {"direction": [1, -1, 0.5], "angle": RAND}},
    "radius": {"gauss": {"mean": 0.1, "deviation": 0.02}},
    "color": {"rand": [[0, 0, 0], [1, 0.5, 0.25]]},
    "opacity": {"rand": [0, 1]},
}
MOVING = {
    "position": {"in_disc": {"radius": 2, "axis": [0, 1, 1]}},
    "velocity": {"in_box": {}},
    "radius": RAND,
    "spiral_axis": {"in_box": {"min": [0.1, 1, -1]}},
}
KEYS = {"keys": [[0, 0], [0.1, 2], [0.3, -1]]}
SURFACES = [
    {"type": "gravity"},
    {"type": "bounce_plane", "resilience": 0.8, "friction": 0.1},
    {
        "type": "bounce_plane",
        "id": "wall",
        "normal": [-1, 0.2, 0],
        "point": [1, 0, 0],
        "resilience": {"rand": [0.2, 0.9]},
        "friction_threshold": 0.2,
    },
    {"type": "bounce_sphere", "center": [0, 0.5, 0], "sphere_radius": 0.7, "resilience": 0.3},
]

Case = tuple[list[Any], dict[str, Any]]
CASES: dict[str, Case] = {
    "free flight": ([], {"set": DISTRIBUTIONS}),
    "uniform linear": ([{"type": "gravity"}, {"type": "damp", "damping": 0.7}, {"type": "translate", "rate": [1, 0, 0]}], {}),
    "particle linear": (
        [{"type": "spiral", "speed": RAND}, {"type": "damp", "damping": RAND}, {"type": "gravity"}],
        {"set": MOVING},
    ),
    "spin alone": ([{"type": "spiral", "speed": {"expr": "3 * radius"}}], {"set": MOVING}),
    "vortices": (
        [
            {"type": "vortex", "magnitude": RAND, "range": 5},
            {"type": "vortex", "id": "two", "center": [1, 0, 0], "lift": 0.5, "axis": {"in_cone": {"angle": 40}}},
            {"type": "gravity"},
            {"type": "damp"},
        ],
        {"set": MOVING},
    ),
    "keys": (
        [
            {"type": "vortex", "id": f"v{k}", "magnitude": KEYS | more}
            for k, more in enumerate(
                ({}, {"interpolation": "smooth"}, {"interpolation": "step", "repeat": "loop"}, {"repeat": "mirror"})
            )
        ]
        + [{"type": "gravity", "acceleration": {"keys": [[0, [0, 0, 0]], [0.2, [1, 2, 3]]]}}],
        {"set": MOVING},
    ),
    "ramps": (
        [
            {"type": "vortex", "magnitude": {"ramp": [[0, 0], [0.3, 2], [1, -1]], "over": {"expr": "age * 3"}}},
            {"type": "damp", "damping": {"ramp": [[0, 3], [1, 0]]}},
        ],
        {"set": MOVING, "life": 0.4},
    ),
    "all functions": (
        [{"type": "damp", "damping": {"expr": re.sub(r"\bx\b", "radius", f"0.01 * ({EVERY_NUMBER})")}}],
        {"set": MOVING},
    ),
    "reading": (
        [
            {"type": "vortex", "magnitude": {"expr": "position.y * sin(time) + age - velocity.x"}},
            {"type": "gravity", "acceleration": {"expr": "vec(normalized_age, -time, frame * 0.1)"}},
        ],
        {"set": MOVING, "life": 0.35},
    ),
    "only and during": (
        [
            {"type": "gravity", "only": {"expr": "position.y > 0"}, "during": [0.1, 0.3]},
            {"type": "vortex", "only": {"expr": "age < 0.2"}},
            {"type": "damp", "during": [0.2, 9], "damping": RAND},
            {"type": "translate", "rate": [1, 1, 0], "only": {"expr": "radius > 1.5"}},
        ],
        {"set": MOVING},
    ),
    "deaths": ([{"type": "gravity"}], {"set": MOVING, "rate": 150, "life": {"rand": [0.01, 0.3]}}),
    "surfaces": (SURFACES, {"set": MOVING}),
    "sliding": ([{"type": "gravity"}, {"type": "bounce_plane", "normal": [0.2, 1, 0], "resilience": 0}], {"set": MOVING}),
    "resting": ([{"type": "gravity"}, {"type": "bounce_plane", "resilience": 0.3, "friction": 1}], {"set": MOVING, "life": 0.3}),
    "scopes": (
        [
            {"type": "gravity", "acceleration": {"in_box": {}, "per": "graph"}},
            {"type": "damp", "damping": RAND | {"per": "frame"}},
            {"type": "vortex", "magnitude": {"gauss": {}, "per": "particle"}},
        ],
        {"set": MOVING},
    ),
    "reading at birth": (
        [],
        {
            "set": {
                "radius": RAND,
                "opacity": {"expr": "radius / 3 + time"},
                "velocity": {"expr": "vec(radius, opacity, frame)"},
                "position": {"expr": "velocity * 2"},
            },
            "life": {"expr": "radius * 0.1"},
        },
    ),
    "keyed rate": ([{"type": "gravity"}], {"rate": {"keys": [[0, 0], [0.25, 100], [0.4, 10]]}, "during": [0.05, 0.42]}),
}
TIMES = {
    "": {},
    "64 bits": {"precision": 64},
    "3 steps": {"substeps": 3},
    "preroll": {"preroll": 0.13, "fps": 25, "substeps": 2},
    "sims": {"method": "sims", "substeps": 2, "precision": 64},
}


def agree(found, frames=(1, 7, 12)) -> None:
    """Assert that both ways agree at some frames, with particles at the last."""
    for frame in frames:
        machine, plain = found.simulate(frame, threads=2), found.simulate(frame, reference=True)
        assert bits(machine) == bits(plain), [
            (path, name) for path in plain for name in plain[path] if bits(machine)[path][name] != bits(plain)[path][name]
        ]
    assert all(len(next(iter(columns.values()))) for columns in machine.values() if columns)


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("case", CASES)
def test_machine_is_plain_python(case, time):
    """Every stored column has the same bits by both ways."""
    ops, emit = CASES[case]
    agree(made(ops, {"rate": 30, **emit}, TIMES[time]), (1, 12) if time == "" else (12,))


def test_expression_names_every_function():
    """The expression above calls all that there is, but what stands for a component or an operator of its own."""
    tree = made(*CASES["all functions"]).flat.nodes["act/damp"].arguments["damping"]
    used: set[str] = set()

    def visit(part: Any) -> None:
        used.add(getattr(part, "function", ""))
        for child in getattr(part, "arguments", ()):
            visit(child)

    visit(tree.tree)
    assert set(FUNCTIONS) - used <= {"component_x", "negate"}


def test_several_emitters_merged_and_forked():
    """Streams that merge and fork act on each emitter's particles by themselves."""
    nodes = {
        "other": {"type": "emit", "rate": 20, "set": {"velocity": {"on_sphere": {}}}, "life": 0.3},
        "both": {"type": "stack", "from": ["sky", "other"], "ops": [{"type": "gravity"}, {"type": "damp", "damping": RAND}]},
        "swirl": {"type": "vortex", "from": "other"},
        "second": {"type": "image", "from": ["both", "swirl"], "camera": "view", "shutter": 0.3},
    }
    agree(made(nodes=nodes, image={"from": "both"}))


def test_whole_effect():
    """A whole effect agrees, with few particles and early frames."""
    file = Path(__file__).parents[1] / "snow.json"
    document = json.loads(file.read_text())
    document["nodes"]["sky"]["rate"] = 6
    document["time"] |= {"preroll": 0.5, "frames": [1, 60]}
    agree(effect(document, folder=file.parent), (1, 60))


def test_both_ways_agree_on_what_the_shutter_sees():
    """Tails and lives are the same where particles are born, bounce, rest and die within the shutter."""
    agree(
        made(
            SURFACES,
            {"rate": 200, "life": {"rand": [0.02, 0.2]}, "set": MOVING},
            {"fps": 12, "frames": [1, 4], "substeps": 3},
            {"shutter": 0.9},
        ),
        (2, 4),
    )


def test_graph_document_is_left_alone():
    """Making a plan twice of one flat graph gives the same particles."""
    found = made(*CASES["vortices"])
    assert bits(found.simulate(6)) == bits(effect(graph(*CASES["vortices"])).simulate(6))
