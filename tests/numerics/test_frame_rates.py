"""The same motion at 24, 30 and 60 frames a second, at the times that they share."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from ..motion.one_particle import path

RATES = (24, 30, 60)
SHARED = 6
"""Times a second at which all of them show a frame."""
START, SPEED = (1.0, 2.0, 0.5), (0.3, 1.0, -0.5)
SETS = {"rest_position": [0, 1, 0], "spiral_axis": [1, 1, 0]}
EXACT: dict[str, list[Any]] = {
    "linear": [{"type": "spring", "frequency": 6}, {"type": "gravity"}, {"type": "wind", "drag": 2}, {"type": "spiral"}],
    "noise": [{"type": "random_acceleration", "strength": 5}, {"type": "random_translate"}, {"type": "damp"}],
    "for a time": [{"type": "gravity", "during": [0.21, 0.83]}, {"type": "damp", "damping": 3, "during": [0.5, 9]}],
    "threshold": [{"type": "damp", "damping": 3, "threshold": 0.5}],
    "drag": [{"type": "drag", "strength": 2, "wind": [1, 0, 0]}],
    "rotation": [{"type": "rotate", "speed": 3}, {"type": "scale", "rate": -0.5}],
}
FIELDS: dict[str, list[Any]] = {
    "attractors": [{"type": "attract", "strength": 9}, {"type": "attract", "id": "b", "center": [1, 0, 1], "strength": 5}],
    "vortices": [{"type": "vortex", "magnitude": 3}, {"type": "gravity"}, {"type": "damp"}],
    "turbulence": [{"type": "turbulence", "strength": 3}, {"type": "drag"}],
    "keys": [{"type": "wind", "wind": {"keys": [[0, [1, 0, 0]], [1, [0, 0, 2]]]}, "drag": 2}, {"type": "attract", "strength": 3}],
}


def at_shared_times(ops: list[Any], fps: int, method: str, **time: Any) -> np.ndarray:
    """Return places and velocities at the times that all rates show, up to a second."""
    ends = path(ops, START, SPEED, fps, fps, method, **time, **SETS)
    return np.stack([states[:: fps // SHARED] for states in ends])


@pytest.mark.parametrize("name", EXACT)
def test_exact_motion_is_the_same_at_all_rates(name):
    """What is exact is the same to 1e-12; in 32 bits to 100 eps of the greatest coordinate."""
    for precision, bound in ((64, 1e-12), (32, 100 * 2.0**-23)):
        first, *others = (at_shared_times(EXACT[name], fps, "auto", precision=precision) for fps in RATES)
        for other in others:
            assert np.abs(other - first).max() <= bound * np.abs(first).max()


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
@pytest.mark.parametrize("name", FIELDS)
def test_steps_of_their_own_are_right_to_the_tolerance_at_all_rates(name, tolerance):
    """With `adaptive` places at the same time differ by at most the tolerance [m]."""
    first, *others = (at_shared_times(FIELDS[name], fps, "adaptive", tolerance=tolerance)[0] for fps in RATES)
    for other in others:
        assert np.abs(other - first).max() <= tolerance
