"""Damping with a threshold, undamping, quadratic drag and wind: exact, alone and limited."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.math import Vec3

from .one_particle import LIBRARY, effect_of, end_of, path
from .test_linear import array

H = 1 / 24
V = np.array([3.0, 4.0, -12.0])
SPEED = 13.0


def step(name: str, dt: float, velocity=V, kind=np.float64, **given):
    """Return the way and the velocity of one step of an operator from the origin."""
    node = LIBRARY[name]
    values = {"position": Vec3(*map(kind, (0, 0, 0))), "velocity": Vec3(*map(kind, velocity)), "dt": kind(dt)}
    for parameter in node.parameters.values():
        value = given.get(parameter.name, parameter.default)
        values[parameter.name] = Vec3(*map(kind, value)) if isinstance(value, tuple) else kind(value)
    with np.errstate(all="ignore"):
        return tuple(map(array, node.function(**values)))


@pytest.mark.parametrize("strength", [1e-12, 0.1, 3.0, 1e6])
def test_quadratic_drag(strength):
    """V / (1 + k |V| h) and V log(1 + k |V| h) / (k |V|), to 1e-12."""
    for dt in (1e-6, H, 100.0):
        way, velocity = step("drag", dt, strength=strength)
        x = strength * SPEED * dt
        np.testing.assert_allclose(velocity, V / (1 + x), rtol=1e-12)
        np.testing.assert_allclose(way, V * dt * np.log1p(x) / x, rtol=1e-12)


def test_drag_is_against_the_air():
    """What moves with the wind is not slowed, and all else tends to it."""
    way, velocity = step("drag", 2.0, wind=tuple(V), strength=5)
    np.testing.assert_allclose([way, velocity], [2 * V, V], rtol=1e-15)
    assert np.linalg.norm(step("drag", 1e6, wind=(1.0, 0.0, 0.0), strength=5)[1] - [1, 0, 0]) < 1e-6


EXTREMES = {
    "damp": [{"damping": d, "threshold": t} for d in (-50, 0, 1e-30, 1e6, 1e30) for t in (0, 1e-30, 1, 1e30, np.inf)],
    "undamp": [{"rate": r, "threshold": t} for r in (0, 1e-30, 50) for t in (0, 1e-30, 1, 1e30, np.inf)],
    "drag": [{"strength": k} for k in (0, 1e-30, 1, 1e6)],
}


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("name", EXTREMES)
def test_whole_range_is_finite(name, kind):
    """At the ends of every range, and speeds from 0 over 1e-30 to 1e15, a second's motion is finite, and 0 stays 0."""
    for given in EXTREMES[name]:
        for speed in (0, 1e-30, 1, 1e15):
            for dt in (0, 1e-12, H, 1):
                found = step(name, dt, (speed, 0, 0), kind, **given)
                assert np.isfinite(found).all(), (given, speed, dt)
                assert speed or not np.any(found)


FLOWS = {
    "damp": {"type": "damp", "damping": 2, "threshold": 5},
    "undamp": {"type": "undamp", "rate": 2, "threshold": 40},
    "drag": {"type": "drag", "strength": 0.3, "wind": [1, 0, 0]},
}


@pytest.mark.parametrize("name", FLOWS)
def test_alone_it_is_exact(name):
    """One step of two seconds is 2000 steps of a millisecond: position and velocity, carried once."""
    assert effect_of([FLOWS[name]], (0, 0, 0), V).plan.emitters["one"].method == "exact"
    once, often = (end_of([FLOWS[name]], (1, 2, 0), V, 2, steps) for steps in (1, 2000))
    for one, other in zip(once, often, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-11)


@pytest.mark.parametrize("flow", [FLOWS["drag"], FLOWS["undamp"] | {"threshold": 1000}], ids=["drag", "undamp"])
def test_with_others_it_is_of_second_order(flow):
    """Together with gravity and a spiral, halving the step divides the error by four: the velocity carries once."""
    ops = [flow, {"type": "gravity"}, {"type": "spiral", "speed": 4}]
    assert effect_of(ops, (0, 0, 0), V).plan.emitters["one"].method == "strang"

    def end(steps: int) -> np.ndarray:
        return end_of(ops, (0, 0, 0), V, 1, steps)[0]

    exact = end(512)
    errors = [np.linalg.norm(end(steps) - exact) for steps in (8, 16, 32)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders >= 1.9).all() and (orders < 2.4).all(), orders


def test_without_a_threshold_damping_is_linear():
    """`damp` at its default threshold, and `undamp` at its own, are summed with gravity into one exact step."""
    for op in ({"type": "damp", "damping": 2}, {"type": "undamp", "rate": 0.5}):
        told = effect_of([op, {"type": "gravity"}], (0, 0, 0)).plan.emitters["one"]
        assert (told.method, told.reason) == ("exact", f"all motion is linear ({op['type']}, gravity): one exact step")
        _, velocity = path([op, {"type": "gravity"}], (0, 0, 0), (1, 0, 0))
        d = op.get("damping") or -op["rate"]
        np.testing.assert_allclose(velocity[-1], [np.exp(-d), -9.81 * -np.expm1(-d) / d, 0], rtol=1e-13)


LIMITS = {"damp": {"expr": "mass * 0"}, "undamp": {"expr": "mass / 0"}}


@pytest.mark.parametrize("name", LIMITS)
def test_flow_and_rate_say_the_same(name):
    """At a threshold that is never met, but known only for each particle, the flow gives what the linear form gives."""
    linear, flow = path([{"type": name}], (1, 2, 0), V), path([{"type": name, "threshold": LIMITS[name]}], (1, 2, 0), V)
    for one, other in zip(linear, flow, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12)
    assert LIMITS.keys() == {other for other in LIBRARY if LIBRARY[other].exact_if and LIBRARY[other].linear}


def test_reason_of_a_lone_flow():
    """The plan says that a flow carries by the velocity, and what does not commute otherwise."""
    for ops, reason in (
        ([FLOWS["drag"]], "one flow, which carries by the velocity too (drag): one exact step"),
        (
            [FLOWS["drag"], {"type": "gravity"}],
            "flows that do not commute (drag, gravity): composed symmetrically, second order",
        ),
        (
            [{"type": "attract"}],
            "fields that change along the way (free flight, attract): composed symmetrically, second order",
        ),
    ):
        assert effect_of(ops, (0, 0, 0), V).plan.emitters["one"].reason == reason


def test_drag_falls_at_its_terminal_speed():
    """Under gravity the speed tends to sqrt(g / k)."""
    _, velocity = path([{"type": "drag", "strength": 2}, {"type": "gravity"}], (0, 0, 0), frames=240, substeps=16)
    np.testing.assert_allclose(velocity[-1], [0, -np.sqrt(9.81 / 2), 0], rtol=1e-3)


def test_wind_takes_along():
    """V tends to the wind at exp(-drag t), and with gravity to wind + g / drag, exactly."""
    ops = [{"type": "wind", "wind": [2, 0, 1], "drag": 3.0}, {"type": "gravity"}]
    _, velocity = path(ops, (0, 0, 0), (0, 1, 0))
    end = np.array([2, -9.81 / 3, 1])
    np.testing.assert_allclose(velocity[-1], end + (np.array([0, 1, 0]) - end) * np.exp(-3), rtol=1e-13)


def test_the_paper_scheme_takes_the_velocity_alone():
    """In `sims` a drag changes the velocity, and the move after it the position: (V + V') / 2 h."""
    position, velocity = path([FLOWS["drag"]], (0, 0, 0), V, frames=1, method="sims")
    np.testing.assert_allclose(position[1], (velocity[0] + velocity[1]) / 2 * H, rtol=1e-13)


@pytest.mark.parametrize("damping, threshold", [(2, 5), (30, 5), (2, 20), (30, 0.5)])
def test_the_paper_damps_to_the_threshold(damping, threshold):
    """In `sims` V' = V max(1 - d dt, min(1, threshold / |V|)), in every step."""
    op = {"type": "damp", "damping": damping, "threshold": threshold}
    _, velocity = path([op], (0, 0, 0), V, method="sims")
    wanted = V
    for _ in range(24):
        wanted = wanted * max(1 - damping * H, min(1, threshold / np.linalg.norm(wanted)))
    np.testing.assert_allclose(velocity[-1], wanted, rtol=1e-12)


def test_the_paper_undamps_to_the_threshold():
    """In `sims` V' = V min(1 + r dt, max(1, threshold / |V|)), in every step."""
    _, velocity = path([{"type": "undamp", "rate": 2, "threshold": 40}], (0, 0, 0), V, method="sims")
    wanted = V
    for _ in range(24):
        wanted = wanted * min(1 + 2 * H, max(1, 40 / np.linalg.norm(wanted)))
    np.testing.assert_allclose(velocity[-1], wanted, rtol=1e-12)


@pytest.mark.parametrize("name", FLOWS)
def test_those_that_it_does_not_act_on_fly_freely(name):
    """Where `only` or `during` keeps a flow from a particle, its velocity carries it as if there were none."""
    for more in ({"only": {"expr": "position.x > 100"}}, {"during": [0, 0.04]}):
        position, velocity = path([FLOWS[name] | more], (0, 0, 0), V, frames=2)
        first = 1 if "during" in more else 0
        assert (velocity[2] == velocity[first]).all()
        np.testing.assert_allclose(position[2] - position[1], velocity[first] * H, rtol=1e-13)
        assert ("during" in more) == bool((velocity[1] != V).any())
