"""Bounces are as exact as the motion between them, and cost few evaluations more."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

from tests.motion.many_particles import carried, effect_of
from tests.motion.one_particle import path

ATTRACTED = [
    {"type": "gravity"},
    {"type": "attract", "center": [0, 3, 0], "strength": 4},
    {"type": "bounce_plane", "resilience": 0.8},
]


def test_bounces_under_gravity_and_an_attractor():
    """With order 6 the 95th percentile of the position error is within 1e-5 m after a second of falls and bounces."""
    rng = np.random.default_rng(26)
    start = rng.uniform([-1, 0.2, -1], [1, 1.5, 1], (200, 3)), rng.normal(size=(200, 3))
    found, wanted = (
        carried(ATTRACTED, *start, method="adaptive", order=order, tolerance=tolerance)[0]
        for order, tolerance in ((6, 1e-3), (8, 1e-10))
    )
    assert np.percentile(np.abs(found - wanted).max(axis=1), 95) <= 1e-5


def test_bounces_cost_few_evaluations():
    """So do they with at most 10 evaluations of the attractor for each particle and frame, the search for contacts included."""
    emit = {"set": {"position": {"in_box": {"min": [-1, 0.2, -1], "max": [1, 1.5, 1]}}, "velocity": {"in_sphere": {"radius": 1}}}}
    found = effect_of(ATTRACTED, 8, emit=emit, method="adaptive", order=6, tolerance=1e-3)
    frames = found.simulation(1, True).frames(24)
    next(frames)
    calls = 0

    def count(frame: Any, event: str, _: Any) -> None:
        nonlocal calls
        calls += event == "call" and frame.f_code.co_name == "attract"

    sys.setprofile(count)
    try:
        for _ in frames:
            pass
    finally:
        sys.setprofile(None)
    assert 6 <= calls / 8 / 24 <= 10


@pytest.mark.parametrize("turned", [0.0, 0.3, 0.7])
def test_a_corner_reverses_the_velocity(turned):
    """Two planes at 90 degrees, however turned, send a particle back with its velocity reversed, to 1e-14 of its speed."""
    x, y = np.array([np.cos(turned), np.sin(turned), 0]), np.array([-np.sin(turned), np.cos(turned), 0])
    planes = [{"type": "bounce_plane", "id": f"wall{k}", "normal": n.tolist(), "resilience": 1} for k, n in enumerate((x, y))]
    _, velocity = path(planes, 0.5 * x + 0.4 * y, -3 * x - 2 * y + [0, 0, 1], frames=24)
    assert np.abs(velocity[-1] - (3 * x + 2 * y + [0, 0, 1])).max() <= 1e-14 * np.sqrt(14)
