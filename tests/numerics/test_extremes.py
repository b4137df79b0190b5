"""Speeds from 1e-30 to 1e30 and steps from 1e-12 to 1e6 s."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.math import Vec3

from ..motion.one_particle import LIBRARY, path
from ..motion.test_linear import array, body, damped_fall, fall, spin, spiral_fall
from ..motion.test_spring import exact, sprung
from .exactly import EPS, LONG, damped, off

STEPS = [1e-12, 1e-6, 1 / 24, 1.0, 1e3, 1e6]
SPEEDS = [1e-30, 1e-10, 1.0, 1e10, 1e30]
V, AXIS = np.array([3.0, 4, -1]), np.array([0.6, 0, 0.8])
MOVING = [name for name, node in LIBRARY.items() if node.role in ("linear", "flow", "velocity", "acceleration", "noise")]


def after(function: Any, kind: Any, *given: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return the way and the velocity after a flow, from the origin."""
    cast = [Vec3(*map(kind, value)) if isinstance(value, np.ndarray) else kind(value) for value in given]
    with np.errstate(all="ignore"):
        way, velocity = body(function)(Vec3(*map(kind, (0, 0, 0))), *cast)
    return array(way), array(velocity)


@pytest.mark.parametrize("h", STEPS)
@pytest.mark.parametrize("speed", SPEEDS)
def test_linear_flows_are_exact_at_any_speed_and_step(speed, h):
    """Fall, damping with d h from 1e-6 to 100, and turning by any angle hold to 1e-12, in 32 bits to 64 eps."""
    v = V * speed
    g = v / h
    for kind, bound in ((np.float64, 1e-12), (np.float32, 64 * EPS[32])):
        if (kind is np.float32 and not 1e-36 < speed * h < 1e36) or np.abs(g).max() > 1e36:
            continue
        way, velocity = after(fall, kind, v, g, h)
        assert off(way, (v + g * (LONG(h) / 2)) * h) <= bound and off(velocity, v + g * LONG(h)) <= bound
        for product in (1e-6, 0.01, 1.0, 10.0, 60.0):
            d = product / h
            if d > 1e12 and kind is np.float32:
                continue
            way, velocity = after(damped_fall, kind, v, v * 0, d, h)
            t = LONG(h)
            assert off(way, v * damped(d, t)) <= bound * 2
            assert off(velocity, v * np.exp(-LONG(d) * t), 1e-30) <= bound * max(1, product)
        for angle in (1e-6, 0.83, np.pi):
            w = AXIS * (angle / h)
            assert abs(np.linalg.norm(after(spin, kind, v, w, h)[1] / speed) / np.linalg.norm(V) - 1) <= bound
            turned = after(spiral_fall, kind, v, v * 0, 0.0, w, h)
            assert max(off(a, b) for a, b in zip(turned, after(spin, kind, v, w, h), strict=True)) <= bound


@pytest.mark.parametrize("h", STEPS)
@pytest.mark.parametrize("angle", [1e-3, 1.0, 30.0])
@pytest.mark.parametrize("ratio", [0.0, 0.3, 1.0, 5.0])
def test_springs_are_exact_at_any_step(ratio, angle, h):
    """A spring of w h = angle meets the matrix exponential to 1e-12 of the swing for steps from 1e-12 to 1e6 s."""
    w = angle / h
    given = V * h, V, V / h, 2 * ratio * w, AXIS * (0.7 / h), w * w, h
    place, speed = sprung(*given)
    wanted, wanted_speed = exact(V, V, V, 2 * ratio * angle, AXIS * 0.7, angle**2, 1.0)
    bound = 1e-12 * max(1, angle)
    assert off(place / h, wanted, 1e-1) <= bound and off(speed, wanted_speed, 1e-1 * max(1, angle)) <= bound


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("name", MOVING)
def test_no_speed_and_no_step_leaves_the_finite_numbers(name, precision):
    """Every operator at its defaults keeps all finite: speeds 0 to 1e30, frames of 1e-6 to 1000 s, near the origin and at 1e8 m.

    What grows exponentially may leave them at 1e30 m/s and in 1000 s, but what stands still stands still.
    """
    grows = name in ("undamp", "scale")
    for fps in (1e6, 24, 1 if LIBRARY[name].role == "noise" else 1e-3):
        for speed in (0.0, 1e-30, 1.0, 1e30):
            for start in ((0, 0, 0), (1, 2, 3), (1e8, 1e8, 1e8)):
                if grows and fps < 1 and (speed or (name == "scale" and any(start))):
                    continue
                sets = {"rest_position": [0, 0, 0], "spiral_axis": [0, 1, 0]}
                states = path([{"type": name}], start, (speed, -speed, 0), fps, 3, precision=precision, **sets)
                assert np.isfinite(states).all(), (fps, speed, start)
