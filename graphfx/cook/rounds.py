"""Rounds of a run in which particles have steps of their own: who has many left is gathered with its like."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.cook.particles import Particles, padded

MOST_ROUNDS = 256
"""Runs of 64 steps each that a particle may take in one frame; one that needs more is reported, and stays where it came to."""
ByPlace = dict[str, tuple[np.ndarray, ...]]


def new_rounds(count: int, real: Any) -> ByPlace:
    """Return room for what a run tells of the steps of `count` particles."""
    zeros = padded(np.zeros(count), real)
    truths = padded(np.zeros(count), np.uint8)
    return {"contacts": (zeros,), "turns": (zeros.copy(),), "waiting": (truths,), "failed": (truths.copy(),)}


def count_turns(particles: Particles, given: ByPlace, count: int) -> None:
    """Count the steps that a run took, and the particles that found none short enough."""
    particles.turns += int(given["turns"][0][:count].sum(dtype=np.float64))
    particles.failed += int(given["failed"][0][:count].sum())


def waiting(places: np.ndarray, given: ByPlace, shares: np.ndarray) -> np.ndarray:
    """Return the places that wait for another run, those with long steps first."""
    who = np.flatnonzero(given["waiting"][0][: len(places)])
    return places[who[np.argsort(-shares[who], kind="stable")]]


def taken(by_place: ByPlace, places: np.ndarray) -> ByPlace:
    """Return the columns of some places, from the time to which they came."""
    found = {name: tuple(padded(array[places], array.dtype) for array in arrays) for name, arrays in by_place.items()}
    return found | {"begin": found["ended"]}


def put_back(by_place: ByPlace, given: ByPlace, places: np.ndarray) -> None:
    """Write the columns of some places into those of all."""
    for name, arrays in by_place.items():
        for array, part in zip(arrays, given[name], strict=True):
            if name != "begin":
                array[places] = part[: len(places)]
