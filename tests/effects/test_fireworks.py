"""Shells: where and how they burst, and that their stars may burst again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

SHELL = {"type": "emit", "count": 3, "life": 0.25, "set": {"position": {"in_box": {"min": [-9, 0, 0], "max": [9, 0, 0]}},
         "velocity": [0, 8, 0], "spiral_axis": [1, 2, 2], "fade_color": {"rand": [[1, 0, 0], [0, 0, 1]]}}}


def bursts(frame: int, **given: Any) -> dict[str, dict[str, np.ndarray]]:
    """Return the particles of three shells that end after 0.25 s, 2 m up (24 frames a second, frame 0 at the start)."""
    still = {"weight": 0, "slowing": 0, "trail": 0}
    nodes = {"up": SHELL, "it": {"type": "shell", "from": "up", "stars": 40, "speed": 4, **still, **given},
             "again": {"type": "shell", "from": "it.stars", "stars": 7, **still}, "view": {"type": "camera"},
             "frames": {"type": "image", "from": ["it.stars", "again.stars"], "camera": "view"}}
    data = {"graphfx": 1, "time": {"frames": [0, frame]}, "use": {"shell": "groups/shell.json"}, "nodes": nodes}
    return Effect(flatten(document_of(data, folder=Path(bundled_root())), Library([bundled_root()]))).simulate(frame)


def test_a_ring_lies_across_the_shells_axis_about_where_it_burst() -> None:
    """All stars of a flat, even burst are in the plane across the axis, at one distance to 8 %, of one colour."""
    stars = bursts(18, flatness=1, evenness=1, duration=9)["it/burst"]
    center = np.array([0, 2 + 4 * 0.5, 0])  # half of the shell's speed goes on for half a second
    assert len(stars["position"]) == 120
    for color in np.unique(stars["fade_color"], axis=0):
        ring = stars["position"][(stars["fade_color"] == color).all(axis=1)].astype(float)
        middle = np.array([np.mean([ring[:, 0].min(), ring[:, 0].max()]), *center[1:]])
        away = ring - middle
        np.testing.assert_allclose(away @ [0, 2, 2], -away[:, 0], atol=0.25)
        assert len(ring) == 40 and 1.7 < np.linalg.norm(away, axis=1).mean() <= 2.1


def test_every_star_bursts_again() -> None:
    """Stars that have ended were shells themselves: each of 120 makes 7."""
    made = bursts(24, duration=0.5)
    assert len(made["again/burst"]["position"]) == 120 * 7 and len(made["it/burst"]["position"]) == 0
