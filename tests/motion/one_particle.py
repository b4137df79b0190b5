"""The path of one particle under operators, by the block machine, in 64 bits unless told."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots

LIBRARY = Library(library_roots())
UNROLLED = 16
"""Steps that a program has, at most: what it takes to make one grows with them."""


def effect_of(
    ops: list[Any], start: Any, velocity: Any = (0, 0, 0), fps: float = 24, frames: int = 24, method: str = "strang", **more: Any
) -> Effect:
    """Return the effect of one particle that is born at `start` as the simulation begins."""
    time = {"fps": fps, "frames": [0, frames], "precision": 64, "method": method}
    time |= {name: more.pop(name) for name in ("precision", "substeps", "preroll", "tolerance") if name in more}
    emit = more.pop("emit", {})
    sets = {"position": list(start), "velocity": list(velocity), **more}
    document = {
        "graphfx": 1,
        "time": time,
        "nodes": {
            "one": {"type": "emit", "rate": 1, "during": [-1, 0.5 / fps if fps > 1 else 0.5], "set": sets, **emit},
            "act": {"type": "stack", "from": "one", "ops": ops},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act" if ops else "one", "camera": "view", "shutter": 0},
        },
    }
    if not ops:
        del document["nodes"]["act"]  # type: ignore[attr-defined]
    return Effect(flatten(document_of(document), LIBRARY))


def path(*given: Any, **more: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity at every frame, (frames + 1, 3) each; the first are those at birth."""
    found = effect_of(*given, **more)
    simulation = found.simulation()
    states = []
    for _ in simulation.frames(found.flat.time.last):
        particles = simulation.particles["one"]
        states.append(
            [[float(np.asarray(part).ravel()[0]) for part in particles.value(name)] for name in ("position", "velocity")]
        )
    both = np.array(states)
    return both[:, 0], both[:, 1]


def end_of(ops: list[Any], start: Any, velocity: Any, seconds: float, steps: int, **more: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity after some seconds in so many equal steps, at most `UNROLLED` of them in a frame."""
    within = next(count for count in range(UNROLLED, 0, -1) if steps % count == 0)
    frames = steps // within
    position, speed = path(ops, start, velocity, frames / seconds, frames, substeps=within, **more)
    return position[-1], speed[-1]
