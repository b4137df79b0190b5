"""Only what the scene needs: columns, nodes and draws that no output depends on are not there."""

from __future__ import annotations

from typing import Any

import pytest

from graphfx.errors import GraphError
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.plan.listing import listing
from graphfx.plan.make import Plan, make_plan
from graphfx.program import Call, Draw, Uniform

LIBRARY = Library(library_roots())
RAND = {"rand": [0, 1]}
MOVING = {"velocity": [1, 0, 0]}


def plan(
    ops: list[Any] = (),
    emit: dict[str, Any] | None = None,
    image: dict[str, Any] | None = None,
    nodes: dict[str, Any] | None = None,
    **time: Any,
) -> Plan:
    """Return the plan of emitter `sky`, stack `act` of the operators, and image `frames`."""
    document = {
        "graphfx": 1,
        "time": {"fps": 24, "frames": [1, 25], **time},
        "nodes": {
            "sky": {"type": "emit", **(emit or {})},
            **({"act": {"type": "stack", "from": "sky", "ops": list(ops)}} if ops else {}),
            **(nodes or {}),
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act" if ops else "sky", "camera": "view", **(image or {})},
        },
    }
    return make_plan(flatten(document_of(document), LIBRARY))


def columns(*given: Any, **more: Any) -> set[str]:
    """Return the names of the stored columns."""
    return set(plan(*given, **more).emitters["sky"].attributes.columns)


def test_preview_needs_no_radius() -> None:
    """A preview stores neither the radius nor what is set of the tail alone, unless something else reads them."""
    varied = {"set": {"position": {"in_box": {}}, "velocity": {"in_box": {}}, "radius": RAND, "opacity": RAND}}
    ops = [{"type": "gravity"}, {"type": "set", "set": {"tail.color": {"expr": "velocity"}, "tail.opacity": RAND}}]
    assert columns(ops, varied) == {"position", "velocity", "radius", "opacity", "tail", "tail.color", "tail.opacity", "id"}
    assert columns(ops, varied, {"type": "preview"}) == {"position", "velocity", "opacity", "tail", "id"}
    grows = [{"type": "gravity"}, {"type": "vortex", "magnitude": {"expr": "radius"}}]
    assert "radius" in columns(grows, varied, {"type": "preview"})
    assert "radius" in columns(ops, varied, {"type": "preview"}, {"other": {"type": "image", "from": "sky", "camera": "view"}})


GRAVITY, SPIRAL, VORTEX = {"type": "gravity"}, {"type": "spiral"}, {"type": "vortex"}
SETS = {"position": {"in_box": {}}, "velocity": {"in_box": {}}, "spiral_axis": {"in_box": {}}}
STORED: dict[str, tuple[tuple[Any, ...], dict[str, Any], set[str]]] = {
    "nothing differs": ((), {}, set()),
    "places differ": (([], {"set": {"position": {"in_box": {}}}}), {}, {"position"}),
    "all move alike": (([], {"set": MOVING}), {}, {"position", "tail"}),
    "no motion blur": (([], {"set": MOVING}, {"shutter": 0}), {}, {"position"}),
    "gravity": (([GRAVITY],), {}, {"position", "velocity", "tail"}),
    "a vortex alone": (([VORTEX],), {}, {"position", "tail"}),
    "axis without spiral": (([GRAVITY], {"set": SETS}), {}, {"position", "velocity", "tail"}),
    "axis with spiral": (([SPIRAL], {"set": SETS}), {}, {"position", "velocity", "spiral_axis", "tail"}),
    "one axis for all": (([SPIRAL], {"set": {**SETS, "spiral_axis": [1, 0, 0]}}), {}, {"position", "velocity", "tail"}),
    "draws at birth alone": (([], {"set": {"radius": RAND}}), {}, {"radius"}),
    "draws later": (([{"type": "spiral", "speed": RAND}],), {}, {"position", "velocity", "tail", "id"}),
    "one draw for all": (([{"type": "spiral", "speed": RAND | {"per": "graph"}}],), {}, {"position", "velocity", "tail"}),
    "one life for all": (([], {"life": 3}), {}, {"birth"}),
    "lives differ": (([], {"life": RAND}), {}, {"birth", "life"}),
    "age is read": (([{"type": "damp", "damping": {"expr": "age"}}],), {}, {"position", "velocity", "tail", "birth"}),
    "mass is not read": (([], {"set": {"mass": RAND}}), {}, set()),
    "read by another's set alone": (([], {"set": {"mass": RAND, "radius": {"expr": "mass * 2"}}}), {}, {"radius"}),
    "a surface": (([GRAVITY, {"type": "bounce_plane"}],), {}, {"position", "velocity", "tail", "resting"}),
}


@pytest.mark.parametrize("case", STORED)
def test_only_what_is_read_and_differs_is_stored(case):
    """A column is stored only if something kept reads it and particles differ in it."""
    given, more, wanted = STORED[case]
    assert columns(*given, **more) == wanted


def test_constants_are_not_stored_but_known():
    """What is one for all takes no bytes, and its value stands in the plan."""
    emitter = plan([], {"set": {**MOVING, "radius": {"expr": "0.5 / 2"}, "opacity": 0.25}}).emitters["sky"]
    assert emitter.constants["radius"] == 0.25 and emitter.constants["opacity"] == 0.25


DROPPED = {
    "enabled": ({"type": "gravity", "enabled": False}, "not enabled"),
    "neutral gravity": ({"type": "gravity", "acceleration": [0, 0, 0]}, "it does nothing: length(acceleration) == 0"),
    "neutral damp": ({"type": "damp", "damping": 0}, "it does nothing: damping == 0"),
    "neutral vortex": ({"type": "vortex", "magnitude": 0}, "it does nothing: magnitude == 0 and lift == 0"),
    "before": ({"type": "gravity", "during": [-5, -1]}, "acts from -5 to -1 s, outside the simulated 0 to 1 s"),
    "after": ({"type": "gravity", "during": [2, 3]}, "acts from 2 to 3 s, outside the simulated 0 to 1 s"),
    "empty": ({"type": "gravity", "during": [0.5, 0.5]}, "acts from 0.5 to 0.5 s, outside the simulated 0 to 1 s"),
}
KEPT = [
    {"type": "vortex", "magnitude": 0, "lift": 1},
    {"type": "damp", "damping": {"keys": [[0, 0], [1, 0]]}},
    {"type": "damp", "damping": {"rand": [0, 0]}},
    {"type": "gravity", "during": [1, 2]},
    {"type": "gravity", "during": [-1, 0.01]},
]


@pytest.mark.parametrize("case", DROPPED)
def test_idle_operators_are_dropped_with_the_reason(case):
    """An operator that does nothing is not in the program, and the plan says why."""
    operator, reason = DROPPED[case]
    made = plan([operator], {"set": MOVING})
    path = f"act/{operator['type']}"
    assert made.schedule.dropped == {path: reason}
    assert made.emitters["sky"].operators == [] and f"dropped {path}" in listing(made)


@pytest.mark.parametrize("operator", KEPT)
def test_operators_that_may_act_are_kept(operator):
    """What acts at some instant, or whose values are not constant, stays."""
    assert plan([operator], {"set": MOVING}).schedule.dropped == {}


def test_during_counts_the_preroll():
    """Time before the first frame is simulated too."""
    assert plan([{"type": "gravity", "during": [-2, -1]}], preroll=3).schedule.dropped == {}


def test_nodes_that_no_output_needs():
    """Emitters with their operators, and cameras, that no image depends on are dropped; a disabled image does not count.

    A stack that no image takes still acts on the particles of an emitter that one does take.
    """
    nodes = {
        "idle": {"type": "emit"},
        "swirl": {"type": "vortex", "from": "idle"},
        "after": {"type": "vortex", "from": "sky"},
        "far": {"type": "camera"},
        "second": {"type": "image", "from": "swirl", "camera": "far", "enabled": False},
    }
    made = plan(nodes=nodes)
    unread = "no output depends on it"
    assert made.schedule.dropped == {"idle": unread, "swirl": unread, "far": unread, "second": "not enabled"}
    assert list(made.emitters) == ["sky"] and [node.path for node in made.emitters["sky"].operators] == ["after"]


def test_no_output_is_an_error():
    """A graph without an enabled image says what to do."""
    with pytest.raises(GraphError, match="the graph has no output: give it an enabled node of type 'image'"):
        plan(image={"enabled": False})


def test_streams_pass_over_what_is_dropped():
    """What follows a dropped operator takes the stream that it took."""
    nodes = {"a": {"type": "gravity", "from": "sky", "enabled": False}, "b": {"type": "damp", "from": "a"}}
    made = plan(nodes=nodes, image={"from": "b"}, emit={"set": MOVING})
    assert made.schedule.through["b"] == ("sky",) and [node.path for node in made.emitters["sky"].operators] == ["b"]


def test_order_is_topological_with_ties_as_written():
    """Nodes run after what they take from; among free ones the document's order holds, so operators are in stack order."""
    nodes = {
        "late": {"type": "damp", "from": "early"},
        "early": {"type": "gravity", "from": "sky"},
        "also": {"type": "vortex", "from": "sky"},
    }
    made = plan(nodes=nodes, image={"from": ["late", "also"]}, emit={"set": MOVING})
    assert made.schedule.order == ["sky", "early", "late", "also", "view", "frames"]
    stack = plan([VORTEX, GRAVITY, {"type": "damp"}, SPIRAL])
    assert [node.path for node in stack.emitters["sky"].operators] == ["act/vortex", "act/gravity", "act/damp", "act/spiral"]


def test_distribution_draws_once():
    """One value of three numbers takes one draw; a constant takes none."""
    birth = plan([], {"set": {"position": {"in_box": {}}, "radius": 0.5, "color": [1, 0, 0]}}).emitters["sky"].programs[0]
    assert sum(isinstance(instruction, Draw) for instruction in birth.walk()) == 1
    assert sum(isinstance(instruction, Call) for instruction in birth.walk()) <= 2


def calls(made: Plan) -> list[str]:
    """Return the names of the functions that the main program calls."""
    main = made.emitters["sky"].main
    assert main is not None
    return [instruction.function.name for instruction in main.program.walk() if isinstance(instruction, Call)]


@pytest.mark.parametrize(
    "value, constants, steps, instructions",
    [
        ({"expr": "sin(1) * exp(0.5) / 3"}, 1, 0, 0),
        ({"expr": "sin(time) * exp(0.5) / 3"}, 0, 1, 0),
        ({"keys": [[0, 0], [1, 2]]}, 0, 1, 0),
        ({"expr": "sin(age)"}, 0, 0, 1),
    ],
)
def test_values_are_found_at_the_slowest_rate_that_serves(value, constants, steps, instructions):
    """A constant is found with the plan, time's once a step, a particle's by instructions."""
    made = plan([{"type": "vortex", "magnitude": value}], {"set": MOVING}, substeps=3)
    main = made.emitters["sky"].main
    assert main is not None
    vortex = [
        instruction
        for instruction in main.program.walk()
        if isinstance(instruction, Call) and instruction.function.name == "vortex"
    ]
    magnitudes = [call.operands[4] for call in vortex]
    assert len(vortex) == 3
    assert all(isinstance(m, Uniform) and m.value is not None for m in magnitudes) == bool(constants)
    assert all(isinstance(m, Uniform) and m.value is None for m in magnitudes) == bool(steps)
    assert [len(step.exports) for _, step in main.steps] == [steps] * 3
    assert calls(made).count("sin") == 3 * instructions


def test_drawn_values_are_found_once_for_all_steps():
    """A draw that stays the same is made once, not in every substep."""
    made = plan([{"type": "spiral", "speed": RAND}, {"type": "damp", "damping": RAND}], substeps=4)
    main = made.emitters["sky"].main
    assert main is not None and sum(isinstance(instruction, Draw) for instruction in main.program.walk()) == 2


@pytest.mark.parametrize("prune", [True, False])
def test_same_graph_same_plan(prune):
    """Planning twice gives the same listing, letter for letter."""
    document = {
        "graphfx": 1,
        "nodes": {
            "sky": {"type": "emit", "life": RAND, "set": SETS},
            "act": {
                "type": "stack",
                "from": "sky",
                "ops": [VORTEX, {"type": "spiral", "speed": RAND}, GRAVITY, {"type": "bounce_plane"}],
            },
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view"},
        },
    }
    texts = [listing(make_plan(flatten(document_of(document), Library(library_roots())), prune=prune)) for _ in range(2)]
    assert texts[0] == texts[1] and "spiral" in texts[0]


@pytest.mark.parametrize("rate", [[1, 0, 0], [0, 0, 0]])
def test_stacks_may_be_long(rate):
    """Thousands of operators, kept or dropped, are planned; nothing goes as deep as they are many."""
    many = 2000
    made = plan([{"type": "translate", "rate": rate}] * many)
    assert len(made.emitters["sky"].operators) == (many if any(rate) else 0)
