"""Torches that orbit attractors, and the flames that they leave."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from graphfx.cook.effect import Effect, load
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

EFFECT = bundled_root() / "graphs/effects/orbiting_fire.json"
CENTERS = np.array([[-1.6, 0, 0], [1.6, 0.25, -0.5]])


def test_torches_keep_their_energy() -> None:
    """v^2 / 2 - pull / r about its own attractor is, for each torch, the same at any time."""
    effect = load(EFFECT, set={"amount": 0.01})
    first, last = (effect.simulate(frame)["torches"] for frame in (1, 40))
    away = [np.linalg.norm(torch["position"] - CENTERS[np.arange(8) % 2], axis=1) for torch in (first, last)]
    energies = [np.sum(torch["velocity"] ** 2, axis=1) / 2 - 10 / r for torch, r in zip((first, last), away, strict=True)]
    np.testing.assert_allclose(energies[1], energies[0], rtol=2e-5)
    assert (energies[0] < 0).all() and np.abs(first["position"] - last["position"]).max() > 0.5


def test_flames_that_keep_the_speed_go_along() -> None:
    """Carried along whole, without spread, all flames are where their torch is, as many as the rate says."""
    nodes = {"coal": {"type": "emit", "count": 1, "set": {"velocity": [1, 2, 3]}},
             "it": {"type": "torch", "from": "coal", "carried": 1, "spread": 0, "flicker": 0, "rate": 480, "duration": 9},
             "view": {"type": "camera"}, "frames": {"type": "image", "from": "it", "camera": "view"}}
    data = {"graphfx": 1, "time": {"frames": [0, 24]}, "use": {"torch": "groups/torch.json"}, "nodes": nodes}
    effect = Effect(flatten(document_of(data, folder=Path(bundled_root())), Library([bundled_root()])))
    fire = effect.simulate(24)["it/left"]["position"]
    assert abs(len(fire) - 480) <= 1
    np.testing.assert_allclose(fire, np.broadcast_to([1, 2, 3], fire.shape), atol=2e-5)
