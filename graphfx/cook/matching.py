"""Find the same particles in two simulations, and how far apart they are."""

from __future__ import annotations

import numpy as np

from graphfx.cook.trial import States

ODD, OTHER_ODD = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9


def keys_of(states: States) -> np.ndarray:
    """Return a word of 64 bits for each particle and life: two are the same by chance once in 2^64."""
    with np.errstate(over="ignore"):
        words = states.ids * np.uint64(ODD)
        return np.asarray((words ^ (words >> np.uint64(29))) + states.lives.astype(np.uint64) * np.uint64(OTHER_ODD))


def matched(first: States, second: States) -> tuple[np.ndarray, np.ndarray]:
    """Return the rows of the particles that both have, the same of each at the same place."""
    if np.array_equal(first.ids, second.ids) and np.array_equal(first.lives, second.lives):
        every = np.arange(len(first))
        return every, every
    _, one, other = np.intersect1d(keys_of(first), keys_of(second), assume_unique=True, return_indices=True)
    return one, other


def size(vectors: np.ndarray) -> np.ndarray:
    """Return the lengths of vectors (n, 3), without overflow; infinite where one is no number."""
    with np.errstate(invalid="ignore", over="ignore"):
        found = np.hypot(np.hypot(vectors[:, 0], vectors[:, 1]), vectors[:, 2])
    return np.where(np.isfinite(found), found, np.inf)


def distances(true: States, other: States) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return how far each particle of `true` is from where `other` has it, infinite where it has not; and the rows of both."""
    rows, theirs = matched(true, other)
    found = np.full(len(true), np.inf)
    found[rows] = size(other.position[theirs] - true.position[rows])
    return found, rows, theirs


def quantile(ascending: np.ndarray, share: float) -> float:
    """Return the least value that a share of ascending values does not exceed."""
    return float(ascending[max(int(np.ceil(share * len(ascending))) - 1, 0)])
