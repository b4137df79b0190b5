"""Curl noise: no divergence, an even mean square, smooth in place and time, and alike in both precisions."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from graphfx.math import Vec3, curl_noise
from graphfx.math.noise import permuted

from .one_particle import effect_of, end_of, path

DRAWN = np.random.default_rng(1990)
POINTS = DRAWN.uniform(-40, 40, (40_000, 3))


def field(points: np.ndarray, time: Any = 0.3, seed: float = 7, kind: Any = np.float64) -> np.ndarray:
    """Return the field at points."""
    x, y, z = points.astype(kind).T
    times = np.broadcast_to(np.asarray(time, kind), x.shape)
    with np.errstate(all="ignore"):
        return np.stack([*curl_noise(Vec3(x, y, z), times, np.full(x.shape, seed, kind))], axis=1)


def mean_square(points: np.ndarray, **more: Any) -> float:
    """Return the mean of u . u."""
    return float((field(points, **more) ** 2).sum(axis=1).mean())


def test_the_hash_permutes():
    """The hash takes 0 to 288 to each of them once, in both precisions to the same."""
    for kind in (np.float32, np.float64):
        numbers = permuted(np.arange(289).astype(kind))
        assert sorted(numbers.tolist()) == list(range(289))
        assert (numbers == [(34 * n * n + 10 * n) % 289 for n in range(289)]).all()


def test_nothing_gathers():
    """The divergence, by central differences, is zero to their rounding, where single slopes are of the order of 1."""
    h = 1e-5
    some = POINTS[:10_000]
    slopes = np.stack([(field(some + h * axis) - field(some - h * axis)) / (2 * h) for axis in np.eye(3)], axis=2)
    divergence = slopes[:, 0, 0] + slopes[:, 1, 1] + slopes[:, 2, 2]
    assert np.abs(divergence).max() <= 1e-7 and np.sqrt((slopes[:, 0, 0] ** 2).mean()) > 0.5


def test_mean_square_is_one_everywhere():
    """The mean of u . u is 1 within 5 %: on lattice points, between them, on edges, and at any time; there is no mean wind."""
    corners = np.floor(POINTS)
    places = [POINTS, corners, *(corners + np.array(within) for within in ((0.5, 0.5, 0.5), (0.5, 0, 0), (0.5, 0.5, 0)))]
    assert all(abs(mean_square(points) - 1) <= 0.07 for points in places)
    assert all(abs(mean_square(POINTS, time=time) - 1) <= 0.05 for time in (0, 0.5, 0.8, 1, 1.9))
    here = field(POINTS)
    assert np.abs(here.mean(axis=0)).max() <= 0.02
    assert np.abs((here**2).mean(axis=0) - 1 / 3).max() <= 0.02


def test_far_places_later_times_and_other_seeds_differ():
    """Two cells on, two changes later, or under another seed the field has nothing to do with what it was."""
    some = POINTS[:10_000]
    here = field(some).ravel()
    others = [field(some + np.array([2, 0, 0])), field(some + np.array([0, 3, 1])), field(some, time=2.3)]
    others += [field(some, seed=seed) for seed in (8, 0, 296, 83520)]
    assert all(abs(np.corrcoef(here, other.ravel())[0, 1]) <= 0.05 for other in others)


@pytest.mark.parametrize("what", ["place", "time"])
def test_smooth(what):
    """Through cells and changes the field has no jump, and its slope has none."""
    x = np.linspace(-2.0, 2.0, 40_001)
    points = np.stack([x, 0.3 + 0 * x, -0.7 + 0 * x], axis=1) if what == "place" else np.full((len(x), 3), [0.2, 0.9, 5.4])
    values = field(points, time=0.3 if what == "place" else x)
    step = x[1] - x[0]
    slope = np.diff(values, axis=0) / step
    assert np.abs(slope).max() <= 12 and np.abs(np.diff(slope, axis=0)).max() <= 150 * step


def test_precisions_agree():
    """float32 gives what float64 gives at the same numbers, to 2e-5."""
    points = POINTS.astype(np.float32)
    assert np.abs(field(points, time=0.25, kind=np.float32) - field(points.astype(float), time=0.25)).max() <= 2e-5


def test_repeats_after_289_cells():
    """All repeats after 289 cells along each axis."""
    points = np.round(POINTS * 64) / 64
    here = field(points)
    for axis in np.eye(3):
        assert (field(points + 289 * axis) == here).all()


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_far_away_is_finite(kind):
    """Out to 1e30 cells, at times to 1e30 and for all seeds the field is finite and no faster than 4."""
    for scale in (1e-30, 1.0, 1e7, 1e12, 1e30):
        for time in (0.0, -1e-20, 1e8, 1e30):
            for seed in (0, 288, 289, 83520):
                found = field(POINTS[:100] * scale, time, seed, kind)
                assert np.isfinite(found).all() and np.abs(found).max() <= 4


STIR = {"type": "curl_noise", "speed": 2, "size": 0.7}


def test_stirring_leaves_the_velocity_alone():
    """It is an applied velocity, at its field's speed: the mean speed of a path is near that given."""
    position, velocity = path([STIR], (0, 0, 0), (0, 0, 0), frames=480)
    assert not velocity.any()
    speed = np.linalg.norm(np.diff(position, axis=0), axis=1) * 24
    assert 1.3 <= speed.mean() <= 2.5 and speed.max() < 5


MIXED = [STIR, {"type": "gravity"}, {"type": "turbulence", "strength": 5}]


@pytest.mark.parametrize("ops", [[STIR], MIXED], ids=["alone", "mixed"])
def test_second_order(ops):
    """Halving the step divides the error by four."""
    assert effect_of(ops, (0, 0, 0), (1, 0, 0)).plan.emitters["one"].method == "strang"
    ends = [end_of(ops, (0.1, 0.2, 0.3), (0.3, 0, 0), 1, steps)[0] for steps in (64, 128, 256, 512, 4096)]
    errors = [np.linalg.norm(end - ends[-1]) for end in ends[:-1]]
    orders = np.log2([a / b for a, b in pairwise(errors)])
    assert orders.mean() >= 1.8, orders


def test_turbulence_is_the_same_field():
    """At rest, a short step of turbulence gives the velocity that curl noise would apply, times dt."""
    _, velocity = path([{"type": "turbulence", "strength": 3, "size": 2, "seed": 5}], (1, 2, 3), fps=1e6, frames=1)
    wanted = field(np.array([[0.5, 1, 1.5]]), time=0.25e-6, seed=5)[0] * 3e-6
    np.testing.assert_allclose(velocity[1], wanted, rtol=1e-5)
