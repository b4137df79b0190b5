"""The inverted tornado: broad below and narrow above, and all its dust goes round one way and upwards."""

from __future__ import annotations

import functools

import numpy as np

from .goldens import small


@functools.cache
def dust() -> tuple[np.ndarray, np.ndarray]:
    """Return where each grain was as the shutter opened, and where it is [m]."""
    found = small("inverted_tornado").simulate(48)["ground"]
    return np.asarray(found["tail"], float), np.asarray(found["position"], float)


def test_it_is_broad_below_and_narrow_above() -> None:
    """The higher a layer, the nearer the axis is half of it; the ground is four times as broad as the tip."""
    place = dust()[1]
    away = np.hypot(place[:, 0], place[:, 2])
    breadths = [float(np.median(away[(place[:, 1] >= low) & (place[:, 1] < high)])) for low, high in
                ((-0.5, 0.3), (0.3, 1), (1, 2), (2, 4), (4, 8))]
    assert sorted(breadths, reverse=True) == breadths and breadths[0] > 4 * breadths[-1]


def test_dust_rises_and_turns_one_way() -> None:
    """While the shutter is open hardly a grain in the column turns left-handed about it, or sinks."""
    first, last = dust()
    column = (first[:, 1] > 0.5) & (first[:, 1] < 5) & (np.hypot(first[:, 0], first[:, 2]) < 1.5)
    axis = last[column].mean(axis=0)
    turned = np.cross(first[column] - axis, last[column] - axis)[:, 1]
    assert column.sum() > 100 and np.mean(turned > 0) > 0.97 and np.mean(last[column, 1] > first[column, 1]) > 0.97
