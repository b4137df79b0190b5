"""The orbit about a point without softening: against 100 digits, at the extremes, and as vector code."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.math import kepler
from graphfx.program import function
from tests.lanes.blocks import KINDS, in_plain_python, on_lanes, same_bits

from .orbit_reference import after, errors, size

BITS = (32, 64)
TURN = 2 * np.pi


@function("vec3 vec3 vec3 float float", "vec3 vec3")
def orbit(position: Any, velocity: Any, center: Any, strength: Any, dt: Any) -> Any:
    """The flow as an instruction."""
    return kepler(position, velocity, center, strength, dt)


def columns(position: Any, velocity: Any, strength: Any, dt: Any, center: Any = (0, 0, 0), bits: int = 64) -> list[Any]:
    """Return the arguments as columns; vectors are (3, n)."""
    kind, count = KINDS[bits], np.shape(position)[1]
    spread = lambda value: np.ascontiguousarray(np.broadcast_to(np.asarray(value, kind), count))  # noqa: E731
    middle = tuple(spread(part) for part in center)
    return [tuple(np.asarray(position, kind)), tuple(np.asarray(velocity, kind)), middle, spread(strength), spread(dt)]


def moved(*given: Any, bits: int = 64, **more: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return positions and velocities after a step of the block machine, (3, n) each."""
    parts = np.array(on_lanes(orbit, columns(*given, bits=bits, **more), bits))
    return parts[:3], parts[3:]


def eps(bits: int) -> float:
    """Return the distance from 1 to the next number."""
    return float(np.finfo(KINDS[bits]).eps)


def worst(given: list[Any], bits: int) -> np.ndarray:
    """Return the greater of the relative errors of position and velocity of each particle, (n,)."""
    position, velocity = moved(*given, bits=bits)
    parts = columns(*given, bits=bits)
    start, speed = np.array(parts[0]), np.array(parts[1])
    found = [
        max(errors((position[:, i], velocity[:, i]), start[:, i], speed[:, i], float(parts[3][i]), float(parts[4][i])))
        for i in range(start.shape[1])
    ]
    return np.array(found)


def starts(e: float, apocentre: bool, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the places and velocities of an end of the orbit with mu = 1 and a = 1 (with q = 1 for e >= 1), askew in space."""
    near = 1 - e if e < 1 else 1.0
    far = 1 + e if apocentre else near
    speed = np.sqrt((1 + e) / near) * (near / far)
    along, across = np.array([0.48, 0.6, 0.64]), np.array([0.8, -0.6, 0.0])
    across = across - along * (across @ along)
    across /= np.linalg.norm(across)
    return np.repeat((along * far)[:, None], count, 1), np.repeat((across * speed)[:, None], count, 1)


@pytest.mark.parametrize("bits", BITS)
@pytest.mark.parametrize("e", [0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999])
def test_one_step_from_apocentre(e, bits):
    """From apocentre any step short of the fall to the centre is right to 10 eps, which is 1e-12 and far below."""
    share = np.array([1e-9, 1e-3, 1 / 24, 0.1, 0.25, 0.4, 0.6, 0.9])
    assert worst([*starts(e, True, len(share)), 1.0, share * TURN], bits).max() <= 10 * eps(bits)


@pytest.mark.parametrize("bits", BITS)
@pytest.mark.parametrize("e", [0, 0.5, 0.9, 0.99, 0.999])
def test_half_a_period_from_apocentre(e, bits):
    """At pericentre the error is that of the time, 2 pi eps: 30 eps kappa^(3/2) in place and speed."""
    kappa = (1 + e) / (1 - e)
    assert worst([*starts(e, True, 2), 1.0, np.array([0.4999, 0.5]) * TURN], bits).max() <= 30 * eps(bits) * kappa**1.5


@pytest.mark.parametrize("bits", BITS)
@pytest.mark.parametrize("e", [0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999, 1, 1.1, 1.5])
def test_one_step_from_pericentre(e, bits):
    """From pericentre the error of any step up to a period is below 10 eps kappa, kappa = (1 + e) / (1 - e)."""
    share = np.array([1e-9, 1e-3, 1 / 24, 0.1, 0.25, 0.4, 0.4999, 0.5, 0.6, 0.9, 0.999])
    kappa = (1 + e) / (1 - e) if e < 1 else 1.0
    assert worst([*starts(e, False, len(share)), 1.0, share * TURN], bits).max() <= 10 * eps(bits) * kappa


@pytest.mark.parametrize("e", [0, 0.1, 0.5, 0.9, 0.99])
def test_a_hundred_periods(e):
    """After 100 periods in 2400 steps from apocentre, position and velocity are right to 1e-8."""
    start = position, velocity = starts(e, True, 1)
    dt = TURN / 24
    for _ in range(2400):
        position, velocity = moved(position, velocity, 1.0, dt)
    found = errors((position[:, 0], velocity[:, 0]), start[0][:, 0], start[1][:, 0], 1.0, 2400 * dt)
    assert max(found) <= 1e-8


@pytest.mark.parametrize("bits", BITS)
def test_many_periods_in_one_step(bits):
    """Whole periods are left out without loss, to 10 eps after 1e5; where dt cannot tell the place, the particle stays."""
    e, turns = 0.5, np.array([1, 7, 1000, 1e5])
    position, velocity = starts(e, True, 4)
    found = worst([position, velocity, 1.0, (turns + 0.3) * TURN], bits)
    assert (found <= 10 * eps(bits)).all()
    still = moved(position, velocity, 1.0, 1e20, bits=bits)
    assert (still[0] == np.array(columns(position, velocity, 1, 1, bits=bits)[0])).all() and np.isfinite(still[1]).all()


def drawn(kind: str, count: int, draw: np.random.Generator) -> list[Any]:
    """Return random particles of a kind, with their strengths and steps."""
    position, velocity = draw.normal(size=(3, count)), draw.normal(size=(3, count))
    along = position / np.linalg.norm(position, axis=0)
    if kind == "radial":
        velocity = along * draw.normal(size=count) + 10.0 ** draw.uniform(-12, -1, count) * velocity
        velocity[:, ::3] = 0
    elif kind == "fast":
        velocity *= 10.0 ** draw.uniform(0, 5, count)
    elif kind == "fast and radial":
        velocity = along * draw.choice([-1, 1], count) + 10.0 ** draw.uniform(-7, -1, count) * velocity
        velocity *= 10.0 ** draw.uniform(0, 2, count)
    strength = 10.0 ** draw.uniform(-2, 2, count) * (-1 if kind == "repulsive" else 1)
    return [position, velocity, strength, 10.0 ** draw.uniform(-4, 1.3, count)]


def condition(position: Any, velocity: Any, strength: float, dt: float, unit: float) -> float:
    """Return how far a last digit of the start goes: the sum over place, speed, strength and time, relative, and a rounding."""
    right, askew = after(position, velocity, strength, dt), 1 + unit * np.array([1, -1, 1])
    changed = [
        after(position * askew, velocity, strength, dt),
        after(position, velocity * askew, strength, dt),
        after(position, velocity, strength * (1 + unit), dt),
        after(position, velocity, strength, dt * (1 + unit)),
    ]
    return unit + max(sum(float(size(other[k] - right[k]) / size(right[k])) for other in changed) for k in (0, 1))


@pytest.mark.parametrize("bits", BITS)
@pytest.mark.parametrize("kind", ["plain", "radial", "fast", "fast and radial", "repulsive"])
def test_error_is_that_of_a_rounded_start(kind, bits):
    """Random orbits of each kind are no more wrong than a start that is wrong by 4 units in the last place."""
    given = drawn(kind, 12, np.random.default_rng(11))
    given = [np.asarray(part, KINDS[bits]).astype(float) for part in given]
    found = worst(given, bits)
    conditions = np.array([condition(*(part[..., i] for part in given), eps(bits)) for i in range(12)])
    assert (found <= 4 * conditions).all(), found / conditions


@pytest.mark.parametrize("bits", BITS)
def test_machine_is_plain_python(bits):
    """Vector code gives the bits of plain Python for orbits of every kind, and at the extremes."""
    draw = np.random.default_rng(3)
    kinds = [drawn(kind, 12, draw) for kind in ("plain", "radial", "fast", "fast and radial", "repulsive")]
    wild = [draw.choice([0, 1e-30, -1e-9, 1, 1e9], (3, 60)), draw.choice([0, 1e-20, 1, -1e5, 1e15], (3, 60)),
            draw.choice([0, 1e-9, -1, 1e12], 60), draw.choice([0, 1e-12, -0.1, 1, 1e6], 60)]  # fmt: skip
    given = columns(*(np.concatenate(parts, axis=-1) for parts in zip(*kinds, wild, strict=True)), bits=bits, center=(0.5, 0, 0))
    same_bits(on_lanes(orbit, given, bits), in_plain_python(orbit, given, bits), given)


@pytest.mark.parametrize("bits", BITS)
def test_extremes_are_finite(bits):
    """Strengths to 1e12 (float64: 1e30), distances from 1e-30 to 1e8, speeds and times to 1e6, radial or not: all finite."""
    draw = np.random.default_rng(5)
    count = 30_000
    direction = draw.normal(size=(3, count))
    position = direction * 10.0 ** draw.uniform(-30, 8, count)
    velocity = np.where(draw.random(count) < 0.5, direction, draw.normal(size=(3, count))) * 10.0 ** draw.uniform(-12, 6, count)
    velocity[:, ::5] *= 0
    strength = draw.choice([-1, 1], count) * 10.0 ** draw.uniform(-12, 12 if bits == 32 else 30, count)
    strength[::7], position[:, ::11] = 0, 0
    dt = draw.choice([-1, 1], count) * 10.0 ** draw.uniform(-12, 6, count)
    assert np.isfinite(moved(position, velocity, strength, dt, bits=bits)).all()


@pytest.mark.parametrize("aside, bits", [(1e3, 32), (1e3, 64), (1e-2, 64), (0, 64)])
def test_extreme_speed(aside, bits):
    """At 1e5 m/s a second's motion is right to 1e-10 (float32: 4e-6), past the centre or straight into it and back."""
    position, velocity = np.array([[1.0, 1], [0, 0], [0, 0]]), np.array([[-1e5, 1e5], [aside, aside], [0, 0]])
    assert worst([position, velocity, 10.0, np.array([2e-5, 1.0])], bits).max() <= (1e-10 if bits == 64 else 4e-6)


def test_energy_is_kept():
    """The energy keeps to 100 eps of the greatest of its parts, for a million orbits of every kind together."""
    draw = np.random.default_rng(8)
    for kind in ("plain", "radial", "fast", "fast and radial", "repulsive"):
        given = drawn(kind, 50_000, draw)
        position, velocity = moved(*given)

        def parts(place: np.ndarray, speed: np.ndarray, strength: np.ndarray = given[2]) -> np.ndarray:
            wide = np.longdouble
            return np.array([(speed.astype(wide) ** 2).sum(0) / 2, -strength / np.sqrt((place.astype(wide) ** 2).sum(0))])

        before, later = parts(*given[:2]), parts(position, velocity)
        most = np.maximum(np.abs(before).max(0), np.abs(later).max(0))
        assert (np.abs(before.sum(0) - later.sum(0)) <= 100 * eps(64) * most).all()


@pytest.mark.parametrize("bits", BITS)
def test_no_time_and_no_strength(bits):
    """A step of no time changes no bit; without strength, and at the centre itself, a particle flies on."""
    position, velocity, _, _ = drawn("plain", 50, np.random.default_rng(2))
    start = np.array(columns(position, velocity, 1, 1, bits=bits)[:2])
    assert (np.array(moved(position, velocity, 3.0, 0.0, bits=bits)) == start).all()
    place, speed = moved(position, velocity, 0.0, 2.0, bits=bits)
    assert (place == start[0] + start[1] * KINDS[bits](2)).all() and (speed == start[1]).all()
    place, speed = moved(position * 0, velocity, 3.0, 2.0, bits=bits)
    assert (place == start[1] * KINDS[bits](2)).all() and (speed == start[1]).all()


def test_back_in_time():
    """A step back undoes a step, and two steps are one of both: to 1e-11, for any kind but plunges."""
    for kind in ("plain", "fast", "repulsive"):
        position, velocity, strength, dt = drawn(kind, 200, np.random.default_rng(4))
        dt = np.minimum(dt, 0.5 / np.linalg.norm(velocity, axis=0))
        there = moved(position, velocity, strength, dt)
        for again, wanted in (
            (moved(*there, strength, -dt), (position, velocity)),
            (moved(*moved(position, velocity, strength, dt / 4), strength, dt * 0.75), there),
        ):
            for one, other in zip(again, wanted, strict=True):
                error = np.linalg.norm(one - other, axis=0) / np.linalg.norm(other, axis=0)
                assert np.quantile(error, 0.95) <= 1e-14 and error.max() <= 1e-11


def test_a_fall_comes_back_the_way_it_came():
    """From rest at 1 a particle falls in within pi / sqrt(8) and is back at 1 after twice that, always on its line."""
    fall = np.pi / np.sqrt(8)
    dt = np.array([0.5, 0.99, 1.01, 1.5, 2.0, 5.0]) * fall
    along = np.array([0.6, 0.0, 0.8])
    position, velocity = moved(np.repeat(along[:, None], 6, 1), np.zeros((3, 6)), 1.0, dt)
    distance = along @ position
    np.testing.assert_allclose(position, along[:, None] * distance, atol=1e-15)
    np.testing.assert_allclose(distance[[0, 1, 4]], [distance[3], distance[2], 1.0], rtol=1e-12)
    assert (distance > 0).all() and distance[1] < 0.1 and distance[5] < 1e-6
    np.testing.assert_allclose(along @ velocity[:, :1], -(along @ velocity[:, 3:4]), rtol=1e-12)


@pytest.mark.parametrize("bits, bound", [(32, 0.02), (64, 1e-4)])
def test_a_fall_that_ends_at_the_centre(bits, bound):
    """A fall of exactly the time that it takes keeps its energy -1, and the same time again brings it back to 1."""
    fall = np.pi / np.sqrt(8)
    position, velocity = moved(np.eye(3)[:, :1], np.zeros((3, 1)), 1.0, fall, bits=bits)
    assert position[0, 0] > 0 and abs(velocity[0, 0] ** 2 / 2 - 1 / position[0, 0] + 1) <= bound
    position, _ = moved(position, velocity, 1.0, fall, bits=bits)
    np.testing.assert_allclose(position[0], 1, rtol=bound)
