"""Linear operators summed into one flow: the same in any number of steps, and in any order."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from ..motion.one_particle import effect_of, path
from .exactly import EPS, off

START, SPEED = (1.0, -2.0, 0.5), (3.0, 4.0, -1.0)
SETS = {"rest_position": [0.5, 0, 0], "spiral_axis": [1, 1, 0]}
LINEAR = [
    {"type": "spring", "frequency": 6, "damping_ratio": 0.1},
    {"type": "gravity"},
    {"type": "damp", "damping": 0.3},
    {"type": "translate", "rate": [1, -2, 0.5]},
    {"type": "spiral", "speed": 3},
    {"type": "wind", "wind": [2, 0, 1], "drag": 0.4},
    {"type": "undamp", "rate": 0.05},
]
NOISE = [{"type": "random_acceleration", "strength": 3}, {"type": "random_translate"}]
TOGETHER = [list(some) for n in (1, 2, 7) for some in combinations(LINEAR, n)] + [LINEAR + NOISE]
STIFF = [{"type": "spring", "frequency": 500}, {"type": "damp", "damping": 300}, {"type": "spiral", "speed": 50}]
UNDAMPED = [{"type": "spring", "frequency": 40, "damping_ratio": 0}, LINEAR[1], LINEAR[3]]


def named(ops: list) -> str:
    return " ".join(op["type"] for op in ops)


def apart(one: tuple, other: tuple, least: float) -> float:
    """Return how far the last states of two paths are from each other, relative to the other or to `least`."""
    return max(off(a[-1], b[-1], least) for a, b in zip(one, other, strict=True))


@pytest.mark.parametrize("span", [1 / 24, 2.0])
@pytest.mark.parametrize("ops", [*TOGETHER, STIFF, UNDAMPED], ids=named)
def test_one_step_is_a_thousand(ops, span):
    """One step gives what a thousand give, to 1e-11; in 32 bits to 1000 eps of the start."""
    assert effect_of(ops, START, SPEED, **SETS).plan.emitters["one"].method == "exact"
    for precision, bound, least in ((64, 1e-11, 1e-3), (32, 1000 * EPS[32], 1.0)):
        given = [path(ops, START, SPEED, n / span, n, precision=precision, **SETS) for n in (1, 1000)]
        assert apart(*given, least) <= bound


@pytest.mark.parametrize("ops", TOGETHER[len(LINEAR) :], ids=named)
def test_order_does_not_matter(ops):
    """Linear operators in another order give the same motion to 1e-13 after a second; in 32 bits to 24 eps."""
    orders = ops[::-1], ops[len(ops) // 2 :] + ops[: len(ops) // 2]
    for precision, bound in ((64, 1e-13), (32, 24 * EPS[32])):
        first = path(ops, START, SPEED, precision=precision, **SETS)
        for order in orders:
            assert apart(path(order, START, SPEED, precision=precision, **SETS), first, least=1) <= bound


def test_steps_of_changing_length_do_not_matter():
    """Where preroll and births make steps of their own length, the state at a time is that of one step, to 1e-12."""
    ops = [op for op in LINEAR if op["type"] != "undamp"]
    for preroll, fps in ((1.0, 7), (0.999, 24), (0.123, 60)):
        position, velocity = path(ops, START, SPEED, fps, fps, preroll=preroll, **SETS)
        whole = path(ops, START, SPEED, 1 / (1 + preroll), 1, **SETS)
        assert max(off(position[-1], whole[0][-1]), off(velocity[-1], whole[1][-1])) <= 1e-12
    assert np.isfinite(position).all()
