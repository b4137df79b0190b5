"""Burning surfaces: where flames begin, which way they go, and what those of one flicker share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

LIBRARY = Library([bundled_root()])
WALL = {"type": "mesh_grid", "width": 3, "depth": 2, "rotate": [90, 0, 0]}
"""A wall across z that looks to +z, so that its normal is z and its up-most tangent y."""


def flames(frame: int, **given: Any) -> dict[str, np.ndarray]:
    """Return the particles of a burning wall at a frame (24 a second, frame 0 at the start)."""
    still = {"speed": 0, "buoyancy": 0, "slowing": 0, "curl": 0, "unrest": 0, "particles": 400, "flickers": 7}
    nodes = {"wall": WALL, "it": {"type": "burning", "surface": "wall", **still, **given}, "view": {"type": "camera"},
             "frames": {"type": "image", "from": "it", "camera": "view"}}
    data = {"graphfx": 1, "time": {"frames": [0, frame]}, "use": {"burning": "groups/burning.json"}, "nodes": nodes}
    return Effect(flatten(document_of(data, folder=Path(bundled_root())), LIBRARY)).simulate(frame)["it/fire"]


def test_flames_begin_again_where_they_began() -> None:
    """What does not move is where it was, however many lives it had."""
    first, last = flames(1), flames(90)
    np.testing.assert_array_equal(first["position"], last["position"])
    assert last["lives"].min() >= 2 and np.ptp(last["lives"]) >= 1


def test_flames_set_out_between_the_normal_and_the_up_most_tangent() -> None:
    """The way is off the wall and up it, to a tenth; a lean of 0 is along the wall."""
    off = flames(40, speed=1, lean=0.4)["velocity"]
    off /= np.linalg.norm(off, axis=1)[:, None]
    assert (off[:, 1] > 0).all() and (off[:, 2] > 0).all() and np.abs(off[:, 0]).max() < 0.13
    along = flames(40, speed=1, lean=0)["velocity"]
    assert (np.abs(along[:, 2]) < 0.1 * along[:, 1]).all()


def test_flames_of_one_flicker_keep_one_beat() -> None:
    """All of a flicker burn for the same time, other flickers for others: no two beats are alike."""
    fire = flames(90)
    beats = [set(fire["life"][fire["flicker"] == number].tolist()) for number in range(7)]
    assert all(len(beat) <= 1 for beat in beats) and len(set.union(*beats)) == sum(map(len, beats)) >= 6
