"""Stars of the galaxy orbit: their energy stays, they go all one way at a believable speed, and the arms last."""

from __future__ import annotations

import functools
import json
import tempfile
from pathlib import Path

import numpy as np
import pytest

import graphfx
from graphfx.cook.effect import Effect
from graphfx.node import bundled_root

SPEED, CORE = 1.6, 1.0
FRAMES = (1, 120, 240)


@functools.cache
def alone() -> Effect:
    """Return the galaxy with no stream but a few of its young stars."""
    document = json.loads((bundled_root() / "graphs/effects/galaxy.json").read_text(encoding="utf-8"))
    document["params"]["amount"]["default"] = 0.05
    document["nodes"]["frames"]["from"] = ["young_lit"]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "stars.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        return graphfx.load(path)


@functools.cache
def stars(frame: int) -> tuple[np.ndarray, np.ndarray]:
    """Return positions and velocities (n, 3) of the young stars [m, m/s]."""
    found = alone().simulate(frame)["young"]
    return np.asarray(found["position"], float), np.asarray(found["velocity"], float)


def energy(frame: int) -> np.ndarray:
    """v^2 / 2 + S / 2 log(r^2 + core^2): what an attractor of falloff 1 keeps [m^2/s^2]."""
    position, velocity = stars(frame)
    return 0.5 * (velocity**2).sum(1) + 0.5 * SPEED**2 * np.log((position**2).sum(1) + CORE**2)


def swirl(frame: int, winding: float) -> float:
    """|mean of exp(i (2 angle + winding log distance))|: how much of the stars is in two arms of that winding."""
    position, _ = stars(frame)
    distance = np.hypot(position[:, 0], position[:, 2])
    some = (distance > 1) & (distance < 3)
    angle = np.arctan2(-position[some, 2], position[some, 0])
    return float(abs(np.exp(1j * (2 * angle + winding * np.log(distance[some]))).mean()))


@pytest.mark.parametrize("frame", FRAMES[1:])
def test_stars_keep_their_energy(frame: int) -> None:
    """After five seconds, and ten, hardly a star has gained or lost a thousandth of S."""
    change = np.abs(energy(frame) - energy(1)) / SPEED**2
    assert np.quantile(change, 0.95) < 2e-3


def test_all_go_around_one_way_at_the_speed_of_their_distance() -> None:
    """The mean speed at each distance is that of a circle there, speed r / sqrt(r^2 + core^2), rising and then flat."""
    position, velocity = stars(120)
    distance = np.hypot(position[:, 0], position[:, 2])
    around = (position[:, 2] * velocity[:, 0] - position[:, 0] * velocity[:, 2]) / distance
    assert (around[distance > 0.5] > 0).all()
    for near in (0.5, 1, 2, 3):
        ring = (distance > near) & (distance < near + 0.5)
        middle = distance[ring].mean()
        assert around[ring].mean() == pytest.approx(SPEED * middle / np.hypot(middle, CORE), rel=0.08)


@pytest.mark.parametrize("frame", FRAMES)
def test_arms_last(frame: int) -> None:
    """Two trailing arms are there from the first frame to the last, and nothing like them that leads."""
    windings = np.arange(2, 20, 0.5)
    trailing = max(swirl(frame, winding) for winding in windings)
    leading = max(swirl(frame, -winding) for winding in windings)
    assert trailing > 0.25
    assert trailing > 4 * leading
