"""Linear motion of any matrix: exact by its exponential, whatever the steps and the order of operators."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.motion.matrix import exponential, propagators
from graphfx.node import Library, library_roots

from .one_particle import LIBRARY
from .test_machine import RAND, bits

NODE = '''"""{name}: a linear operator."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="{writes}")
def {name}({reads}, strength: float = param({strength}, doc="Strength.")) -> Vec3:
    """Return the rate of change."""
    return {value} * strength
'''
NODES = {
    "stretch": ("velocity", "position: Vec3, rest_position: Vec3", 1.0,
                "Vec3(rest_position.x - position.x, (rest_position.y - position.y) * 9.0, position.x * 0.5 - position.z * 4.0)"),
    "shear": ("position", "position: Vec3", 0.8, "Vec3(position.y, position.z * -0.5, 0.0)"),
    "slip": ("position", "velocity: Vec3", 0.3, "Vec3(velocity.z, 0.0, velocity.x)"),
    "brake": ("velocity", "velocity: Vec3", 1.0, "Vec3(velocity.x * -0.5, velocity.y * -1e5, velocity.x)"),
    "heavy": ("velocity", "position: Vec3, mass: float", 1.0, "Vec3(position.y * mass, 0.0, 0.0)"),
}  # fmt: skip


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    """Return the library with operators of its own."""
    folder = tmp_path_factory.mktemp("mine")
    (folder / "nodes" / "operators").mkdir(parents=True)
    for name, (writes, reads, strength, value) in NODES.items():
        text = NODE.format(name=name, writes=writes, reads=reads, strength=strength, value=value)
        (folder / "nodes" / "operators" / f"{name}.py").write_text(text)
    return Library(library_roots([folder]))


TURN = {"type": "rotate", "axis": [1, 2, 3], "speed": 2.0, "center": [1, 0, 0]}
GROW = {"type": "scale", "rate": -0.4, "center": [0, 1, 0]}
SPRING = {"type": "spring", "frequency": 8}
STACKS: dict[str, list[Any]] = {
    "rotate and scale": [TURN, GROW],
    "rotate a falling particle": [TURN, {"type": "gravity"}],
    "all that is linear": [TURN, GROW, SPRING, {"type": "gravity"}, {"type": "spiral"}, {"type": "damp"}, {"type": "wind"}],
    "an anisotropic spring": [{"type": "stretch"}, {"type": "damp", "damping": 0.2}],
    "shear and slip": [{"type": "shear"}, {"type": "slip"}, {"type": "stretch"}, {"type": "translate", "rate": [1, 0, 2]}],
    "a stiff anisotropic spring": [{"type": "stretch", "strength": 1e6}, {"type": "translate", "rate": [1, 0, 2]}],
    "a stiff brake": [{"type": "brake"}, {"type": "gravity"}, TURN],
    "held noise": [TURN, {"type": "random_acceleration"}, {"type": "random_translate"}],
    "classes": [TURN | {"only": {"expr": "mass > 1"}}, {"type": "stretch", "only": {"expr": "mass < 2"}}, SPRING],
    "each with its own forces": [TURN | {"center": {"in_box": {}}}, {"type": "gravity", "acceleration": {"in_box": {}}}],
}
SET = {
    "position": {"in_box": {"min": [-1, 0.5, -1], "max": [1, 2, 1]}},
    "velocity": {"in_box": {}},
    "mass": RAND,
    "rest_position": {"in_box": {}},
}


def effect(library: Library, ops: list[Any], **time: Any) -> Effect:
    """Return the effect of particles that are born throughout the first half of a second, at times of their own."""
    more = dict(time.pop("emit", {}))
    document = {
        "graphfx": 1,
        "time": {"fps": 24, "frames": [0, 24], "precision": 64, **time},
        "nodes": {
            "sky": {"type": "emit", "rate": 30, "during": [-1, 0.5], "set": SET, **more},
            "act": {"type": "stack", "from": "sky", "ops": ops},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
        },
    }
    return Effect(flatten(document_of(document), library))


def end(library: Library, ops: list[Any], **time: Any) -> dict[str, np.ndarray]:
    """Return what is stored of the particles after a second, whose motion is exact."""
    found = effect(library, ops, **time)
    plan = found.plan.emitters["sky"]
    assert plan.method == "exact" and "one exact step, by the exponential of a matrix" in plan.reason
    last: dict[str, np.ndarray] = found.simulate(found.flat.time.last)["sky"]
    assert len(last["position"]) == 16
    return last


@pytest.mark.parametrize("name", STACKS)
def test_one_step_is_a_thousand(library, name):
    """A second in 24 steps ends at the state that 1008 give, to 1e-11, for those born within a step too."""
    once, often = (end(library, STACKS[name], fps=fps, frames=[0, fps], substeps=n) for fps, n in ((24, 1), (84, 12)))
    for part in {"position", "velocity"} & {*once}:
        np.testing.assert_allclose(often[part], once[part], rtol=0, atol=1e-11 * max(1, np.abs(once[part]).max()))


@pytest.mark.parametrize("name", ["all that is linear", "shear and slip", "classes"])
def test_order_does_not_matter(library, name):
    """In another order the operators end at the same state, to 1e-13."""
    one, other = (end(library, ops) for ops in (STACKS[name], STACKS[name][::-1]))
    for part in ("position", "velocity"):
        np.testing.assert_allclose(other[part], one[part], rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("name", STACKS)
def test_machine_is_plain_python(library, name):
    """Every stored column has the same bits by both ways, in 32 and in 64 bits, with frames that steps split."""
    for time in ({"precision": 32, "fps": 10, "frames": [0, 4]}, {"frames": [0, 5], "substeps": 2}):
        found = effect(library, STACKS[name], **time)
        machine, plain = (found.simulate(4, **how)["sky"] for how in ({"threads": 2}, {"reference": True}))
        assert bits(machine) == bits(plain)


def test_matrix_is_the_composition_of_small_flows(library):
    """It is what the symmetric composition of the flows comes to as its steps get smaller, by an order of 2."""
    ops = [TURN, SPRING, {"type": "gravity"}]
    own = [TURN | {"speed": {"expr": "2 + 0 * mass"}}, *ops[1:]]
    exact = end(library, ops)["position"]
    composed = [effect(library, own, substeps=n, method="strang") for n in (2, 4, 8)]
    assert {each.plan.emitters["sky"].method for each in composed} == {"strang"}
    errors = [np.abs(each.simulate(24)["sky"]["position"] - exact).max() for each in composed]
    assert (np.log2(np.divide(errors[:-1], errors[1:])) >= 1.9).all() and errors[-1] < 1e-2


@pytest.mark.parametrize("mass", [0.5, 1.5, 2.5])
def test_each_class_has_its_matrix(library, mass):
    """Particles move under the operators that select them as if there were no others."""
    turn, pull, own = TURN, {"type": "stretch"}, {"mass": {"rand": [mass, mass + 0.1]}}
    among = [turn | {"only": {"expr": "mass > 1"}}, pull | {"only": {"expr": "mass < 2"}}, SPRING]
    alone = [*([turn] if mass > 1 else []), *([pull] if mass < 2 else []), SPRING]
    one, other = (effect(library, ops, emit={"set": SET | own}).simulate(24)["sky"] for ops in (among, alone))
    np.testing.assert_allclose(one["position"], other["position"], rtol=0, atol=1e-12)


def test_contacts_are_found(library):
    """Particles that fall on a plane as they turn stay above it, and steps change their places by less than 1e-9."""
    ops = [TURN | {"axis": [0, 1, 0]}, {"type": "gravity"}, {"type": "bounce_plane", "resilience": 0.7}]
    one, other = (end(library, ops, substeps=n)["position"] for n in (1, 8))
    assert one[:, 1].min() >= 0
    np.testing.assert_allclose(one, other, rtol=0, atol=1e-9)


def test_parameters_that_change_are_of_second_order(library):
    """A turn whose speed is keyed is taken at the middle of each step: an order of 2."""
    ops = [TURN | {"speed": {"keys": [[0, 0], [1, 6]]}}, SPRING]
    emit = {"rate": 0, "count": 16}
    ends = [effect(library, ops, substeps=n, emit=emit).simulate(24)["sky"]["position"] for n in (1, 2, 4, 8)]
    errors = [np.abs(one - other).max() for one, other in pairwise(ends)]
    assert (np.log2(np.divide(errors[:-1], errors[1:])) >= 1.8).all(), errors


DIFFERENT = {
    "a matrix for each particle": [TURN | {"speed": RAND}, SPRING],
    "an attribute in the matrix": [{"type": "heavy"}, TURN],
    "a time to act": [TURN | {"during": [0.1, 0.4]}, SPRING],
    "a field": [TURN, SPRING, {"type": "vortex"}],
    "more than 16 classes": [{"type": "shear", "id": f"s{k}", "only": {"expr": f"mass > {k}"}} for k in range(5)],
}


@pytest.mark.parametrize("name", DIFFERENT)
def test_what_has_no_one_matrix_is_composed(library, name):
    """Operators that have no matrix in common are composed, and end at finite places."""
    found = effect(library, DIFFERENT[name], method="strang")
    assert found.plan.emitters["sky"].method == "strang"
    assert np.isfinite(found.simulate(24)["sky"]["position"]).all()


@pytest.mark.parametrize("size", [1e-9, 0.3, 20.0, 3e3])
def test_exponential_of_a_rotation(size):
    """exp of [w]x dt is the rotation by w dt, to eps times the angle."""
    found = exponential(np.array([[0, -size, 0], [size, 0, 0], [0, 0, 0]]))
    c, s = np.cos(size), np.sin(size)
    np.testing.assert_allclose(found, [[c, -s, 0], [s, c, 0], [0, 0, 1]], rtol=0, atol=4e-16 * (1 + size))


@pytest.mark.parametrize("stiffness, damping, time", [(0, 0, 2.0), (1e6, 1e5, 1 / 24), (4e4, 0, 1 / 24), (1e-8, 3.0, 10.0)])
def test_propagators_of_springs(stiffness, damping, time):
    """A free particle, over-damped, stiff and weak springs: the propagators are the closed forms, to 1e-12."""
    matrix = np.zeros((6, 6))
    matrix[:3, 3:], matrix[3:, :3], matrix[3:, 3:] = np.eye(3), -stiffness * np.eye(3), -damping * np.eye(3)
    found = propagators(matrix, time)
    ops = [{"type": "spring", "frequency": float(np.sqrt(stiffness)), "damping_ratio": 0}, {"type": "damp", "damping": damping}]
    acts = [op for op in ops if op.get("frequency") or op.get("damping")]
    sets = {"position": [1, 0, 0], "velocity": [0, 2, 0], "rest_position": [0, 0, 0]}
    emit = {"rate": 0, "count": 1, "during": [0, 1e9], "set": sets}
    given = {"fps": 1 / time, "frames": [0, 1], "emit": emit}
    ended = effect(LIBRARY, acts or [{"type": "translate", "rate": [0, 0, 0]}], **given).simulate(1)["sky"]
    wanted = np.concatenate([ended["position"][0], ended["velocity"][0] if "velocity" in ended else [0, 2, 0]])
    np.testing.assert_allclose(found[:, :6] @ [1, 0, 0, 0, 2, 0], wanted, rtol=1e-11, atol=1e-12)
