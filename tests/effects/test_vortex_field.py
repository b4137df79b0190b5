"""The field of vortices, and the eddies that it is made of."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import bundled_root

from .goldens import LIBRARY, data_of, small


def carried(frame: int, place: list[float], **given: Any) -> np.ndarray:
    """Return where one particle in one eddy is at a frame (24 a second, frame 0 at the start), in 64 bits."""
    nodes = {"mote": {"type": "emit", "count": 1, "set": {"position": place}}, "it": {"type": "eddy", "from": "mote", **given},
             "view": {"type": "camera"}, "frames": {"type": "image", "from": "it", "camera": "view"}}
    data = {"graphfx": 1, "time": {"frames": [0, 48], "precision": 64}, "use": {"eddy": "groups/eddy.json"}, "nodes": nodes}
    found = Effect(flatten(document_of(data, folder=Path(bundled_root())), LIBRARY)).simulate(frame)["mote"]["position"][0]
    return np.asarray(found, float)


def test_an_eddy_that_stays_is_a_vortex() -> None:
    """Without wander a particle 1 m off the axis turns by turn * t about it, right-handed, and rises by lift * t."""
    x, y, z = carried(24, [3, 1, 0], center=[2, 0, 0], turn=math.pi / 2, lift=0.25, wander=0, range=1e9)
    np.testing.assert_allclose((x, y, z), (2, 1.25, -1), atol=1e-9)


def test_an_eddy_goes_round_its_place() -> None:
    """Its axis is `wander` from its place, half a round ahead on the other side: what lies there hardly moves, all else does."""
    slow = {"wander": 0.5, "period": 1e4, "turn": 2.0}
    places, axes = [np.array([x, 0, z]) for x, z in ((0.5, 0), (-0.5, 0), (0, 0.5), (0, -0.5))], []
    for phase in (0.0, 0.5):
        moved = [float(np.linalg.norm(carried(24, place.tolist(), phase=phase, **slow) - place)) for place in places]
        assert min(moved) < 0.01 and sorted(moved)[1] > 0.1
        axes.append(places[int(np.argmin(moved))])
    np.testing.assert_array_equal(axes[1], -axes[0])


def test_eddies_lift_or_draw_down_as_they_turn() -> None:
    """In the field, what is near an eddy that turns right-handed is above the ground on average, and below it otherwise."""
    motes = np.asarray(small("vortex_field").simulate(48)["motes"]["position"], float)
    eddies = [op for op in data_of("vortex_field")["nodes"]["flow"]["ops"] if op["type"] == "eddy"]
    assert len(eddies) == 15
    for eddy in eddies:
        near = np.hypot(motes[:, 0] - eddy["center"][0], motes[:, 2] - eddy["center"][2]) < 1.2
        right_handed = "-" not in eddy["turn"].get("expr", "")
        assert near.sum() > 5 and (motes[near, 1].mean() > 0) == right_handed
