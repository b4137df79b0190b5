"""Fire on loops stays over the ball, and goes from one foot to the other."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import graphfx

BALL = 2.0
LOOPS: dict[str, Any] = {
    "type": "arcs", "center": [1, 2, 3], "ball": BALL, "toward": [1, 0, 0], "spread": 0, "loops": 1, "rate": 2000, "duration": 1,
    "height": 0.5, "width": 0.6, "along": [0, 1, 0], "thickness": 0.01, "unrest": 0}
TELL = {"type": "set", "set": {"opacity": {"expr": "normalized_age"}}}


@cache
def fire(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return heights over the ball [m], and places from foot to foot (-1 to 1), of the fire of one loop, oldest first."""
    path = folder / "loops.json"
    path.write_text(json.dumps({
        "graphfx": 1, "use": {"arcs": "groups/arcs.json"}, "time": {"frames": [1, 48]}, "nodes": {
            "loops": LOOPS, "told": {"type": "stack", "from": "loops", "ops": [TELL]},
            "view": {"type": "camera"}, "frames": {"type": "image", "from": "told", "camera": "view"}}}))
    (found,) = graphfx.load(path).simulate(40).values()
    way = np.asarray(found["position"], float) - LOOPS["center"]
    order = np.argsort(-np.asarray(found["opacity"], float))
    return (np.linalg.norm(way, axis=1) - BALL)[order], way[order] @ _across(way)


def _across(way: np.ndarray) -> np.ndarray:
    """Return the unit vector along which the loop is longest, across the way to its middle."""
    flat = way - np.outer(way @ (1, 0, 0), (1, 0, 0))
    return np.linalg.svd(flat, full_matrices=False)[2][0]


def test_fire_stays_over_the_ball(tmp_path: Path) -> None:
    """No particle is deeper in the ball than the loop is thick, and some are high."""
    height, _ = fire(tmp_path)
    assert height.min() > -2 * LOOPS["thickness"]
    assert 0.5 * LOOPS["height"] < height.max() < 2 * LOOPS["height"]


def test_fire_goes_from_foot_to_foot(tmp_path: Path) -> None:
    """The youngest and the oldest are low, at opposite feet; those of middle age are high, between them."""
    height, place = fire(tmp_path)
    oldest, middle, youngest = slice(0, 60), slice(len(height) // 2 - 30, len(height) // 2 + 30), slice(-60, None)
    assert max(height[oldest].mean(), height[youngest].mean()) < 0.6 * height[middle].mean()
    assert place[oldest].mean() * place[youngest].mean() < -0.1
    assert abs(place[middle].mean()) < 0.3 * abs(place[oldest].mean())
