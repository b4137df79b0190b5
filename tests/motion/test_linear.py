"""Exact flows of linear motion against closed forms, in float64."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.math import Vec3, cross, dot, length
from graphfx.motion import linear
from graphfx.motion.linear import damped_fall, fall, spiral_fall

STEPS = [1e-12, 1e-6, 1e-3, 1 / 24, 1.0, 100.0, 1e6]
RATES = [0.0, 1e-300, 1e-9, 0.01, 1.0, 24.0, 2400.0, 1e6]


def vector(*parts: float) -> Vec3:
    return Vec3(*map(np.float64, parts))


def array(v: Any) -> np.ndarray:
    return np.array([v.x, v.y, v.z], float)


def spin(position: Vec3, velocity: Vec3, rate: Vec3, dt: Any) -> tuple[Vec3, Vec3]:
    return linear.spin.body(position, velocity, rate, dt, *linear.spin_factors.body(rate, dt))


def turn(velocity: Vec3, rate: Vec3, dt: Any) -> Vec3:
    return linear.turn.body(velocity, rate, dt, *linear.turn_factors.body(rate, dt))


def body(function: Any) -> Any:
    """Return what computes a flow: an instruction's function, or itself."""
    return getattr(function, "body", function)


def flow(function: Any, *given: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity after a flow."""
    with np.errstate(all="ignore"):
        position, velocity = body(function)(*(np.float64(g) if isinstance(g, float) else g for g in given))
    return array(position), array(velocity)


def close(got: np.ndarray, wanted: Any, rel: float) -> None:
    """Assert that two vectors differ by at most `rel` of their length."""
    wanted = np.array(wanted, float)
    assert np.abs(got - wanted).max() <= rel * max(np.abs(wanted).max(), 1e-300), (got, wanted)


@pytest.fixture(autouse=True)
def quiet():
    """Let numbers overflow and divide by zero without a word, as lanes do."""
    with np.errstate(all="ignore"):
        yield


P, V, G, W = vector(1, -2, 0.5), vector(3, 4, -1), vector(0.3, -9.81, 0.1), vector(0.6, -1.1, 0.7)


@pytest.mark.parametrize("dt", STEPS)
def test_free_fall(dt):
    """P + V t + g t^2 / 2 and V + g t."""
    position, velocity = flow(fall, P, V, G, dt)
    close(position, array(P) + array(V) * dt + array(G) * (dt * dt / 2), 1e-15)
    close(velocity, array(V) + array(G) * dt, 1e-15)


def test_velocity_along_the_axis_is_untouched():
    """A spiral does nothing to a velocity along its axis."""
    position, velocity = flow(spin, P, W * 2.0, W, 0.7)
    close(velocity, array(W) * 2, 4e-16)
    close(position, array(P) + array(W) * 2 * 0.7, 4e-16)


def test_velocity_across_the_axis_makes_a_circle():
    """After a whole turn a particle that moves across the axis is back where it was."""
    across = cross(W, V)
    rate = float(length(W))
    position, velocity = flow(spin, P, across, W, 2 * np.pi / rate)
    close(position, array(P), 1e-15 * 20)
    close(velocity, array(across), 1e-15 * 20)


def test_quarter_turn_is_right_handed():
    """About +y, +z turns to +x."""
    velocity = array(turn(vector(0, 0, 1), vector(0, 2, 0), np.float64(np.pi / 4)))
    np.testing.assert_allclose(velocity, [1, 0, 0], atol=1e-15)


FORMS = {
    "fall": (fall, (G,)),
    "damped": (damped_fall, (G, 1.7)),
    "spin": (spin, (W,)),
    "spiral": (spiral_fall, (G, 1.7, W)),
    "stiff": (spiral_fall, (G, 300.0, W * 50.0)),
    "undamped spiral": (spiral_fall, (G, 0.0, W)),
    "undamping": (damped_fall, (G, -0.5)),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("span", [1 / 24, 3.0])
def test_one_step_is_a_thousand(form, span):
    """One step gives what a thousand give, to 1e-11."""
    function, given = FORMS[form]
    values = [np.float64(g) if isinstance(g, float) else g for g in given]
    position, velocity = P, V
    for _ in range(1000):
        position, velocity = body(function)(position, velocity, *values, np.float64(span / 1000))
    once, speed = flow(function, P, V, *given, span)
    close(once, array(position), 1e-11)
    close(speed, array(velocity), 1e-11)


def test_general_form_holds_the_special_ones():
    """Gravity, damping and turning together give each alone where the others are 0."""
    nought = vector(0, 0, 0)
    for dt in (1e-3, 0.3, 4.0):
        pairs = [
            (flow(spiral_fall, P, V, G, 0.0, nought, dt), flow(fall, P, V, G, dt)),
            (flow(spiral_fall, P, V, G, 2.0, nought, dt), flow(damped_fall, P, V, G, 2.0, dt)),
            (flow(spiral_fall, P, V, nought, 0.0, W, dt), flow(spin, P, V, W, dt)),
            (flow(damped_fall, P, V, G, 0.0, dt), flow(fall, P, V, G, dt)),
        ]
        for general, special in pairs:
            close(general[0], special[0], 1e-14)
            close(general[1], special[1], 1e-14)


@pytest.mark.parametrize("dt", STEPS)
def test_nothing_extreme_is_infinite(dt):
    """For steps from 1e-12 to 1e6 s and rates from 0 to 1e6 all results are finite."""
    for damping in RATES:
        for rate in RATES:
            for kind in (np.float64, np.float32):
                cast = [Vec3(*(kind(float(c)) for c in (v.x, v.y, v.z))) for v in (P, V, G, W * np.float64(rate))]
                with np.errstate(all="ignore"):
                    result = spiral_fall.body(cast[0], cast[1], cast[2], kind(damping), cast[3], kind(dt))
                    assert all(np.isfinite(array(part)).all() for part in result), (damping, rate, kind)


def test_tiny_and_huge_speeds():
    """Speeds from 1e-30 to 1e30 are carried with no loss: scaling the start scales the end."""
    base = flow(spiral_fall, vector(0, 0, 0), V, vector(0, 0, 0), 1.3, W, 0.8)
    for scale in (1e-30, 1e-10, 1e10, 1e30):
        scaled = flow(spiral_fall, vector(0, 0, 0), V * np.float64(scale), vector(0, 0, 0), 1.3, W, 0.8)
        close(scaled[0], base[0] * scale, 1e-14)
        close(scaled[1], base[1] * scale, 1e-14)


def test_energy_of_a_turn():
    """Turning changes no speed: |V|^2 after 1e4 turns of random size is as before, to 1e-12."""
    velocity, draw = V, np.random.default_rng(1)
    for angle in draw.uniform(-3, 3, 10_000):
        velocity = turn(velocity, W * np.float64(angle), np.float64(1.0))
    assert abs(float(dot(velocity, velocity)) / 26 - 1) <= 1e-12
