"""Springs, undamped and over-damped."""

from __future__ import annotations

import numpy as np
import pytest

from ..motion.one_particle import path
from .exactly import EPS, LONG, at, off

P, V = np.array([1.0, -2, 0.5]), np.array([3.0, 4, -1])
AT_ORIGIN = {"rest_position": [0, 0, 0]}


def swing(frequency: float, amount: float = 0.0) -> list:
    """Return a spring, of a damping ratio."""
    return [{"type": "spring", "frequency": frequency, "damping_ratio": amount}]


@pytest.mark.parametrize("angle", [0.01, 0.1, 1.0, 10.0, 100.0])
def test_240_steps_swing_as_the_cosine(angle):
    """Where w h is .01 to 100 an undamped spring is at its place and speed to 1e-10 after 240 steps, its amplitude to 1e-11.

    In 32 bits the amplitude holds to 240 eps, and the state to 4 w t eps more, for w and the time are rounded too.
    """
    w = angle * 24
    phase = LONG(w) * at(240, 24)
    swung = P * np.cos(phase) + V / LONG(w) * np.sin(phase)
    speeded = V / LONG(w) * np.cos(phase) - P * np.sin(phase)
    amplitude = np.sqrt(P @ P + V @ V / w**2)
    for precision, state, size in ((64, 1e-10, 1e-11), (32, (240 + 4 * float(phase)) * EPS[32], 240 * EPS[32])):
        position, velocity = path(swing(w), P, V, 24, 240, precision=precision, **AT_ORIGIN)
        end, speed = position[-1], velocity[-1] / w
        assert np.abs(end - swung).max() <= state * amplitude and np.abs(speed - speeded).max() <= state * amplitude
        assert abs(np.sqrt(end @ end + speed @ speed) / amplitude - 1) <= size


@pytest.mark.parametrize("fps, frames", [(10_000, 24), (24, 24), (1, 1), (1, 24)])
def test_an_over_damped_spring_creeps_back(fps, frames):
    """At k = 1e6 and d = 1e5 the slow root sqrt(d^2 / 4 - k) - d / 2 rules: place and speed hold to 1e-11 of themselves.

    In 32 bits to (16 + 4 d t / 10^4 + n) eps: as exactly as the slow root times the time is known.
    """
    k, d, t = 1e6, 1e5, at(frames, fps)
    slow = LONG(k) / (LONG(d) / 2 + np.sqrt(LONG(d) ** 2 / 4 - k))
    fast = LONG(d) - slow
    place = (fast * np.exp(-slow * t) - slow * np.exp(-fast * t)) / (fast - slow)
    speed = -k * (np.exp(-slow * t) - np.exp(-fast * t)) / (fast - slow)
    for precision, bound in ((64, 1e-11), (32, (16 + 4 * float(slow * t) + frames) * EPS[32])):
        if precision == 64 or place > 1e-30:
            position, velocity = path(swing(1e3, 50), (1, 0, 0), fps=fps, frames=frames, precision=precision, **AT_ORIGIN)
            assert off(position[-1], [place, 0, 0]) <= bound and off(velocity[-1], [speed, 0, 0]) <= bound
