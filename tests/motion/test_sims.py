"""The paper's scheme, kept as `sims`: operations in stack order, then move, then bounces. [Sims 1990]"""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from .one_particle import path
from .test_flows import turned

DT = 1 / 24
OPS = {
    "gravity": {"type": "gravity", "acceleration": [0.5, -9.81, 0]},
    "damp": {"type": "damp", "damping": 3},
    "spiral": {"type": "spiral", "speed": 6},
    "vortex": {"type": "vortex", "magnitude": 2, "center": [0.2, 0, 0]},
    "translate": {"type": "translate", "rate": [0, 0, 2]},
}
AXIS = np.array([2.0, 1.0, -2.0]) / 3


def by_hand(order, steps, start, velocity, bounce=None):
    """Return the place after Euler steps as the paper writes them."""
    P, V = np.array(start, float), np.array(velocity, float)
    for _ in range(steps):
        before = V
        for name in order:
            if name == "gravity":
                V = V + np.array(OPS[name]["acceleration"]) * DT
            elif name == "damp":
                V = V * max(1 - OPS[name]["damping"] * DT, 0)
            elif name == "spiral":
                along, angle = AXIS * (AXIS @ V), OPS[name]["speed"] * DT
                V = along + (V - along) * np.cos(angle) + np.cross(AXIS, V) * np.sin(angle)
            elif name == "vortex":
                P = turned(P, DT, (0.2, 0, 0), magnitude=2)
            else:
                P = P + np.array(OPS[name]["rate"]) * DT
        P = P + (before + V) / 2 * DT
        if bounce is not None and P[1] < 0:
            P = P * [1, -1, 1]
            V = V * [1 - bounce[1], -bounce[0], 1 - bounce[1]]
    return P, V


@pytest.mark.parametrize("order", list(permutations(OPS))[::17])
def test_scheme_keeps_stack_order(order):
    """A second of steps is the hand-written loop, operations in the order of the stack."""
    position, velocity = path([OPS[name] for name in order], (1, 2, 0.5), (1, 0, 1), method="sims", spiral_axis=[2, 1, -2])
    wanted = by_hand(order, 24, (1, 2, 0.5), (1, 0, 1))
    np.testing.assert_allclose(position[-1], wanted[0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(velocity[-1], wanted[1], rtol=0, atol=1e-12)


def test_order_matters():
    """Two orders of the stack end in two places, which is what the paper says and the exact methods do not."""
    ends = [by_hand(order, 24, (1, 2, 0.5), (1, 0, 1))[0] for order in (("gravity", "damp"), ("damp", "gravity"))]
    assert np.abs(ends[0] - ends[1]).max() > 0.1


def test_bounce_mirrors_what_has_passed():
    """What lies below the plane after a step is mirrored, and its velocity answers as the paper says."""
    ops = [OPS["gravity"], {"type": "bounce_plane", "resilience": 0.8, "friction": 0.25}]
    position, velocity = path(ops, (0, 1, 0), (1, 0, 1), frames=48, method="sims")
    wanted = by_hand(("gravity",), 48, (0, 1, 0), (1, 0, 1), (0.8, 0.25))
    np.testing.assert_allclose(position[-1], wanted[0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(velocity[-1], wanted[1], rtol=0, atol=1e-12)


def test_a_ball_climbs():
    """The paper's bounce gains energy: dropped from 1 m with resilience 1, a ball climbs to 2.98 m within 10 s."""
    position, _ = path([{"type": "gravity"}, {"type": "bounce_plane", "resilience": 1}], (0, 1, 0), frames=240, method="sims")
    assert position[:, 1].max() == pytest.approx(2.98, abs=0.01)


def test_strong_damping_hangs():
    """At d dt >= 1 falling particles hang in mid-air: they move only by half a step's gravity."""
    _, velocity = path([{"type": "gravity"}, {"type": "damp", "damping": 30}], (0, 1, 0), (1, 2, 3), method="sims")
    assert not velocity[-1].any()
