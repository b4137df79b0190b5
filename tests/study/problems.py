"""Graphs whose motion is known, for studies."""

from __future__ import annotations

from typing import Any

from graphfx.graph.document import document_of
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots

LIBRARY = Library(library_roots())


def flat_of(ops: list[Any], emit: dict[str, Any], frames: int = 24, **time: Any) -> FlatGraph:
    """Return the flat graph of one emitter under operators."""
    document = {
        "graphfx": 1, "seed": 5, "time": {"fps": 24, "frames": [1, frames], **time},
        "nodes": {
            "dots": {"type": "emit", "rate": 0, **emit},
            "act": {"type": "stack", "from": "dots", "ops": ops},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view"},
        },
    }
    return flatten(document_of(document), LIBRARY)


def two_vortices(**keys: Any) -> FlatGraph:
    """Return particles between two vortices, whose flows do not commute: symmetric steps are of second order there."""
    ops = [{"type": "vortex", "center": [x, 0, 0], "magnitude": 3, "tightness": 1.5} for x in (-1, 1)]
    return flat_of(ops, {"count": 40, "set": {"position": {"in_box": {"min": [-2, -1, 1], "max": [2, 1, 2]}}}}, **keys)


def free_fall(**keys: Any) -> FlatGraph:
    """Return particles that fall: every method but `sims` is exact, and so is that, since its step is a mean of velocities."""
    emit = {"count": 8, "set": {"position": {"in_box": {}}, "velocity": {"in_sphere": {}}}}
    return flat_of([{"type": "gravity"}], emit, **keys)


def pinball(**keys: Any) -> FlatGraph:
    """Return particles between mirrors that part neighbours: chaos."""
    mirror = {"type": "bounce_sphere", "resilience": 1, "friction": 0}
    corners = [[1.5 * x, 1.5 * y, 1.5 * z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    balls = [{**mirror, "center": corner, "sphere_radius": 1.4} for corner in corners]
    room = {**mirror, "sphere_radius": 3.5, "inside": True}
    pull = {"type": "attract", "strength": 4, "softening": 0.5}
    return flat_of([pull, *balls, room], {"count": 30, "set": {"velocity": {"in_sphere": {"radius": 12}}}}, **keys)
