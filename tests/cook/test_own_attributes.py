"""A graph's own attributes, the values at birth, and what follows position and velocity."""

from __future__ import annotations

import numpy as np
import pytest

from .effects import effect, graph

OWN = {"heat": {"type": "float", "default": 3, "unit": "K", "doc": "Warmth."}, "way": {"type": "vec3", "default": [1, 2, 3]}}
MOVING = {"position": {"in_box": {}}, "velocity": {"in_sphere": {}}}


def cloud(ops, sets=None, frame=5, nodes=None, show="act", source="sky", **time):
    """Return particles at a frame, in float64."""
    emit = {"count": 20, "rate": 0, "set": {**MOVING, **(sets or {})}}
    return effect(graph(ops, emit, {"precision": 64, **time}, {"from": show}, nodes, attributes=OWN)).simulate(frame)[source]


def show(expression, name="color"):
    """Return a `set` that shows an expression."""
    return {"type": "set", "id": f"show_{name}", "set": {name: {"expr": expression}}}


def test_own_attribute_has_its_default():
    """What is declared and never set has its default everywhere."""
    assert cloud([show("way * heat")])["color"].tolist() == [[3, 6, 9]] * 20


@pytest.mark.parametrize("when", ["birth", "step", "frame"])
def test_own_attribute_is_set_and_read(when):
    """It is set and read as any other, by expressions of sets, selectors and movers."""
    ops = [
        {"type": "set", "when": when, "set": {"heat": {"expr": "radius * 10"}}, "only": {"expr": "heat == 3"}},
        show("vec(heat, birth.heat, radius)"),
        {"type": "kill", "only": {"expr": "heat > 9"}},
    ]
    found = cloud(ops, {"radius": {"rand": [0.5, 1]}})["color"]
    assert np.array_equal(found[:, 0], found[:, 2] * 10) and found[:, 0].max() <= 9
    assert np.array_equal(found[:, 1], found[:, 0] if when == "birth" else np.full(len(found), 3.0))


def test_own_attribute_drives_motion():
    """A mover's parameter reads it: gravity by its own heat, exactly."""
    ops = [{"type": "gravity", "acceleration": {"expr": "vec(0, heat, 0)"}}]
    moved, still = (cloud(ops, {"heat": {"rand": [1, 9]}}, frame, fps=2)["velocity"][:, 1] for frame in (2, 1))
    drawn = cloud([show("heat", "radius")], {"heat": {"rand": [1, 9]}})["radius"]
    np.testing.assert_allclose(moved - still, drawn / 2, rtol=1e-12)


def test_mover_sees_what_a_step_sets():
    """A parameter that reads what each of two steps sets has its new value in each."""
    ops = [
        {"type": "set", "when": "step", "set": {"heat": {"expr": "heat + 1"}}},
        {"type": "gravity", "acceleration": {"expr": "vec(heat, 0, 0)"}},
    ]
    found, start = (cloud(ops, frame=frame, substeps=2, fps=1)["velocity"][:, 0] for frame in (2, 1))
    np.testing.assert_allclose(found - start, (4 + 5) / 2, rtol=1e-12)


def test_values_at_birth_stay():
    """birth.x is as it was at birth, also what a `set` gave at birth, whatever happens later."""
    ops = [
        {"type": "set", "when": "birth", "set": {"mass": {"expr": "radius + 1"}}},
        {"type": "gravity"},
        {"type": "turbulence"},
        {"type": "set", "set": {"radius": {"expr": "radius / 2"}, "mass": 0}},
        show("vec(birth.radius, birth.mass, birth.position.x)"),
    ]
    sets = {"radius": {"rand": [0.5, 1]}}
    first, later = cloud(ops, sets, 1), cloud(ops, sets, 9)
    assert np.array_equal(first["color"], later["color"]) and np.array_equal(first["color"][:, 1], first["color"][:, 0] + 1)
    assert np.array_equal(first["position"][:, 0], later["color"][:, 2]) and not np.array_equal(
        later["position"][:, 0], later["color"][:, 2]
    )


def test_rest_position_and_initial_velocity_follow_unless_set():
    """As born they are the position and the velocity; set, they are what is set."""
    ops = [
        {"type": "gravity"},
        show("rest_position"),
        {"type": "set", "id": "b", "set": {"fade_color": {"expr": "initial_velocity"}}},
        {"type": "set", "id": "c", "set": {"velocity": {"expr": "fade_color"}}, "during": [0.15, 9]},
    ]
    first, later = cloud(ops, frame=1), cloud(ops, frame=5)
    assert np.array_equal(later["color"], first["position"]) and np.array_equal(later["velocity"], first["velocity"])
    assert cloud([show("rest_position")], {"rest_position": [7, 8, 9]})["color"].tolist() == [[7, 8, 9]] * 20


def test_children_have_their_parents_rest_and_their_own_attributes():
    """A child copies where its parent belongs and its heat, unless it sets them."""
    kid = {
        "kid": {
            "type": "spawn",
            "from": "sky",
            "when": "birth",
            "set": {"position": [0, 0, 0], "heat": {"expr": "parent.heat + 1"}},
        },
        "look": {
            "type": "set",
            "from": "kid",
            "set": {"color": {"expr": "rest_position"}, "radius": {"expr": "heat"}, "opacity": {"expr": "way.z"}},
        },
    }
    sets = {"heat": {"rand": [0, 1]}, "way": {"in_sphere": {}}}
    parents = cloud([show("way.z", "opacity"), show("heat", "radius")], sets, 1)
    children = cloud([{"type": "gravity"}], sets, 1, kid, ["look", "act"], "kid")
    assert np.array_equal(children["color"], parents["position"]) and np.array_equal(children["opacity"], parents["opacity"])
    assert np.array_equal(children["radius"], parents["radius"] + 1)


def test_value_at_birth_of_what_joins_is_its_own():
    """birth.x of a child that joins an emitter's particles, or whose velocity is spread, is what that child was born with."""
    kid = {
        "kid": {"type": "spawn", "from": "sky", "when": "birth", "into": "sky", "spread": 1, "generations": 1, "set": {"mass": 7}}
    }
    ops = [{"type": "damp"}, {"type": "set", "set": {"mass": 0}}, show("vec(birth.mass, generation, length(birth.velocity))")]
    found = cloud(ops, {"velocity": [0, 0, 0]}, 3, kid)["color"]
    assert found[:, 0].tolist() == [1] * 20 + [7] * 20 and (found[:20, 2] == 0).all() and (found[20:, 2] > 0).all()
