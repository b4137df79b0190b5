"""One vortex, which is exact, and two, which are composed."""

from __future__ import annotations

import numpy as np
import pytest

from ..motion.one_particle import end_of, path
from .exactly import EPS, LONG

CENTER = np.array([4.0, 7, -2])


def vortex(magnitude: float, tightness: float, **more) -> list:
    return [{"type": "vortex", "magnitude": magnitude, "tightness": tightness, **more}]


@pytest.mark.parametrize("magnitude", [1.0, -300.0])
@pytest.mark.parametrize("tightness", [0, 0.5, 1, 1.5, 4])
@pytest.mark.parametrize("R", [1e-3, 1.0, 1e4, 1e8])
def test_a_vortex_keeps_its_radius(R, tightness, magnitude):
    """R drifts by at most 1e-12 in 1000 steps, and they lead where one does, to 1e-11 + 100 eps theta.

    One step turns by theta = magnitude / R^tightness, and keeps the height. In 32 bits R drifts by at most 500 eps, and
    the turn by as much and by what theta changes with R.
    """
    theta = LONG(abs(magnitude)) / LONG(R) ** LONG(tightness)
    start = np.array([0.6 * R, 0.5, 0.8 * R])
    single = 500 + (8 + 500 * tightness) * theta
    for precision, drift, turn in ((64, 1e-12, 1e-11 + 100 * EPS[64] * theta), (32, 500 * EPS[32], single * EPS[32])):
        once, often = (path(vortex(magnitude, tightness), start, fps=n, frames=n, precision=precision)[0][-1] for n in (1, 1000))
        assert once[1] == often[1] == 0.5
        for end in (once, often):
            assert abs(np.hypot(end[0], end[2]) / R - 1) <= drift
        assert np.abs(once - often).max() / R <= turn
        wanted = (0.6 * np.cos(theta) + np.sign(magnitude) * 0.8 * np.sin(theta)) * LONG(R)
        assert abs(once[0] - wanted) / R <= (4 + 8 * theta) * EPS[precision]


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("tightness", [0, 1.5, 4, 8])
def test_no_distance_from_the_axis_is_too_small_or_too_large(tightness, precision):
    """On the axis nothing moves, at any height; at R = 1e-200 and 1e200, and at the ends of 32 bits, all stays finite."""
    ends = (1e-200, 1e200, 1e-30, 1e30) if precision == 64 else (1e-40, 1e-30, 1e30, 3e38)
    for lift in (0.0, 2.0):
        ops = vortex(5, tightness, lift=lift)
        for height in (0.0, 1e30):
            position, _ = path(ops, (0, height, 0), frames=3, precision=precision)
            assert (position == np.array([0, height, 0], np.float32 if precision == 32 else float)).all()
        for R in ends:
            assert np.isfinite(path(ops, (R, 0, 0), frames=3, precision=precision)[0]).all()


def test_two_vortices_are_of_second_order():
    """Composed by `strang`, halving the step of two vortices gains an order of at least 1.9."""
    ops = vortex(3, 1.5) + vortex(-2, 1.5, id="other", center=[1.5, 0, 0], axis=[0.3, 1, 0])

    def end(steps: int) -> np.ndarray:
        return end_of(ops, (0.7, 0.2, 0.4), (0, 0, 0), 2, steps, method="strang")[0]

    exact = end(1024)
    errors = [np.linalg.norm(end(steps) - exact) for steps in (16, 32, 64)]
    assert (np.log2(np.divide(errors[:-1], errors[1:])) >= 1.9).all()
