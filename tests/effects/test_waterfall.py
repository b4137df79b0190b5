"""Droplets of the waterfall go round and round: they run over its rocks, not into them, and none stands still for long."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from .goldens import data_of, small


@functools.cache
def droplets(frame: int) -> dict[str, np.ndarray]:
    """Return the columns of a few droplets at a frame."""
    return small("waterfall").simulate(frame)["source"]


def rocks() -> list[tuple[np.ndarray, float]]:
    """Return the middle and the radius of each rock [m]."""
    data = data_of("waterfall")
    places = {name: value["expr"] for name, value in data["values"].items()}
    stones: list[dict[str, Any]] = [op for op in data["nodes"]["fall"]["ops"] if op["type"] == "rock"]
    numbers = [places[stone["center"]["expr"]].removeprefix("vec(").rstrip(")").split(",") for stone in stones]
    return [(np.array(number, float), stone["size"]) for number, stone in zip(numbers, stones, strict=True)]


def test_no_droplet_is_inside_a_rock() -> None:
    """At a frame's time all are outside of every rock and before the cliff, to a hundredth of a millimetre."""
    position = np.asarray(droplets(48)["position"], float)
    assert min((np.linalg.norm(position - middle, axis=1) - radius).min() for middle, radius in rocks()) > -1e-5
    normal = np.array([0, 0.1, 1]) / np.hypot(0.1, 1)
    assert ((position - [0, 0, -1]) @ normal).min() > -1e-5


def test_rocks_are_drawn_where_they_are() -> None:
    """Each rock's mesh has the rock's middle, and its radius but for a centimetre, so that drops are seen on it."""
    data = data_of("waterfall")
    for stone in (op for op in data["nodes"]["fall"]["ops"] if op["type"] == "rock"):
        ball = data["nodes"][f"{stone['id']}_ball"]
        assert ball["translate"] == stone["center"] and abs(stone["size"] - ball["sphere_radius"] - 0.01) < 1e-9


def test_the_same_droplets_go_round() -> None:
    """No droplet is made or lost while the pictures last, but some have gone round, and hardly any stands still."""
    first, last = droplets(1), droplets(48)
    assert len(first["position"]) == len(last["position"]) and abs(len(first["position"]) - 60000 * 0.05) <= 1
    assert last["lives"].sum() > first["lives"].sum() + 500
    assert np.mean(np.linalg.norm(last["velocity"], axis=1) < 0.05) < 0.02


def test_droplets_are_between_blue_and_white() -> None:
    """Colours lie between a droplet's own blue and the white of a hit, and there are some of both."""
    drops = droplets(48)
    blue, color = np.asarray(drops["fade_color"], float), np.asarray(drops["color"], float)
    share = (color - blue) / (np.array([0.85, 1.0, 1.15]) - blue)
    assert share.min() > -1e-6 and share.max() < 1 + 1e-6
    np.testing.assert_allclose(share, share[:, :1] * np.ones(3), atol=1e-4)
    assert np.mean(share < 0.1) > 0.1 and np.mean(share > 0.6) > 0.1
