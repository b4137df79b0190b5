"""Springs: their exact flow against a matrix exponential in extended precision, their limits, and what they do."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.math import Vec3
from graphfx.motion import spring
from graphfx.motion.linear import damped_fall, fall, spiral_fall

from .one_particle import effect_of, path
from .test_linear import RATES, STEPS, W, array, flow, vector

LONG, COMPLEX = np.longdouble, np.clongdouble
P, V, G = (1.0, -2.0, 0.5), (3.0, 4.0, -1.0), (0.3, -9.81, 0.1)
AXIS = (0.6, 0.0, 0.8)


def exponential(matrix: np.ndarray) -> np.ndarray:
    """Return e^matrix by scaling and squaring."""
    turns = max(0, int(np.ceil(np.log2(float(np.abs(matrix).max())))) + 8)
    scaled, found, term = matrix / LONG(2) ** turns, np.eye(len(matrix), dtype=COMPLEX), np.eye(len(matrix), dtype=COMPLEX)
    for n in range(1, 14):
        term = term @ scaled / LONG(n)
        found = found + term
    for _ in range(turns):
        found = found @ found
    return found


def exact(P: Any, V: Any, G: Any, d: float, w: Any, k: float, h: float) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity after h: one oscillator along w, one complex one across it."""
    P, V, G, w = (np.array(v, LONG) for v in (P, V, G, w))
    speed = np.sqrt(w @ w)
    axis = w / speed if speed > 0 else np.array([0, 0, 1], LONG)
    first = np.cross(axis, [0, 1, 0])
    first = first / np.sqrt(first @ first)
    second = np.cross(axis, first)

    def oscillator(p: Any, v: Any, f: Any, turning: Any) -> Any:
        matrix = np.array([[0, h, 0], [-LONG(k) * h, (1j * turning - LONG(d)) * h, h], [0, 0, 0]], COMPLEX)
        return (exponential(matrix) @ np.array([p, v, f], COMPLEX))[:2]

    along = oscillator(axis @ P, axis @ V, axis @ G, LONG(0))
    across = oscillator(*(first @ v + 1j * (second @ v) for v in (P, V, G)), speed)
    return tuple(
        (axis * a.real + first * z.real + second * z.imag).astype(float) for a, z in zip(along, across, strict=True)
    )  # type: ignore[return-value]


def sprung(P: Any, V: Any, G: Any, d: float, w: Any, k: float, h: float, kind: Any = np.float64) -> tuple[Any, Any]:
    """Return position and velocity after h by the engine's own functions."""
    P, V, G, w = (Vec3(*map(kind, v)) for v in (P, V, G, w))
    d, k, h = kind(d), kind(k), kind(h)
    with np.errstate(all="ignore"):
        factors = spring.spring_factors.body(d, k, h)
        if not array(w).any():
            found = spring.damped_spring.body(P, V, G, k, h, *factors)
        else:
            found = spring.spiral_spring.body(P, V, G, w, k, h, *factors, *spring.turned_factors.body(d, w, k, h))
    return array(found[0]), array(found[1])


@pytest.mark.parametrize("turning", [0.0, 1e-6, 24.0, 300.0])
@pytest.mark.parametrize("ratio", [0.0, 1e-9, 0.3, 1 - 1e-8, 1.0, 1 + 1e-8, 1.5, 50.0])
@pytest.mark.parametrize("angle", [1e-6, 0.01, 0.5, 0.99, 1.01, 10.0, 100.0])
def test_a_step_is_the_matrix_exponential(angle, ratio, turning):
    """Position and velocity after a step are exact to 5e-12, for w h from 1e-6 to 100, however damped and turned."""
    h = 1 / 24
    frequency = angle / h
    given = P, V, G, 2 * ratio * frequency, tuple(turning * a for a in AXIS), frequency**2, h
    (position, velocity), (place, speed) = sprung(*given), exact(*given)
    assert np.abs(position - place).max() <= 5e-12 * max(np.abs(place).max(), 0.1)
    assert np.abs(velocity - speed).max() <= 5e-12 * max(np.abs(speed).max(), 1e-3 * frequency)


@pytest.mark.parametrize("dt", [1e-3, 0.3, 4.0])
def test_without_stiffness_it_is_what_it_was(dt):
    """At k = 0 the flow is that of gravity, damping and turning alone; and next to 0 next to it."""
    w, nought = array(W), (0.0, 0.0, 0.0)
    pairs = [
        (sprung(P, V, G, 0.0, nought, 0.0, dt), flow(fall, vector(*P), vector(*V), vector(*G), dt)),
        (sprung(P, V, G, 1.7, nought, 0.0, dt), flow(damped_fall, vector(*P), vector(*V), vector(*G), 1.7, dt)),
        (sprung(P, V, G, 1.7, nought, 1e-14, dt), flow(damped_fall, vector(*P), vector(*V), vector(*G), 1.7, dt)),
        (sprung(P, V, G, -0.5, nought, 0.0, dt), flow(damped_fall, vector(*P), vector(*V), vector(*G), -0.5, dt)),
        (sprung(P, V, G, 1.7, w, 0.0, dt), flow(spiral_fall, vector(*P), vector(*V), vector(*G), 1.7, W, dt)),
    ]
    for general, special in pairs:
        for got, wanted in zip(general, special, strict=True):
            assert np.abs(got - wanted).max() <= 1e-12 * np.abs(wanted).max()


@pytest.mark.parametrize("dt", STEPS)
def test_nothing_extreme_is_infinite(dt):
    """For steps from 1e-12 to 1e6 s, stiffness to 1e12 and rates to 1e6 all results are finite, in both precisions."""
    for damping in RATES:
        for stiffness in (*RATES, 1e12):
            for rate in (0.0, 1e-9, 24.0, 1e6):
                for kind in (np.float32, np.float64):
                    found = sprung(P, V, G, damping, tuple(rate * a for a in AXIS), stiffness, dt, kind)
                    assert np.isfinite(found).all(), (damping, stiffness, rate, kind)


@pytest.mark.parametrize("scale", [1e-30, 1e-10, 1e10, 1e30])
def test_tiny_and_huge_states(scale):
    """Scaling the start and the constant scales the end: nothing is lost from 1e-30 to 1e30."""
    given = 1.3, tuple(2 * a for a in AXIS), 40.0
    for h in (1e-3, 0.8):
        base = sprung(P, V, G, *given, h)
        scaled = sprung(*(tuple(scale * x for x in v) for v in (P, V, G)), *given, h)
        np.testing.assert_allclose(scaled, np.multiply(base, scale), rtol=1e-13)


REST = {"rest_position": [0.5, 0, 0]}
SPRING = {"type": "spring", "frequency": 2 * np.pi, "damping_ratio": 0}


def test_swings_about_its_rest_position():
    """At a frequency of 2 pi a particle is back after a second, and at the other side of its rest position in between."""
    position, velocity = path([SPRING], (1, 2, 0), **REST)
    np.testing.assert_allclose(position[12], [0, -2, 0], rtol=0, atol=1e-13)
    np.testing.assert_allclose(position[24], [1, 2, 0], rtol=0, atol=1e-13)
    assert effect_of([SPRING], (1, 2, 0)).plan.emitters["one"].method == "exact" and np.abs(velocity[24]).max() < 1e-12


def test_gravity_shifts_the_place_of_rest():
    """Under gravity a damped spring comes to rest at q + g / k."""
    ops = [SPRING | {"damping_ratio": 1, "frequency": 7}, {"type": "gravity"}]
    position, _ = path(ops, (1, 2, 0), (3, 0, 1), frames=240, **REST)
    np.testing.assert_allclose(position[-1], [0.5, -9.81 / 49, 0], rtol=0, atol=1e-13)


def test_an_applied_velocity_shifts_the_swing():
    """Under an applied velocity u a spring swings with V + u for V: x = x0 cos w t + (V + u) / w sin w t, V = x' - u."""
    u, w, t = np.array([1.0, -2.0, 0.5]), 2 * np.pi, 0.625
    ops = [SPRING, {"type": "translate", "rate": u.tolist()}]
    position, velocity = path(ops, (1.5, 2, 0), (3, 0, 1), **REST)
    arm, swing = np.array([1.0, 2, 0]), np.array([3.0, 0, 1]) + u
    wanted = arm * np.cos(w * t) + swing / w * np.sin(w * t)
    np.testing.assert_allclose(position[15] - [0.5, 0, 0], wanted, rtol=0, atol=1e-12)
    np.testing.assert_allclose(velocity[15], swing * np.cos(w * t) - arm * w * np.sin(w * t) - u, rtol=0, atol=1e-11)


def test_damping_slows_the_own_velocity_alone():
    """In the end the own velocity is -u and the spring is stretched by (d u - w x u) / k."""
    ops = [SPRING | {"frequency": 5}, {"type": "damp", "damping": 4}, {"type": "translate", "rate": [1, 0, 0]}]
    spiral = {"type": "spiral", "speed": 2}
    for more, end in (([], [4 / 25, 0, 0]), ([spiral], [4 / 25, 0, 2 / 25])):
        position, velocity = path(ops + more, (1, 0, 0), frames=480, rest_position=[0, 0, 0], spiral_axis=[0, 1, 0])
        np.testing.assert_allclose(velocity[-1], [-1, 0, 0], rtol=0, atol=1e-12)
        np.testing.assert_allclose(position[-1], end, rtol=0, atol=1e-13)
