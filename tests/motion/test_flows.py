"""Vortices, alone and together, and the order of what is composed of flows."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.plan.make import make_plan

from .one_particle import LIBRARY, effect_of, end_of, path
from .test_linear import array, vector

VORTEX = LIBRARY["vortex"].function


def turned(position, dt, center=(0, 0, 0), axis=(0, 1, 0), magnitude=1.0, tightness=1.5, reach=np.inf, lift=0.0):
    """Return the position after a vortex."""
    numbers = [np.float64(number) for number in (magnitude, tightness, reach, lift)]
    with np.errstate(all="ignore"):
        return array(VORTEX(vector(*position), np.float64(dt), vector(*center), vector(*axis), *numbers))


@pytest.mark.parametrize(
    "radius, tightness, magnitude", [(1, 0, 1), (2, 1, 3), (0.5, 1.5, -2), (3, 2, 5), (1e-3, 4, 1), (1e8, 0.5, 1)]
)
def test_quarter_turn_falls_off_with_radius(radius, tightness, magnitude):
    """A turn takes magnitude / R^tightness dt; a right-handed quarter about +y takes +z to +x, off the axis's origin too."""
    dt = np.pi / 2 / (abs(magnitude) / radius**tightness)
    after = turned((4, 70, -2 + radius), dt, (4, 7, -2), (0, 1, 0), magnitude, tightness)
    np.testing.assert_allclose(after - [4, 70, -2], [np.sign(magnitude) * radius, 0, 0], rtol=0, atol=2e-12 * radius + 1e-15)


def test_fade_ends_at_the_range():
    """At the range and beyond there is no turn, and just within it next to none."""
    for R, most in ((2.0, 0), (2.5, 0), (1.999, 1e-5)):
        assert abs(turned((R, 0, 0), 1.0, magnitude=10, reach=2.0)[2]) <= most
    assert abs(turned((1, 0, 0), 1.0, magnitude=1, reach=2.0)[2]) > 0.4


def test_lift_is_a_speed_along_the_axis():
    """Lift carries along the axis at lift / R^tightness, and keeps R."""
    after = turned((0, 0, 2), 0.5, axis=(0, 1, 0), magnitude=0.0, tightness=1, lift=3)
    np.testing.assert_allclose(after, [0, 0.75, 2], rtol=1e-14)


FIELDS = {
    "three vortices": [
        {"type": "vortex", "magnitude": 3},
        {"type": "vortex", "id": "b", "center": [1.5, 0, 0], "magnitude": -2, "axis": [0.3, 1, 0]},
        {"type": "vortex", "id": "c", "center": [0, 1, 1], "magnitude": 2, "axis": [1, 0, 0]},
    ],
    "two vortices": [
        {"type": "vortex", "magnitude": 3},
        {"type": "vortex", "id": "b", "center": [1.5, 0, 0], "magnitude": -2, "axis": [0.3, 1, 0]},
    ],
    "vortex and gravity": [{"type": "vortex", "magnitude": 3}, {"type": "gravity"}, {"type": "damp", "damping": 0.5}],
    "moving vortex": [{"type": "vortex", "magnitude": 2, "center": {"expr": "vec(time, 0, sin(2 * time))"}}, {"type": "gravity"}],
}


@pytest.mark.parametrize("ops", FIELDS)
def test_composition_is_of_second_order(ops):
    """Halving the step divides the error by four."""

    def end(steps: int) -> np.ndarray:
        return end_of(FIELDS[ops], (0.7, 0.2, 0.4), (0.3, 1, 0), 1, steps)[0]

    exact = end(2048)
    errors = [np.linalg.norm(end(steps) - exact) for steps in (32, 64, 128)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders >= 1.9).all() and (orders < 2.4).all(), orders


def test_methods_are_told_with_their_reasons():
    """All-linear motion is exact; flows are composed; the paper's scheme is used when asked for."""
    told = [
        effect_of(ops, (0, 0, 0), (1, 0, 0), method=method).plan.emitters["one"]
        for ops, method in (
            ([{"type": "gravity"}, {"type": "spiral"}], "strang"),
            ([{"type": "gravity"}, {"type": "damp", "damping": {"keys": [[0, 1], [1, 2]]}}], "strang"),
            ([{"type": "damp", "damping": {"expr": "abs(position.y)"}}, {"type": "gravity"}], "strang"),
            ([{"type": "damp", "damping": {"expr": "2 * mass"}}, {"type": "gravity"}], "strang"),
            (FIELDS["two vortices"], "strang"),
            ([{"type": "gravity"}], "sims"),
        )
    ]
    assert [(plan.method, plan.reason) for plan in told] == [
        ("exact", "all motion is linear (gravity, spiral): one exact step"),
        ("exact", "all motion is linear (gravity, damp): exact but for damp, taken at the middle of each step"),
        ("exact", "all motion is linear (damp, gravity): exact but for damp, taken at the middle of each step"),
        ("exact", "all motion is linear (damp, gravity): one exact step"),
        ("strang", "flows that do not commute (free flight, vortex, vortex): composed symmetrically, second order"),
        ("sims", "asked for: the paper's scheme, first order, operations in stack order"),
    ]


def test_one_vortex_is_exact():
    """One vortex and nothing else is an exact flow: one step is a thousand, and the plan says so."""
    found = effect_of(FIELDS["two vortices"][:1], (1, 2, 0.5))
    assert found.plan.emitters["one"].method == "exact"
    once, often = (path(FIELDS["two vortices"][:1], (1, 2, 0.5), fps=fps, frames=fps)[0][-1] for fps in (1, 1000))
    np.testing.assert_allclose(once, often, rtol=0, atol=1e-11)


SWAY = '''"""Sway: dP/dt = cos(time)."""

from graphfx.math import Vec3, cos
from graphfx.node import operator


@operator.flow(writes="position")
def sway(position: Vec3, dt: float, time: float) -> Vec3:
    """Return the position after dt."""
    return position + Vec3(cos(time) * dt, dt * 0.0, dt * 0.0)
'''


def test_a_flow_that_reads_the_time_is_not_called_exact(tmp_path):
    """A flow that differs from time to time is taken at the middle of each step, and the plan does not call it exact."""
    file = tmp_path / "nodes" / "operators" / "sway.py"
    file.parent.mkdir(parents=True)
    file.write_text(SWAY)
    document = {
        "graphfx": 1,
        "nodes": {
            "sky": {"type": "emit"},
            "act": {"type": "sway", "from": "sky"},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view"},
        },
    }
    plan = make_plan(flatten(document_of(document), Library(library_roots([tmp_path]))))
    assert plan.emitters["sky"].method == "strang"


RESISTED = '''"""Resisted: dV/dt = -|V| V."""

from graphfx.math import Vec3, length
from graphfx.node import operator


@operator.acceleration
def resisted(velocity: Vec3) -> Vec3:
    """Return the acceleration."""
    return velocity * -length(velocity)
'''


def test_an_acceleration_that_reads_the_velocity_is_of_second_order(tmp_path):
    """It is taken half way: V / (1 + V t) is met at an order of 2, with gravity beside it or alone."""
    file = tmp_path / "nodes" / "operators" / "resisted.py"
    file.parent.mkdir(parents=True)
    file.write_text(RESISTED)
    errors = []
    for steps in (8, 16, 32):
        document = {
            "graphfx": 1,
            "time": {"fps": 1, "frames": [0, 1], "precision": 64, "substeps": steps},
            "nodes": {
                "sky": {"type": "emit", "rate": 1, "during": [-1, 0.5], "set": {"velocity": [3, 0, 0]}},
                "act": {"type": "resisted", "from": "sky"},
                "view": {"type": "camera"},
                "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
            },
        }
        found = Effect(flatten(document_of(document), Library(library_roots([tmp_path])))).simulate(1)["sky"]
        errors.append(abs(found["velocity"][0, 0] - 0.75) + abs(found["position"][0, 0] - np.log(4)))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders >= 1.8).all(), orders
