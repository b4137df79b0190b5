"""Many particles with given states under operators."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.simulate import Simulation
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten

from .one_particle import LIBRARY

State = tuple[np.ndarray, np.ndarray]


def effect_of(ops: list[Any], count: int, fps: float = 24, frames: int = 24, emit: Any = None, **time: Any) -> Effect:
    """Return the effect of so many particles, made at frame 0."""
    # Places and velocities that differ from particle to particle, so that both are stored.
    sets = {"position": {"in_box": {}}, "velocity": {"in_box": {}}}
    document = {
        "graphfx": 1,
        "time": {"fps": fps, "frames": [0, frames], "precision": 64, **time},
        "nodes": {
            "one": {"type": "emit", "count": count, "set": sets, **(emit or {})},
            "act": {"type": "stack", "from": "one", "ops": ops},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
        },
    }
    return Effect(flatten(document_of(document), LIBRARY))


def states(simulation: Simulation) -> State:
    """Return positions and velocities as they are, (count, 3) each."""
    store = simulation.particles["one"].store
    position, velocity = (
        np.stack([np.array(part[: store.count]) for part in store.column(name)], 1) for name in ("position", "velocity")
    )
    return position, velocity


def walk(ops: list[Any], position: Any, velocity: Any, **more: Any) -> Iterator[Simulation]:
    """Yield the simulation at every frame, its particles having begun with the given states."""
    position, velocity = np.broadcast_arrays(np.atleast_2d(np.asarray(position, float)), np.asarray(velocity, float))
    found = effect_of(ops, len(position), **more)
    simulation = found.simulation()
    for number, _ in enumerate(simulation.frames(found.flat.time.last)):
        if number == 0:
            store = simulation.particles["one"].store
            for name, given in (("position", position), ("velocity", velocity)):
                for part, axis in zip(store.column(name), given.T, strict=True):
                    part[: store.count] = axis
        yield simulation


def carried(ops: list[Any], position: Any, velocity: Any, **more: Any) -> State:
    """Return positions and velocities at the last frame."""
    *_, simulation = walk(ops, position, velocity, **more)
    return states(simulation)
