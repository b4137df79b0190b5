"""The places of many particles that start together, under operators and a method."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.simulate import Simulation
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten

from .one_particle import LIBRARY

STILL = {"in_sphere": {"center": [3, 0, 0], "radius": 1}}


def burst(ops: list[Any], count: int, time: dict[str, Any], **sets: Any) -> Effect:
    """Return the effect of `count` particles that are born at time 0, near (3, 0, 0)."""
    given = {"position": STILL, "velocity": {"in_sphere": {"radius": 1}}, **sets}
    document = {
        "graphfx": 1,
        "time": {"fps": 24, "frames": [0, 24], "precision": 64, "method": "adaptive", **time},
        "nodes": {
            "some": {"type": "emit", "rate": 0, "count": count, "set": given},
            "act": {"type": "stack", "from": "some", "ops": ops},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
        },
    }
    return Effect(flatten(document_of(document), LIBRARY))


def carried(effect: Effect, threads: int = 1, reference: bool = False) -> Simulation:
    """Return the simulation after the last frame."""
    simulation = effect.simulation(threads, reference)
    for _ in simulation.frames(effect.flat.time.last):
        pass
    return simulation


def places(simulation: Simulation) -> np.ndarray:
    """Return the positions of all particles, (n, 3)."""
    particles = simulation.particles["some"]
    return np.stack([np.asarray(part)[: particles.store.count].astype(np.float64) for part in particles.value("position")], 1)


def ends(ops: list[Any], count: int = 64, sets: dict[str, Any] | None = None, **time: Any) -> np.ndarray:
    """Return the positions at the end."""
    return places(carried(burst(ops, count, time, **(sets or {}))))
