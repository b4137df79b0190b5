"""Choose among weights in a constant number of steps: Walker's alias table.

Each of n places holds a share of its own item and gives the rest to one other, so that every item gets its
weight: choose a place evenly, then its own item with the chance that stands there, else the other.
[Walker 1977, An efficient method for generating discrete random variables with general distributions]
"""

from __future__ import annotations

import numpy as np


def alias_table(weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (chance of a place's own item, number of the other item) for weights >= 0, one of them > 0.

    Light items (below the mean) are filled up from heavy ones, both in order. The heavy item that fills a light
    one is the first whose excess, summed with that of those before, passes the deficits before it; the sums are
    found all at once. [Huebschle-Schneider and Sanders 2019, Parallel weighted random sampling]
    """
    count = len(weights)
    share = weights * (count / weights.sum())
    heavy = share >= 1
    heavy[np.argmax(share)] = True
    light, rich = np.flatnonzero(~heavy), np.flatnonzero(heavy)
    chance, other = np.minimum(share, 1.0), np.arange(count)
    lacking = np.concatenate([[0.0], np.cumsum(1 - share[light])])
    excess = np.cumsum(share[rich] - 1)
    last = len(rich) - 1
    other[light] = rich[np.minimum(np.searchsorted(excess, lacking[:-1], side="right"), last)]
    emptied = np.searchsorted(lacking, excess[:-1], side="left")
    left = 1 + excess[:-1] - lacking[np.minimum(emptied, len(light))]
    chance[rich[:-1]] = np.clip(left, 0, 1)
    other[rich[:-1]] = rich[1:]
    chance[rich[-1]] = 1.0
    return chance, other
