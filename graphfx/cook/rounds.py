"""Rounds of a run in which particles have steps of their own: who has many left is gathered with its like."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.cook.particles import Particles, blocks, padded
from graphfx.program import Program
from graphfx.store.processors import BLOCK

MOST_ROUNDS = 256
"""Runs of up to 64 steps that a particle may take in one frame; who needs more is reported, and stays where it came to."""
TOLD = {"unfinished", "fate", "ended", "begun", "surface", "contacts", "turns", "waiting", "failed", "lost", "knots"}
"""What programs of one's own time tell, besides hits and the places of knots."""
ANEW = {"turns", "waiting", "failed"}
"""What every run tells of itself alone."""
ByPlace = dict[str, tuple[np.ndarray, ...]]


def new_room(program: Program, count: int, real: Any) -> ByPlace:
    """Return room for what a program takes and tells of `count` particles, but for what it finds in their store: zeros."""
    made: ByPlace = {}
    for name, column in (program.loads | program.stores).items():
        if name in TOLD or name.startswith(("hit.", "knot ")):
            kind = np.uint8 if column.type == "bool" else real
            made[name] = tuple(np.zeros(blocks(count) * BLOCK, kind) for _ in range(3 if column.type == "vec3" else 1))
    return made


def count_turns(particles: Particles, given: ByPlace, count: int) -> None:
    """Count the steps that a run took, and the particles that found none short enough."""
    particles.turns += int(given["turns"][0][:count].sum(dtype=np.float64))
    particles.failed += int(given["failed"][0][:count].sum())


def longest_first(places: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Return places by the lengths of their steps, so that those gathered together have much the same."""
    return places[np.argsort(-shares, kind="stable")]


def taken(by_place: ByPlace, places: np.ndarray) -> ByPlace:
    """Return the columns of some places, from the time to which they came."""
    found: ByPlace = {}
    for name, arrays in by_place.items():
        if name in ANEW:
            found[name] = tuple(np.zeros(blocks(len(places)) * BLOCK, array.dtype) for array in arrays)
        elif name != "begin":
            found[name] = tuple(padded(array[places], array.dtype) for array in arrays)
    return found | {"begin": found["ended"]}


def put_back(by_place: ByPlace, given: ByPlace, places: np.ndarray) -> None:
    """Write the columns of some places into those of all."""
    for name, arrays in by_place.items():
        if name not in ANEW and name not in ("begin", "end"):
            for array, part in zip(arrays, given[name], strict=True):
                array[places] = part[: len(places)]
