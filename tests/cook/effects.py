"""Effects made of plain data, without files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.paths import Window
from graphfx.cook.simulate import Simulation
from graphfx.cook.streaks import streaks_of
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.render.streaks import Streaks

FALLING = {"position": {"in_box": {"min": [-1, 1, -1], "max": [1, 2, 1]}}, "velocity": [0.5, 1, -0.25]}
"""A `set` that gives particles a place of their own and one velocity."""


def graph(
    ops: list[Any] = (),
    emit: dict[str, Any] | None = None,
    time: dict[str, Any] | None = None,
    image: dict[str, Any] | None = None,
    nodes: dict[str, Any] | None = None,
    **keys: Any,
) -> dict[str, Any]:
    """Return a document: emitter `sky`, stack `act` of the operators, camera `view` and image `frames`."""
    source = "act" if ops else "sky"
    return {
        "graphfx": 1,
        "seed": 3,
        **keys,
        "time": {"fps": 24, "frames": [1, 12], "method": "strang", **(time or {})},
        "nodes": {
            "sky": {"type": "emit", "rate": 24, "set": FALLING, **(emit or {})},
            **({"act": {"type": "stack", "from": "sky", "ops": list(ops)}} if ops else {}),
            **(nodes or {}),
            "view": {"type": "camera", "position": [0, 2, 14]},
            "frames": {"type": "image", "from": source, "camera": "view", "size": [48, 32], **(image or {})},
        },
    }


def effect(document: dict[str, Any], library: Iterable[str | Path] = (), folder: str | Path | None = None) -> Effect:
    """Return the effect of a document."""
    return Effect(flatten(document_of(document, "test.json", folder), Library(library_roots(library))))


def made(*given: Any, **keys: Any) -> Effect:
    """Return the effect of `graph(...)`."""
    return effect(graph(*given, **keys))


def particles(document: dict[str, Any] | Effect, frame: int, emitter: str = "sky", **how: Any) -> dict[str, np.ndarray]:
    """Return the columns of one emitter's particles at a frame."""
    found = document if isinstance(document, Effect) else effect(document)
    return found.simulate(frame, **how)[emitter]


def streaks_at(simulation: Simulation, time: float, opening: float) -> list[Streaks]:
    """Return the streaks of the particles of `sky` while a shutter is open up to the time of the frame."""
    window = Window(opening, time, time, simulation.clock.start, simulation.clock.fps)
    made = [shown.streaks.drawn() for shown in streaks_of(simulation.particles["sky"], None, {}, window, False)]
    return [streaks for streaks in made if streaks.count] or made[:1]


def bits(columns: dict[str, dict[str, np.ndarray]]) -> dict[str, dict[str, Any]]:
    """Return columns as bytes, every NaN alike, to be compared."""
    return {
        path: {
            name: (array.shape, np.where(array == array, array, np.nan).tobytes() if array.dtype.kind == "f" else array.tobytes())
            for name, array in given.items()
        }
        for path, given in columns.items()
    }
