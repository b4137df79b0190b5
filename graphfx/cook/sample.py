"""Choose some of a graph's particles, so that each of them moves as it does among all.

Of the n births of an emitter, N are chosen, one of each of N parts of their order that differ by one at most: the k-th is

    b_k + floor(u_k (b_k+1 - b_k)),    b_k = floor(k n / N),    u_k in [0, 1) by Philox from the graph's seed, the emitter and k

Children are made of chosen parents alone. Where those have more than N, the N of least id stay: an id of a spawned
particle is itself a hash. So the choice is a function of the graph, of N and of the last frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from graphfx.math.random import key_of, philox4x32, uniform


@dataclass
class Sample:
    """Who is simulated: of each emitter the births of some `ordinals`, ascending; of children those of ids up to `limits`.

    What is not named is simulated whole.
    """

    ordinals: Mapping[str, np.ndarray] = field(default_factory=dict)
    limits: Mapping[str, int] = field(default_factory=dict)

    def births(self, path: str, first: int, count: int) -> np.ndarray:
        """Return which of `count` births of an emitter, numbered from `first` on, are simulated: their places among these."""
        if path not in self.ordinals:
            return np.arange(count)
        chosen = self.ordinals[path]
        low, high = np.searchsorted(chosen, [first, first + count])
        return np.asarray(chosen[low:high] - first)

    def children(self, path: str, ids: np.ndarray) -> np.ndarray:
        """Return for each child of a source whether it is simulated."""
        if path not in self.limits:
            return np.ones(len(ids), bool)
        return np.asarray(ids <= np.uint64(self.limits[path]))


@dataclass
class Census(Sample):
    """Counts children as they come: `least` are, by source, the `most` of least id so far, and others are left out."""

    most: int = 0
    least: dict[str, np.ndarray] = field(default_factory=dict)

    def children(self, path: str, ids: np.ndarray) -> np.ndarray:
        """Return for each child of a source whether it is among those of least id so far."""
        known = self.least.get(path, np.zeros(0, np.uint64))
        self.least[path] = np.union1d(known, ids)[: self.most]
        return np.isin(ids, self.least[path])

    def found(self) -> Sample:
        """Return the sample of what was counted."""
        return Sample(self.ordinals, {path: int(ids[-1]) for path, ids in self.least.items() if len(ids) == self.most})


def ordinals_of(seed: int, path: str, count: int, most: int) -> np.ndarray:
    """Return the births that are chosen of `count`, at most `most` of them, ascending."""
    if count <= most:
        return np.arange(count)
    borders = np.arange(most + 1) * count // most
    shares = uniform(philox4x32((np.arange(most), 0, 0, 0), key_of(seed, path, "sample"))[0])
    sizes = np.diff(borders)
    return borders[:-1] + np.minimum(np.floor(shares * sizes).astype(np.int64), sizes - 1)
