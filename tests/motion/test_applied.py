"""Applied velocities: they move the particle, and leave its own velocity alone."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from .one_particle import effect_of, path

APPLIED = {
    "translate": {"type": "translate", "rate": [1, -2, 0.5]},
    "rotate": {"type": "rotate", "center": [1, 7, 0], "axis": [0, 2, 0], "speed": 1.5},
    "scale": {"type": "scale", "center": [1, 2, 3], "rate": -0.7},
    "vortex": {"type": "vortex", "magnitude": 2, "lift": 0.3},
}
START, VELOCITY = (2.0, 5.0, -0.5), (0.3, -1.0, 0.2)


@pytest.mark.parametrize("name", APPLIED)
def test_velocity_is_left_alone(name):
    """After a second of an applied velocity the velocity has the bits that it had at birth."""
    _, velocity = path([APPLIED[name]], START, VELOCITY)
    assert (velocity == VELOCITY).all()


@pytest.mark.parametrize("name", APPLIED)
def test_one_step_is_a_thousand(name):
    """Alone, each is exact: a step of a second gives what a thousand give."""
    assert effect_of([APPLIED[name]], START).plan.emitters["one"].method == "exact"
    once, often = (path([APPLIED[name]], START, fps=fps, frames=fps)[0][-1] for fps in (1, 1000))
    np.testing.assert_allclose(once, often, rtol=0, atol=1e-11)


def test_rotation_is_right_handed_and_rigid():
    """A quarter turn about +y through (1, 7, 0) takes +z from it to +x, at any distance; heights keep their bits."""
    for radius in (1e-3, 1.0, 1e6):
        position, _ = path([APPLIED["rotate"] | {"speed": np.pi / 2}], (1, 5.125, radius), fps=1, frames=1)
        np.testing.assert_allclose(position[-1] - [1, 0, 0], [radius, 5.125, 0], rtol=0, atol=1e-15 * radius + 1e-15)


def test_rotation_keeps_the_distance():
    """Every frame lies as far from the axis as the start."""
    position, _ = path([APPLIED["rotate"]], START)
    distance = np.hypot(position[:, 0] - 1, position[:, 2])
    np.testing.assert_allclose(distance, distance[0], rtol=1e-14)


def test_scale_is_a_rate():
    """Distances from the center grow by exp(rate t): at log 2 per second they double in one, and the center stays."""
    op = APPLIED["scale"] | {"rate": float(np.log(2))}
    position, _ = path([op], (2, 2, 3))
    np.testing.assert_allclose(position[-1], [3, 2, 3], rtol=1e-14)
    ratios = [b[0] / a[0] for a, b in pairwise(position - [1, 2, 3])]
    np.testing.assert_allclose(ratios, 2 ** (1 / 24), rtol=1e-13)
    assert (path([op], (1, 2, 3))[0] == [1, 2, 3]).all()


def test_scale_of_the_whole_range_is_finite():
    """At the ends of the declared range a second from 1e8 m away is finite, in 32 bits too."""
    for rate in (-50, 50):
        for precision in (np.float32, np.float64):
            with np.errstate(all="ignore"):
                assert np.isfinite(np.exp(precision(rate)) * precision(1e8))
        assert np.isfinite(path([APPLIED["scale"] | {"rate": rate}], (1e8, -1e8, 1), fps=1, frames=1)[0]).all()
