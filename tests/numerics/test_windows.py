"""Operators that act for a time: exactly from its beginning to its end, whatever the frames and the steps are."""

from __future__ import annotations

import numpy as np
import pytest

from ..cook.effects import made
from ..motion.one_particle import path

BEGIN, END = 0.3123, 0.6234
WHEN = {"during": [BEGIN, END]}
START, SPEED = np.array([1.0, 2, 3]), np.array([1.0, 0, 0.5])
FRAMES = (1, 2, 24, 30, 60)


def after(fps: int, **how) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity after a second of gravity that acts for a time."""
    position, velocity = path([{"type": "gravity"} | WHEN], START, SPEED, fps, fps, **how)
    return position[-1], velocity[-1]


@pytest.mark.parametrize("substeps", [1, 3])
@pytest.mark.parametrize("fps", FRAMES)
def test_gravity_acts_from_its_beginning_to_its_end(fps, substeps):
    """A second of which gravity acts from .3123 to .6234 s ends where it should, to 1e-13."""
    span = END - BEGIN
    down = np.array([0, -9.81, 0])
    position, velocity = after(fps, substeps=substeps)
    np.testing.assert_allclose(velocity, SPEED + down * span, rtol=0, atol=1e-13)
    np.testing.assert_allclose(position, START + SPEED + down * span * (span / 2 + 1 - END), rtol=0, atol=1e-13)


WINDOWS = {
    "linear": [{"type": "gravity"} | WHEN, {"type": "damp", "damping": 3, "during": [0.5, 2]}, {"type": "spiral", "speed": 2}],
    "vortex": [{"type": "vortex", "magnitude": 2} | WHEN],
    "spring": [{"type": "spring", "frequency": 9, "during": [-1, 0.45]}, {"type": "gravity"}],
    "many": [{"type": "translate", "rate": [k, 1, 0], "id": f"t{k}", "during": [k / 7, k / 7 + 0.1]} for k in range(1, 7)],
    "noise": [{"type": "random_acceleration", "strength": 9} | WHEN],
}


@pytest.mark.parametrize("name", WINDOWS)
def test_frames_do_not_matter(name):
    """What acts for a time ends at the same state at 1, 2, 24, 30 and 60 frames a second, to 1e-12."""
    sets = {"rest_position": [0, 1, 0], "spiral_axis": [0, 1, 0]}
    still = (0, 0, 0) if name == "vortex" else SPEED
    ends = [np.array(path(WINDOWS[name], START, still, each, each, **sets))[:, -1] for each in FRAMES]
    for end in ends[1:]:
        np.testing.assert_allclose(end, ends[0], rtol=0, atol=1e-12)


def test_a_window_within_one_step_acts():
    """A window that is shorter than a step, and that holds no step's middle, acts as long as it is."""
    _, velocity = path([{"type": "gravity", "acceleration": [0, 100, 0], "during": [0.01, 0.02]}], START, frames=2)
    np.testing.assert_allclose(velocity[-1], [0, 1, 0], rtol=0, atol=1e-14)


def test_the_newborn_meet_windows_too():
    """Particles of any birth feel a window for as long as they live in it."""
    emit = {"rate": 50, "set": {"velocity": [0, 0, 0]}, "during": [0, 0.9]}
    ops = [{"type": "gravity", "acceleration": [0, 1, 0]} | WHEN]
    felt = np.clip(END - np.maximum(np.arange(46) / 50, BEGIN), 0, None)
    for method in ("auto", "strang"):
        found = made(ops, emit, {"frames": [0, 24], "precision": 64, "method": method}).simulate(24)["sky"]
        np.testing.assert_allclose(found["velocity"][:, 1], felt, rtol=0, atol=1e-12)


def test_a_surface_stands_for_its_time():
    """A floor that is taken away at .6234 s lets a particle that rests on it fall from then on."""
    ops = [{"type": "gravity"}, {"type": "bounce_plane", "resilience": 0, "during": [-1, END]}]
    position, _ = path(ops, (0, 0, 0), frames=24)
    np.testing.assert_allclose(position[-1], [0, -9.81 / 2 * (1 - END) ** 2, 0], rtol=0, atol=1e-9)


def test_fades_act_for_their_time():
    """A fade acts for exactly as long as it is told."""
    emit = {"rate": 0, "count": 1, "set": {"radius": 1}}
    fade = {"type": "fade", "rate": 2, "set": {"radius": 0}} | WHEN
    for fps in FRAMES:
        found = made([fade], emit, {"frames": [0, fps], "fps": fps, "precision": 64}).simulate(fps)["sky"]
        np.testing.assert_allclose(found["radius"], [np.exp(-2 * (END - BEGIN))], rtol=1e-13)
