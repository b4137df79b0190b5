"""Snow: what lies stays, nothing gets through the ground or the window, and what hits the pane becomes splats on it."""

from __future__ import annotations

import functools

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.graph.flatten import flatten

from .goldens import EFFECTS, LIBRARY

PANE = 4.6
"""Where the pane stands [m]."""
PIECES = 14


@functools.cache
def snow(frame: int = 60) -> dict[str, dict[str, np.ndarray]]:
    """Return the particles of some of the snow at a frame, by emitter."""
    return Effect(flatten(EFFECTS["snow"], LIBRARY, {"amount": "0.2"})).simulate(frame)


def test_what_lies_stays() -> None:
    """Every flake that lies on the ground is still there, to the last bit, after a gust has gone over it."""
    before, after = (np.asarray(snow(frame)["sky"]["position"]) for frame in (30, 60))
    lain = before[np.abs(before[:, 1]) < 1e-5]
    assert len(lain) > 1000 and {place.tobytes() for place in lain} <= {place.tobytes() for place in after}


def test_nothing_gets_through() -> None:
    """No flake is under the ground, or behind the pane."""
    place = snow()["sky"]["position"]
    assert place[:, 1].min() > -1e-5 and place[:, 2].max() < PANE + 1e-5


def test_splats_are_several_and_on_the_pane() -> None:
    """All that a flake became is on the pane inside the frame, as many for each flake, no farther apart than a splat."""
    place = np.asarray(snow()["splats/drops"]["position"], float)
    assert len(place) >= 3 * PIECES and len(place) % PIECES == 0
    assert np.abs(place[:, 2] - PANE).max() < 1e-4
    splats = place.reshape(-1, PIECES, 3)
    assert np.linalg.norm(splats - splats.mean(axis=1, keepdims=True), axis=2).max() < 2 * 0.22 / 9
    assert np.abs(place[:, 0]).max() < 1.05 and place[:, 1].min() > 1.05 and place[:, 1].max() < 2.35
