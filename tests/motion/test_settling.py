"""Infinitely many bounces end, in finite time and at the right place."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.math import Vec3
from graphfx.motion.settling import series

from .many_particles import carried, effect_of, states, walk
from .one_particle import path
from .test_machine import bits

G = 9.81
GRAVITY = {"type": "gravity"}
CLOCK = {"type": "set", "when": "hit", "set": {"color": {"expr": "vec(time, hits, 0)"}}}


def plane(resilience: Any, friction: Any = 0.0, **more: Any) -> dict[str, Any]:
    return {"type": "bounce_plane", "resilience": resilience, "friction": friction, **more}


@pytest.mark.parametrize("fps", [7, 24, 60, 240])
@pytest.mark.parametrize("resilience", [0.5, 0.9])
def test_ball_rests_when_and_where_its_bounces_end(resilience, fps):
    """Time and travel until a ball dropped from 1 m with friction rests are those of the series, to 1e-10; then V = 0."""
    first, q = np.sqrt(2 / G), 0.7
    end = first + 2 * first * resilience / (1 - resilience)
    travel = first + q * 2 * first * resilience / (1 - q * resilience)
    *_, simulation = walk([GRAVITY, plane(resilience, 1 - q), CLOCK], (0, 1, 0), (1, 0, 0), fps=fps, frames=int(end * fps) + 2)
    position, velocity = states(simulation)
    particles = simulation.particles["one"]
    assert abs(particles.store.column("color")[0][0] - end) <= 1e-10
    assert abs(position[0, 0] - travel) <= 1e-10 and position[0, 1] == 0 and not velocity.any()
    assert particles.unfinished == 0


@pytest.mark.parametrize("resilience", [0.5, 0.9, 0.999])
def test_frictionless_ball_goes_on_along_the_plane(resilience):
    """Without friction a ball rests on the plane at the end of the series, not before, and its speed along is as it was."""
    first = np.sqrt(2 * 1e-3 / G)
    end = first + 2 * first * resilience / (1 - resilience)
    frames = int(min(end, 3.0) * 24) + 2
    position, velocity = path([GRAVITY, plane(resilience)], (0, 1e-3, 0), (1, 0, 0), frames=frames)
    np.testing.assert_allclose(position[:, 0], np.arange(frames + 1) / 24, rtol=0, atol=1e-12)
    assert (velocity[:, 0] == 1).all()
    assert (position[-1, 1] == 0 and velocity[-1, 1] == 0) == (end < frames / 24)


def test_without_resilience_it_rests_at_the_first_contact():
    """With resilience 0 no particle ever leaves the plane that it fell on: its height is 0 to the last bit, its speed too."""
    for friction in (0.0, 0.3, 1.0):
        position, velocity = path([GRAVITY, plane(0, friction)], (0, 1, 0), (1, 0, 2), frames=48)
        after = int(np.sqrt(2 / G) * 24) + 1
        assert not position[after:, 1].any() and not velocity[after:, 1].any()
        wanted = [1, 0, 2] if friction == 0 else [0, 0, 0]
        assert (velocity[after:] == wanted).all()


@pytest.mark.parametrize("resilience", [0.0, 0.4])
@pytest.mark.parametrize("friction", [0.01, 0.3, 1.0])
def test_a_threshold_keeps_friction_from_stopping(friction, resilience):
    """Who settles where friction has a threshold goes on for ever, no faster than it; full friction alone stops all."""
    floor = plane(resilience, friction, friction_threshold=0.8)
    for speed in (0.3, 0.8, 5.0):
        _, velocity = path([GRAVITY, floor], (0, 0.05, 0), (0, 0, speed), frames=240)
        assert velocity[-1, 2] <= min(speed, 0.8) and (velocity[-1, 2] > 0) == (friction < 1) and not velocity[-1, :2].any()
        assert (velocity[-1] == velocity[-48]).all()


def test_a_threshold_lets_slopes_run():
    """On a slope who settles with a threshold of friction never rests, and gains speed as without friction from there on."""
    slope = plane(0.3, 0.5, friction_threshold=1.0, normal=[0.6, 0.8, 0])
    _, velocity = path([GRAVITY, slope], (0, 0.2, 0), frames=96)
    np.testing.assert_allclose(np.diff(velocity[48:], axis=0) * 24, [[0.48 * G, -0.36 * G, 0]] * 48, rtol=1e-9)


@pytest.mark.parametrize("resilience, friction", [(0.0, 0.3), (0.5, 0.3), (0.5, 0.01), (0.8, 1.0), (0.95, 0.2)])
def test_friction_is_the_same_at_any_rate(resilience, friction):
    """Where a ball with friction comes to rest is the same at 24, 60 and 240 frames a second, to 1e-12."""
    ends = [path([GRAVITY, plane(resilience, friction)], (0, 0.5, 0), (2, 0, -1), fps=fps, frames=15 * fps)[0][-1]
            for fps in (24, 60, 240)]
    assert np.ptp(ends, axis=0).max() <= 1e-12


def flights(velocity: np.ndarray, up: np.ndarray, pull: np.ndarray, r: float, q: float, n: int) -> tuple[Any, ...]:
    """Return (time, way, velocity) after n flights, one by one."""
    time, way, u, g = 0.0, np.zeros(3), velocity @ up, -pull @ up
    along, pull = velocity - u * up, pull + g * up
    for _ in range(n):
        tau = 2 * u / g
        way, time = way + along * tau + pull * tau * tau / 2, time + tau
        along, u = (along + pull * tau) * q, u * r
    return time, way, along + u * up


@pytest.mark.parametrize("r", [0.01, 0.3, 0.5, 0.9, 0.99])
@pytest.mark.parametrize("q", [0.0, 0.3, 0.5, 0.5000001, 0.9, 1.0])
def test_series_is_the_sum_of_its_flights(q, r):
    """The closed form of n flights, and of all, is what they come to one by one, on a slope, for r = q too."""
    up = np.array([0.6, 0.8, 0.0])
    velocity, pull = 0.3 * up + [-0.8, 0.6, 0.5], np.array([0.3, -9.0, 0.2])
    tau = -2 * 0.3 / (pull @ up)
    vectors = [Vec3(*map(np.float64, part)) for part in (velocity, up, pull)]
    for n in (1, 2, 5, 40):
        step = tau * (1 - r ** (n + 0.5)) / (1 - r)
        with np.errstate(all="ignore"):
            time, way, after, fits = series.body(*vectors, *map(np.float64, (r, 1 - q, 0.0, 0.0, step)))
        if r**n < 1e-12:
            continue
        wanted = flights(velocity, up, pull, r, q, n)
        assert fits and abs(time - wanted[0]) <= 1e-12 * wanted[0]
        np.testing.assert_allclose([*way], wanted[1], rtol=0, atol=1e-11 * (1 + np.abs(wanted[1]).max()))
        np.testing.assert_allclose([*after], wanted[2], rtol=0, atol=1e-12)
    with np.errstate(all="ignore"):
        time, way, after, fits = series.body(*vectors, *map(np.float64, (r, 1 - q, 0.0, 0.0, 1e3)))
    wanted = flights(velocity, up, pull, r, q, 4000)
    assert fits and abs(time - wanted[0]) <= 1e-12 * wanted[0]
    np.testing.assert_allclose([*way], wanted[1], rtol=0, atol=1e-11 * (1 + np.abs(wanted[1]).max()))
    np.testing.assert_allclose([*after], wanted[2], rtol=0, atol=1e-10)


def test_a_wall_is_met_while_the_ball_settles():
    """A ball that settles on its way to a wall turns back there, at any rate."""
    wall = plane(1, id="wall", normal=[-1, 0, 0], point=[1, 0, 0])
    for fps in (24, 240):
        position, velocity = path([GRAVITY, plane(0.5), wall], (0.7, 0.02, 0), (1.5, 0, 0), fps=fps, frames=fps)
        np.testing.assert_allclose(position[-1], [2 - 0.7 - 1.5, 0, 0], rtol=0, atol=1e-12)
        assert abs(velocity[-1, 0] + 1.5) <= 1e-13


def test_a_wall_is_met_among_the_hops():
    """Balls that hop ever lower turn back at a wall that stands anywhere in their way."""
    wall = plane(1, id="wall", normal=[-1, 0, 0], point=[1, 0, 0])
    start = np.stack([np.linspace(0.3, 0.9, 40), np.full(40, 1e-3), np.zeros(40)], 1)
    position, velocity = carried([GRAVITY, plane(0.9), wall], start, (2, 0, 0), frames=12)
    np.testing.assert_allclose(position[:, 0], 1 - np.abs(1 - (start[:, 0] + 1)), rtol=0, atol=1e-12)
    assert np.abs(np.abs(velocity[:, 0]) - 2).max() <= 1e-12


def test_hops_on_a_ball_are_no_series():
    """On a small ball, which falls away under who hops on it, long steps and short ones lead to the same places."""
    ball = {"type": "bounce_sphere", "sphere_radius": 0.05, "resilience": 0.6, "friction": 0.5}
    rng = np.random.default_rng(8)
    start = np.stack([*rng.uniform(-0.02, 0.02, (2, 50)), np.full(50, 0.06)], 1)[:, [0, 2, 1]]
    coarse, fine = (carried([GRAVITY, ball], start, (0.1, 0, 0), frames=12, substeps=n)[0] for n in (1, 8))
    assert np.percentile(np.abs(coarse - fine).max(axis=1), 90) <= 1e-6


@pytest.mark.parametrize("ops", [[{"type": "damp", "damping": 3}], [{"type": "spiral", "speed": 2}]])
def test_settling_under_other_motion(ops):
    """Where acceleration changes along the way a ball comes to rest at the same place for long and for short steps."""
    ops = [GRAVITY, *ops, plane(0.6, 0.2)]
    rng = np.random.default_rng(5)
    start = rng.uniform([-1, 0.1, -1], [1, 1, 1], (50, 3)), rng.normal(size=(50, 3))
    (coarse, still), (fine, _) = (carried(ops, *start, frames=96, substeps=n) for n in (1, 16))
    np.testing.assert_allclose(coarse, fine, rtol=0, atol=1e-8)
    assert not still.any()


def test_hits_are_counted_down_to_the_speed_of_events():
    """Hits faster than `event_speed` are counted, and the one that ends in rest, at any rate; slower ones are not."""
    speed, wanted = np.sqrt(2 * G), 0
    while speed >= 0.1:
        wanted, speed = wanted + 1, speed * 0.7
    for fps in (7, 24, 240):
        *_, simulation = walk([GRAVITY, plane(0.7, 0.5), CLOCK], (0, 1, 0), (1, 0, 0), fps=fps, frames=4 * fps)
        particles = simulation.particles["one"]
        assert particles.store.column("hits")[0][0] == wanted + 1


def test_machine_is_plain_python():
    """Balls of every kind that settle have the same bits by both ways."""
    rand = {"rand": [0, 1]}
    disc = {"type": "bounce_disc", "resilience": rand, "friction": rand, "disc_radius": 3}
    ball = {"type": "bounce_sphere", "resilience": 0.5, "center": [0, -1, 0]}
    for surfaces, precision in (([plane(rand, rand), ball], 64), ([plane(0.8, 0.1, friction_threshold=0.5), disc], 32)):
        emit = {"set": {"position": {"in_box": {"min": [-1, 0, -1], "max": [1, 0.5, 1]}}, "velocity": {"in_box": {}}}}
        found = effect_of([GRAVITY, *surfaces], 10, frames=16, emit=emit, precision=precision)
        machine, plain = found.simulate(16, threads=2)["one"], found.simulate(16, reference=True)["one"]
        assert bits(machine) == bits(plain) and np.isfinite(machine["position"]).all()
