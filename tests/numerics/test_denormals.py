"""What decays ends at 0, and never slows a cook down among the denormal numbers."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

from ..cook.effects import made
from ..motion.one_particle import path

TINY = {32: 3e-38, 64: 3e-308}
LEAST = {32: 2.0**-110, 64: 2.0**-1000}
DECAYS: dict[str, list[Any]] = {
    "damp": [{"type": "damp", "damping": 2}],
    "damp and vortex": [{"type": "damp", "damping": 2}, {"type": "vortex"}],
    "damp and spiral": [{"type": "damp", "damping": 2}, {"type": "spiral"}],
    "wind": [{"type": "wind", "wind": [0, 0, 0]}],
    "spring": [{"type": "spring", "frequency": 9, "damping_ratio": 1}],
    "scale": [{"type": "scale", "rate": -2}],
    "sims": [{"type": "damp", "damping": 2}],
}


def begun(name: str, precision: int, size: float) -> Any:
    """Return frames of 50 000 particles whose places and velocities are of a size."""
    state = {"position": [size, size, size], "velocity": [size, -size, size], "rest_position": [0, 0, 0]}
    when = {"precision": precision, "frames": [0, 1000]} | ({"method": "sims"} if name == "sims" else {})
    simulation = made(DECAYS[name], {"rate": 0, "count": 50_000, "set": state}, when).simulation(threads=1)
    frames = simulation.frames(1000)
    for _ in range(3):
        next(frames)
    return frames


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("name", DECAYS)
def test_a_decay_into_denormals_takes_no_longer(name, precision):
    """Frames of particles that decay from the least normal numbers take at most 1.5 times those of ordinary ones."""
    cooks = [begun(name, precision, size) for size in (1.0, TINY[precision])]
    best = [np.inf, np.inf]
    for _ in range(25):
        for k, frames in enumerate(cooks):
            started = time.perf_counter()
            next(frames)
            best[k] = min(best[k], time.perf_counter() - started)
        if best[1] <= 1.4 * best[0]:
            return
    assert best[1] <= 1.5 * best[0]


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("name", DECAYS)
def test_a_decay_ends_at_nothing(name, precision):
    """No coordinate of what decays is ever less than 2^-110 (2^-1000) but 0, which it is in the end."""
    size = LEAST[precision] * 16
    method = "sims" if name == "sims" else "auto"
    start, velocity = (size, -size, 0), (size, size / 2, -size) if name != "scale" else (0, 0, 0)
    states = np.abs(path(DECAYS[name], start, velocity, 2, 40, method, precision=precision, rest_position=[0, 0, 0]))
    decaying = {"scale": states[0], "spring": states}.get(name, states[1])  # the rest goes on, or stands
    assert ((decaying >= LEAST[precision]) | (decaying == 0))[..., 1:, :].all() and not decaying[..., -1, :].any()


def test_a_fade_ends_at_nothing():
    """What fades to 0 gets there."""
    emit = {"rate": 0, "count": 1, "set": {"radius": 1e-30}}
    found = made([{"type": "fade", "rate": 20, "set": {"radius": 0}}], emit, {"frames": [0, 24]})
    assert found.simulate(24)["sky"]["radius"].tolist() == [0]
