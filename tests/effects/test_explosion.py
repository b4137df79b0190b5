"""Explosions: nothing before their time, nothing beyond their extent, nothing under the ground."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect, load
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

EFFECT = bundled_root() / "graphs/effects/explosion.json"


def fireball(frame: int, **given: Any) -> dict[str, dict[str, np.ndarray]]:
    """Return the particles of a fireball at a frame (24 a second, frame 0 at the start)."""
    nodes = {"it": {"type": "fireball", "fire": 2000, "soot": 0.5, **given}, "view": {"type": "camera"},
             "frames": {"type": "image", "from": ["it.fire", "it.smoke"], "camera": "view"}}
    data = {"graphfx": 1, "time": {"frames": [0, frame]}, "use": {"fireball": "groups/fireball.json"}, "nodes": nodes}
    return Effect(flatten(document_of(data, folder=Path(bundled_root())), Library([bundled_root()]))).simulate(frame)


def test_a_fireball_ends_at_its_extent() -> None:
    """Where the air neither rises nor swirls, all comes to rest within the extent, and fills it to three quarters."""
    made = fireball(30, rise=0, unrest=0, extent=2, burning=5, center=[0, 5, 0])
    away = np.linalg.norm(made["it/gas"]["position"] - [0, 5, 0], axis=1)
    assert 1.5 < away.max() <= 2 and np.linalg.norm(made["it/gas"]["velocity"], axis=1).max() < 0.05


def test_a_fireball_waits_for_its_time() -> None:
    """Before it happens there is nothing; at once after it there is all the fire, and its share of smoke."""
    before, after = fireball(11, at=0.5), fireball(13, at=0.5)
    assert sum(len(made["position"]) for made in before.values()) == 0
    assert len(after["it/gas"]["position"]) == 2000 and 900 < len(after["it/ash"]["position"]) < 1100


def test_debris_and_sparks_stay_above_the_ground() -> None:
    """Pieces bounce where the ground is, to a hair, and late in the shot most of them lie there."""
    simulation = load(EFFECT, set={"amount": 0.02, "debris": 1000, "sparks": 5000}).simulation()
    pieces, sparks = (simulation.particles[name].store for name in ("chunks", "shards/blast"))
    lowest = [9.0, 9.0]
    for _ in simulation.frames(100):
        heights = (store.column("position")[1] for store in (pieces, sparks))
        lowest = [min(low, height.min(initial=9)) for low, height in zip(lowest, heights, strict=True)]
    height = pieces.column("position")[1]
    assert len(height) == 20 and np.median(height) < 0.04
    assert lowest[0] >= 0.03 - 1e-6 and -1e-6 <= lowest[1] < 0.01
