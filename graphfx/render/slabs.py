"""Cut the streaks of one tile into slabs of depth of no more than so many, each wholly before the next in rank.

The streaks are counted by the upper half of the bits of their nearest keys; where one count is too much, by the
lower half too; and where one key is too much, for ties are in the order of particles, by ranges of these.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graphfx.render.patches import Patch
from graphfx.render.scene import Scene
from graphfx.render.view import Slab

HALF = 16
KEYS = (1 << 32) - 1


def slabs_of(scene: Scene, patch: Patch, most: int) -> Iterator[Slab]:
    """Yield the slabs of a patch, the nearest first; no two streaks of different slabs are in the wrong order."""
    counts = scene.key_counts(patch, 0, KEYS, HALF)
    for first, last in _runs(counts, most):
        low, high = first << HALF, ((last + 1) << HALF) - 1
        if counts[first : last + 1].sum() <= most:
            yield Slab(True, low, high, 0, scene.count)
            continue
        fine = scene.key_counts(patch, low, high, 0)
        for one, other in _runs(fine, most):
            step = scene.count if fine[one : other + 1].sum() <= most else most
            for start in range(0, scene.count, step):
                yield Slab(True, low + one, low + other, start, start + step)


def _runs(counts: np.ndarray, most: int) -> Iterator[tuple[int, int]]:
    """Yield the first and last of runs of bins that hold no more than `most` together, or of a single bin that holds more."""
    filled = np.flatnonzero(counts).tolist()
    first = last = filled[0] if filled else 0
    total = 0
    for number in filled:
        if total + counts[number] > most and total:
            yield first, last
            first, total = number, 0
        last = number
        total += int(counts[number])
    if filled:
        yield first, last
