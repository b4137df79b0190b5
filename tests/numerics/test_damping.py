"""Damping and undamping, with a threshold and without, against their integrals."""

from __future__ import annotations

import numpy as np
import pytest

from ..motion.one_particle import path
from .exactly import EPS, LONG, at, damped, off

V, SPEED = np.array([3.0, 4, -12]), LONG(13)
FRAMES = 24
SHOWN = (1, 7, FRAMES)


@pytest.mark.parametrize("fps", [24, 1000])
@pytest.mark.parametrize("product", [0.01, 0.1, 1.0, 10.0, 100.0])
def test_damping_is_exponential_to_its_stop(product, fps):
    """Where d h is .01 to 100, V e^-dt and V (1 - e^-dt) / d hold to 1e-12, and the way to the stop is V / d.

    In 32 bits to (4 + 2 d t + n) eps, for the rate and the time are rounded too.
    """
    d = product * fps
    for precision in (64, 32):
        position, velocity = path([{"type": "damp", "damping": d}], (0, 0, 0), V, fps, FRAMES, precision=precision)
        for n in SHOWN:
            bound = 1e-12 if precision == 64 else (4 + 2 * product * n + n) * EPS[32]
            t = at(n, fps)
            assert off(velocity[n], V * np.exp(-LONG(d) * t), 1e-20) <= bound
            assert off(position[n], V * damped(d, t)) <= bound
        if product * FRAMES > 40:
            assert off(position[-1], V / LONG(d)) <= (1e-12 if precision == 64 else 4 * EPS[32])


@pytest.mark.parametrize("fps", [1, 24, 1000])
@pytest.mark.parametrize("threshold", [1e-20, 1e-6, 0.5, 13 - 1e-12, 13.0, 20.0, 1e30])
@pytest.mark.parametrize("damping", [0.5, 5.0, 50.0, 500.0])
def test_damping_stops_at_its_threshold(damping, threshold, fps):
    """V max(e^-dt, min(1, threshold / |V|)) and its integral hold to 1e-12, and no speed falls below the threshold."""
    ops = [{"type": "damp", "damping": damping, "threshold": threshold}]
    least = min(LONG(1), LONG(threshold) / SPEED)
    crossing = -np.log(least) / LONG(damping)
    for precision in (64, 32):
        position, velocity = path(ops, (0, 0, 0), V, fps, FRAMES, precision=precision)
        for n in SHOWN:
            t = at(n, fps)
            bound = 1e-12 if precision == 64 else (8 + 2 * damping * float(min(t, crossing)) + n) * EPS[32]
            assert off(velocity[n], V * max(np.exp(-LONG(damping) * t), least)) <= bound
            assert off(position[n], V * (damped(damping, min(t, crossing)) + least * max(t - crossing, 0))) <= bound
            speed = np.sqrt((velocity[n].astype(LONG) ** 2).sum())
            assert speed >= min(threshold, SPEED) * (1 - 4 * LONG(EPS[precision]))


@pytest.mark.parametrize("fps", [1, 24, 1000])
@pytest.mark.parametrize("threshold", [0, 1.0, 13.0, 13 + 1e-12, 26.0, 1e9, None])
@pytest.mark.parametrize("rate", [0.1, 1.0, 2.0, 30.0])
def test_undamping_stops_at_its_threshold(rate, threshold, fps):
    """V min(e^rt, max(1, threshold / |V|)) and its integral hold to 1e-12; who is faster is left alone."""
    op = {"type": "undamp", "rate": rate} | ({} if threshold is None else {"threshold": threshold})
    most = LONG(np.inf) if threshold is None else max(LONG(1), LONG(threshold) / SPEED)
    reached = np.log(most) / LONG(rate)
    for precision, finite in ((64, 700), (32, 80)):
        position, velocity = path([op], (0, 0, 0), V, fps, FRAMES, precision=precision)
        for n in SHOWN:
            t = at(n, fps)
            gaining = min(t, reached)
            if rate * gaining > finite:
                continue
            bound = 1e-12 if precision == 64 else (8 + 2 * rate * float(gaining) + n) * EPS[32]
            coasting = most * (t - reached) if t > reached else 0
            assert off(velocity[n], V * min(np.exp(LONG(rate) * t), most)) <= bound
            assert off(position[n], V * (np.expm1(LONG(rate) * gaining) / LONG(rate) + coasting)) <= bound
