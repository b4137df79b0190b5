"""Free fall and its end under damping."""

from __future__ import annotations

import numpy as np
import pytest

from ..motion.one_particle import path
from .exactly import EPS, at, off

GRAVITY = {"type": "gravity", "acceleration": [0.5, -9.8125, 2]}
G, START, SPEED = np.array(GRAVITY["acceleration"]), np.array([1.0, 2, 3]), np.array([1.0, -2, 0.5])


@pytest.mark.parametrize("frames, substeps", [(1, 1), (240, 1), (2400, 1), (2400, 100)])
def test_free_fall_is_a_parabola_after_any_number_of_steps(frames, substeps):
    """After 10 s in 1 to 240 000 steps P + V t + g t^2 / 2 and V + g t hold to 1e-11; in 32 bits to (2 + n / 2) eps."""
    wanted = START + SPEED * 10 + G * 50, SPEED + G * 10
    for precision, bound in ((64, 1e-11), (32, (2 + frames * substeps / 2) * EPS[32])):
        ends = path([GRAVITY], START, SPEED, frames / 10, frames, substeps=substeps, precision=precision)
        assert all(off(end[-1], exact) <= bound for end, exact in zip(ends, wanted, strict=True))


@pytest.mark.parametrize("product", [0.01, 0.1, 1.0, 10.0, 100.0])
def test_a_damped_fall_ends_at_its_terminal_velocity(product):
    """Where d h is .01 to 100 a fall ends at g / d, to 1e-12, and goes on evenly; in 32 bits to (4 + 1 / d h) eps."""
    d, frames = product * 24, max(3, int(50 / product))
    for precision, bound in ((64, 1e-12), (32, (4 + 1 / product) * EPS[32])):
        ops = [{"type": "damp", "damping": d}, GRAVITY]
        position, velocity = path(ops, (0, 0, 0), SPEED, 24, frames, precision=precision)
        assert off(velocity[-1], G / d) <= bound
        if precision == 64:
            assert off(position[-1] - position[-2], G / d * float(at(1, 24))) <= 1e-12
