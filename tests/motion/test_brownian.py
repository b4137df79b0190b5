"""Brownian noise: one path W for each particle, whatever the frames and steps, and motion that comes nearer to it by order 1."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from graphfx.math.random import counter_of, key_of, philox4x32, uniform
from graphfx.motion.clock import GRID

from .one_particle import path
from .test_machine import bits, effect_of

PUSH = {"type": "random_acceleration", "strength": 2.0, "process": "brownian"}
SHIFT = {"type": "random_translate", "speed": 2.0, "process": "brownian"}
OMEGA, DAMPING = 2 * np.pi, 3.0
SPRING = [PUSH, {"type": "spring", "frequency": OMEGA, "damping_ratio": 0}, {"type": "damp", "damping": DAMPING}]
REST = {"position": [0, 0, 0], "velocity": [0, 0, 0], "rest_position": [0, 0, 0]}
CELL = 1 / 24


def draw(place: int, cell: int, life: int = 0) -> np.ndarray:
    """Return the normal numbers of a place in a cell, for the first particle of `one` under PUSH."""
    counter = counter_of(0, life % 8 * 2**21 + place, cell & 0xFFFFFFFF)
    a, b, c, d = (uniform(word) for word in philox4x32(counter, key_of(0, "one", "act/random_acceleration")))
    first, second = np.sqrt(-2 * np.log(1 - a)), np.sqrt(-2 * np.log(1 - c))
    return np.array([first * np.cos(2 * np.pi * b), first * np.sin(2 * np.pi * b), second * np.cos(2 * np.pi * d)])


def path_in_cell(place: int, cell: int) -> np.ndarray:
    """Return W at a place of a cell: a chain of bridges down to it."""
    low, high, below, above = 0, GRID, np.zeros(3), draw(0, cell) * np.sqrt(CELL)
    while low < place < high:
        width = high - low
        part = low + (width // 2 if width > GRID // 16 or width <= GRID // 400 else width // (GRID // 200) * (GRID // 400))
        share = (part - low) / (high - low)
        spread = np.sqrt((high - part) * share * CELL / GRID)
        middle = below + (above - below) * share + draw(part, cell) * spread
        low, high, below, above = (part, high, middle, above) if place >= part else (low, part, below, middle)
    return above if place == GRID else below


def walk(time: float) -> np.ndarray:
    """Return W at a time, from 0 at time 0."""
    cell = int(np.floor(time * 24 + 1e-9))
    return sum((path_in_cell(GRID, each) for each in range(cell)), path_in_cell(round((time * 24 - cell) * GRID), cell))


@pytest.mark.parametrize("fps", [24, 30, 60, 25, 7, 23.976])
def test_velocity_is_the_sum_of_bridges(fps):
    """A free particle's velocity is strength W(t), with W found by halving cells with draws of Philox, at any frame rate."""
    _, velocity = path([PUSH], (0, 0, 0), fps=fps, frames=12)
    for frame in (1, 5, 12):
        np.testing.assert_allclose(velocity[frame], 2 * walk(frame / fps), rtol=0, atol=1e-12)


def many(ops: list[Any], time: dict[str, Any], frame: int, **emit: Any) -> dict[str, np.ndarray]:
    """Return what is stored of many particles at a frame."""
    last = {"fps": 24, "frames": [0, frame], "precision": 64}
    found: dict[str, np.ndarray] = effect_of(ops, last | time, **emit).simulate(frame)["sky"]
    return found


def burst(ops: list[Any], time: dict[str, Any], frame: int, count: int) -> dict[str, np.ndarray]:
    """Return many particles at a frame, all born at rest at time 0."""
    return many(ops, time, frame, rate=0, count=count, set=REST)


RATES = [(24, 1), (30, 1), (60, 1), (24, 3), (24, 16), (48, 5), (25, 1)]


def test_frames_and_steps_share_the_path():
    """Particles born at times of their own have after a second the same velocity at any frames and steps, to 1e-12."""
    births = {"rate": 70, "set": REST, "life": 9}
    ends = [many([PUSH], {"fps": fps, "substeps": n}, fps, **births)["velocity"] for fps, n in RATES]
    count = min(map(len, ends))
    assert count >= 69
    for end in ends[1:]:
        np.testing.assert_allclose(end[:count], ends[0][:count], rtol=0, atol=1e-12)


def test_preroll_shifts_nothing():
    """With a preroll that is no whole number of frames, steps do not matter."""
    ends = [many([PUSH], {"preroll": 0.37, "substeps": n}, 9, rate=70, set=REST)["velocity"] for n in (1, 2, 7)]
    for end in ends[1:]:
        np.testing.assert_allclose(end, ends[0], rtol=0, atol=1e-12)


@pytest.mark.parametrize("ops", [SPRING, [SHIFT, *SPRING]], ids=["pushed", "pushed and shifted"])
def test_damped_spring_is_of_order_one(ops):
    """Halving the step, along one path of each particle, halves the RMS error of a damped spring: order 1 within 0.2."""
    ends = [burst(ops, {"substeps": n}, 24, 400) for n in (1, 2, 4, 8, 16, 32)]
    for name in ("position", "velocity"):
        errors = [np.sqrt(((one[name] - two[name]) ** 2).mean()) for one, two in pairwise(ends)]
        order = -np.polyfit(range(len(errors)), np.log2(errors), 1)[0]
        assert abs(order - 1) <= 0.2, errors


def variances(time: float) -> tuple[float, float]:
    """Return the variances of place and velocity of a damped spring that rested at time 0, in each component.

    With w1^2 = w^2 - d^2 / 4 and the stationary s^2 / (2 d w^2) and s^2 / (2 d), each is that times
    1 - exp(-d t) (w1^2 + d^2 / 2 sin^2 w1 t +- d / 2 w1 sin 2 w1 t) / w1^2. [Uhlenbeck and Ornstein 1930]
    """
    wave = np.sqrt(OMEGA**2 - DAMPING**2 / 4)
    even = wave**2 + DAMPING**2 / 2 * np.sin(wave * time) ** 2
    odd = DAMPING / 2 * wave * np.sin(2 * wave * time)
    still = PUSH["strength"] ** 2 / (2 * DAMPING)  # type: ignore[operator]
    left = np.exp(-DAMPING * time) / wave**2
    return still / OMEGA**2 * (1 - left * (even + odd)), still * (1 - left * (even - odd))


@pytest.mark.parametrize("frame", [3, 8, 15, 60], ids=["1/8 s", "1/3 s", "5/8 s", "stationary"])
def test_damped_spring_has_its_variance(frame):
    """The variances of place and velocity are the exact ones, on the way and in the end, within 3 sigma of 12000 numbers."""
    found = burst(SPRING, {"substeps": 4}, frame, 4000)
    for name, exact in zip(("position", "velocity"), variances(frame / 24), strict=True):
        share = found[name].var() / exact
        assert abs(share - 1) <= 3 * np.sqrt(2 / found[name].size), (name, share)


def test_increments_are_normal_and_independent():
    """Increments over h are normal, with variance strength^2 h in each component, and independent of those before."""
    one, two = (burst([PUSH], {"fps": 1000}, frame, 5000)["velocity"] for frame in (11, 12))
    three = burst([PUSH], {}, 1, 5000)["velocity"]
    for change, time in ((two - one, 0.001), (one, 0.011), (three - two, 1 / 24 - 0.012)):
        scaled = change / (2 * np.sqrt(time))
        count = scaled.size
        assert abs(scaled.mean()) <= 4 / np.sqrt(count)
        assert abs((scaled**2).mean() - 1) <= 4 * np.sqrt(2 / count)
        assert abs((scaled**4).mean() - 3) <= 4 * np.sqrt(96 / count)
        assert np.abs(np.corrcoef(scaled.T) - np.eye(3)).max() <= 4 / np.sqrt(len(scaled))
        assert np.abs(np.corrcoef(scaled[1:, 0], scaled[:-1, 0])[0, 1]) <= 4 / np.sqrt(len(scaled))
    for first, second in ((one, two - one), (two, three - two), (one, three - two)):
        assert abs(np.corrcoef(first.ravel(), second.ravel())[0, 1]) <= 4 / np.sqrt(first.size)


def test_shift_is_an_applied_walk():
    """A Brownian translation changes places by speed W and leaves velocities alone."""
    found = burst([SHIFT | {"along": [1, 0, 1]}], {}, 24, 5000)
    spread = found["position"].var(axis=0) / 4
    assert spread[1] == 0 and np.abs(spread[[0, 2]] - 1).max() <= 4 * np.sqrt(2 / 5000)


def test_alone_as_among_many():
    """The first particle moves alone as among 3000, to the last bit."""
    ops, time = [*SPRING, SHIFT], {"fps": 30}
    alone, among = (burst(ops, time, 20, count) for count in (1, 3000))
    assert bits(alone) == bits({name: part[:1] for name, part in among.items()})


def test_contacts_change_no_increment():
    """A particle that meets a wall without friction goes on along it with the increments of one that meets none."""
    wall = {"type": "bounce_plane", "normal": [-1, 0, 0], "point": [0.4, 0, 0], "resilience": 1}
    free, bounced = (path([PUSH, *surface], (0, 0, 0), (3, 0, 0), fps=10, frames=10) for surface in ([], [wall]))
    assert bounced[0][:, 0].max() <= 0.4 < free[0][:, 0].max()
    np.testing.assert_allclose(bounced[1][:, 1:], free[1][:, 1:], rtol=0, atol=1e-12)
    np.testing.assert_allclose(bounced[0][:, 1:], free[0][:, 1:], rtol=0, atol=1e-12)


def test_listeners_change_no_motion():
    """Where a spawn listens to hits, and particles stop for it in mid-step, they move on to the same places."""
    floor = {"type": "bounce_plane", "resilience": 0.8}
    ops = [PUSH, {"type": "gravity"}, floor]
    sets = {"rate": 100, "set": {"position": [0, 0.2, 0]}, "life": 9}
    plain = many(ops, {}, 24, **sets)
    heard = many([*ops, {"type": "set", "set": {"radius": 0.1}, "when": "hit"}], {}, 24, **sets)
    for name in ("position", "velocity"):
        np.testing.assert_allclose(heard[name], plain[name], rtol=0, atol=1e-12)


@pytest.mark.parametrize("fps", [24, 12, 30])
def test_paper_scheme_adds_whole_increments(fps):
    """In the paper's scheme a step's increment is W's over all cells that it meets."""
    _, velocity = path([PUSH], (0, 0, 0), fps=fps, frames=6, method="sims")
    np.testing.assert_allclose(velocity[6], 2 * walk(6 / fps), rtol=0, atol=1e-12)


def test_another_life_has_another_path():
    """Who begins a second life within a cell goes on by other draws, from 0 at that birth."""
    _, velocity = path([PUSH, {"type": "recycle"}], (0, 0, 0), frames=1, emit={"life": 1 / 40})
    assert not np.allclose(velocity[1], 2 * (walk(1 / 24) - walk(1 / 40)), atol=1e-6)
    assert np.isfinite(velocity[1]).all() and velocity[1].any()


def test_float32_walks_the_same_path():
    """In float32 velocities after a second are those of float64, within 2e-4, for particles of the same birth."""
    ends = [burst([PUSH], {"precision": bits_}, 24, 100)["velocity"] for bits_ in (32, 64)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0, atol=2e-4)


def test_method_says_how_near_it_is():
    """The plan says of Brownian noise that it is right in distribution, and of order 1 in the step; of other noise nothing."""
    stacks = ([PUSH], [PUSH, {"type": "vortex"}], [PUSH | {"process": "hold"}])
    reasons = [effect_of(ops, {}).plan.emitters["sky"].reason for ops in stacks]
    said = "of Brownian noise (random_acceleration) right in distribution and of order 1 in the step"
    assert [said in reason for reason in reasons] == [True, True, False]


def test_own_steps_share_the_noise():
    """With steps of each particle's own, whose order and tolerance differ, noise is one acceleration in each frame step."""
    ops = [PUSH, {"type": "vortex", "magnitude": 3}, {"type": "attract", "strength": 2, "softening": 0.5}]
    given = {"method": "adaptive", "tolerance": 1e-9}
    ends = [burst(ops, given | {"order": order, "fps": 30}, 10, 20)["position"] for order in (4, 8)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0, atol=1e-8)
