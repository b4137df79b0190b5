"""Parameters that change with time, or with the state of the particle itself: taken half way of each step, second order."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from ..motion.one_particle import path

GRAVITY = {"type": "gravity"}
SPEED = {"expr": "length(velocity)"}
KEYS = {"keys": [[0, 1], [1, 4]]}
CHANGING: dict[str, list[Any]] = {
    "keyed damping": [{"type": "damp", "damping": KEYS}, GRAVITY],
    "keyed wind": [{"type": "wind", "wind": {"keys": [[0, [1, 0, 0]], [1, [0, 0, 2]]]}, "drag": 2}],
    "keyed spring": [{"type": "spring", "frequency": KEYS}],
    "keyed spiral": [{"type": "spiral", "speed": KEYS}, GRAVITY],
    "keyed rotation": [{"type": "rotate", "speed": KEYS}],
    "keyed scale and vortex": [{"type": "scale", "rate": KEYS}, {"type": "vortex"}],
    "keyed drag": [{"type": "drag", "strength": KEYS}, GRAVITY],
    "keyed attractor": [{"type": "attract", "center": {"keys": [[0, [0, 0, 0]], [1, [2, 0, 0]]]}}],
    "damping with the age": [{"type": "damp", "damping": {"expr": "age"}}, GRAVITY],
    "damping with the speed": [{"type": "damp", "damping": SPEED}, GRAVITY],
    "wind with the height": [{"type": "wind", "wind": {"expr": "vec(position.y, 0, 0)"}, "drag": 2}, GRAVITY],
    "translation with the height": [{"type": "translate", "rate": {"expr": "vec(position.y, 0, 0)"}}, GRAVITY],
    "translation by the place": [{"type": "translate", "rate": {"expr": "position"}}, {"type": "vortex"}],
    "attraction with the speed": [{"type": "attract", "strength": SPEED}],
    "turbulence with the speed": [{"type": "turbulence", "strength": SPEED, "size": 5}],
    "stirring with the place": [{"type": "curl_noise", "speed": {"expr": "position.y"}, "size": 5}],
    "vortex with the place": [{"type": "vortex", "magnitude": {"expr": "position.x"}}, GRAVITY],
    "vortex about the place": [{"type": "vortex", "center": {"expr": "position * 0.5"}}],
    "threshold with the speed": [{"type": "damp", "damping": SPEED, "threshold": 0.01}, GRAVITY],
}
SETS = {"rest_position": [0, 0, 0], "spiral_axis": [1, 1, 0]}


@pytest.mark.parametrize("name", CHANGING)
def test_half_a_step_is_a_quarter_of_the_error(name):
    """Halving the step gains an order of at least 1.75 in place and velocity, with whatever a parameter changes."""

    def end(steps: int) -> np.ndarray:
        return np.concatenate([states[-1] for states in path(CHANGING[name], (1, 2, 3), (1, 0, 0.5), steps, steps, **SETS)])

    exact = end(1024)
    errors = [np.abs(end(steps) - exact).max() for steps in (32, 64, 128)]
    assert (np.log2(np.divide(errors[:-1], errors[1:])) >= 1.75).all(), errors


def test_stiff_damping_with_the_speed_stays_stable():
    """Where d h is far beyond 2 at first, damping that grows with the speed still only slows down."""
    _, velocity = path([{"type": "damp", "damping": {"expr": "100 * length(velocity)"}}], (0, 0, 0), (50, 0, 0), frames=48)
    speed = velocity[:, 0]
    assert (speed > 0).all() and (np.diff(speed) <= 0).all()


def test_whom_an_operator_acts_on_is_found_once_a_step():
    """Who goes half way on trial beyond a condition is still acted on: it is found as the step begins."""
    rate = {"expr": "vec(1 + position.x, 0, 0)"}
    position, _ = path([{"type": "translate", "rate": rate, "only": {"expr": "position.x < 0.1"}}], (0, 0, 0), fps=1, frames=1)
    np.testing.assert_allclose(position[-1], [1.5, 0, 0], rtol=1e-14)
