"""Spirals: the helix, and the drift across gravity."""

from __future__ import annotations

import numpy as np
import pytest

from ..motion.one_particle import path
from .exactly import COMPLEX, EPS, LONG, at, off

FRAMES = 240
UP = {"spiral_axis": [0, 0, 1]}


@pytest.mark.parametrize("angle", [0.01, 0.83, np.pi, 100.0])
def test_a_helix_keeps_its_radius_and_its_pitch(angle):
    """At any turn a step, half a turn too, the radius V / s and the pace along the axis hold to 1e-12, in 32 bits to 240 eps."""
    s, speed, along = angle * 24, 3.0, 0.75
    for precision, bound in ((64, 1e-12), (32, 240 * EPS[32])):
        ops = [{"type": "spiral", "speed": s}]
        position, velocity = path(ops, (speed / s, 0, 0), (0, speed, along), 24, FRAMES, precision=precision, **UP)
        radius = np.hypot(position[:, 0], position[:, 1])
        assert np.abs(radius * s / speed - 1).max() <= bound
        assert np.abs(position[1:, 2] * 24 / along / np.arange(1, FRAMES + 1) - 1).max() <= bound
        assert np.abs(np.hypot(velocity[:, 0], velocity[:, 1]) / speed - 1).max() <= bound


@pytest.mark.parametrize("velocity", [(1.0, 2, 0.5), None])
def test_gravity_across_a_spiral_drifts_sideways(velocity):
    """At s h = .83 velocity and place follow z' = g / -i s + (z - ...) e^(i s t) to 1e-11 for 240 steps: the E x B drift.

    Who begins at the drift's velocity w x g / w^2 goes straight on with it. In 32 bits both hold to 8 s t eps.
    """
    s, g = 0.83 * 24, -9.8125
    drift = -COMPLEX(1j * g) / COMPLEX(1j * s)
    start = (float(drift.real), 0.0, 0.5) if velocity is None else velocity
    z = COMPLEX(start[0] + 1j * start[1])
    ops = [{"type": "spiral", "speed": s}, {"type": "gravity", "acceleration": [0, g, 0]}]
    for precision in (64, 32):
        position, speed = path(ops, (0, 0, 0), start, 24, FRAMES, precision=precision, **UP)
        for n in (1, 24, FRAMES):
            t = at(n, 24)
            turn = np.exp(COMPLEX(1j * s) * t)
            way, now = drift * t + (z - drift) * (turn - 1) / COMPLEX(1j * s), (z - drift) * turn + drift
            bound = 1e-11 if precision == 64 else 8 * (1 + s * float(t)) * EPS[32]
            assert off(position[n], [way.real, way.imag, LONG(0.5) * t]) <= bound
            assert off(speed[n], [now.real, now.imag, 0.5]) <= bound
