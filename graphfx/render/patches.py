"""Patches: parts of the picture that are rendered one after the other, so that memory stays under a budget.

A patch is a rectangle of whole tiles. First every streak's box on the screen is counted by its corners; sums of
these counts tell for any rectangle how many streaks reach into it. Then rows of tiles are taken together as long as
what they need fits, columns where one row is too much, and where one tile is too much the streaks of that tile come
nearest first, a slice of depth after the other. What a pixel shows does not depend on any of this.
[Sims 1990, section 4.1]
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH

MEMBER_BYTES = 4
"""Memory of one segment in one tile."""


class Patch(NamedTuple):
    """A rectangle of tiles: columns left ... right - 1, rows top ... bottom - 1."""

    left: int
    top: int
    right: int
    bottom: int


def whole_picture(width: int, height: int) -> Patch:
    """Return the patch of all tiles."""
    return Patch(0, 0, -(-width // TILE_WIDTH), -(-height // TILE_HEIGHT))


class Counts:
    """How many boxes reach into rectangles of tiles.

    `corners` (4, rows + 1, columns + 1) counts boxes by their first and last tile, as (first row, first column),
    (first row, last column + 1), (last row + 1, first column), (last row + 1, last column + 1). `beside` (rows, columns) are
    the bytes that each tile needs beside segments.
    """

    def __init__(self, corners: np.ndarray, segment_bytes: int, beside: np.ndarray | None = None):
        self.segment_bytes = segment_bytes
        self.beside = None if beside is None else np.pad(beside.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
        before = corners.cumsum(axis=1).cumsum(axis=2)
        self.corners = np.pad(before, ((0, 0), (1, 0), (1, 0)))
        each = (before[0] - before[1] - before[2] + before[3])[:-1, :-1]
        self.pairs = np.pad(each.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))

    def boxes(self, patch: Patch) -> int:
        """Return how many boxes reach into a patch: of those that begin before its end, all that do not end before it begins.

        With F(k, r, c) the number of corners k in the rows before r and the columns before c, that is
        F(0, b, r) - F(1, b, l + 1) - F(2, t + 1, r) + F(3, t + 1, l + 1).
        """
        left, top, right, bottom = patch
        corners = self.corners
        return int(
            corners[0, bottom, right] - corners[1, bottom, left + 1] - corners[2, top + 1, right] + corners[3, top + 1, left + 1]
        )

    def members(self, patch: Patch) -> int:
        """Return how many times a box reaches into a tile of the patch."""
        return _within(self.pairs, patch)

    def memory_beside(self, patch: Patch) -> int:
        """Return the bytes that a patch needs beside segments."""
        return 0 if self.beside is None else _within(self.beside, patch)

    def memory_of_segments(self, patch: Patch) -> int:
        """Return the bytes that the segments of a patch need, at most."""
        return self.boxes(patch) * self.segment_bytes + self.members(patch) * MEMBER_BYTES

    def memory(self, patch: Patch) -> int:
        """Return the bytes that a patch needs, at most."""
        return self.memory_of_segments(patch) + self.memory_beside(patch)


def _within(sums: np.ndarray, patch: Patch) -> int:
    """Return what a patch holds of something whose sums over rows and columns before are known."""
    left, top, right, bottom = patch
    return int(sums[bottom, right] - sums[top, right] - sums[bottom, left] + sums[top, left])


def false_position(function: Callable[[int], float], low: int, high: int, wanted: float) -> int:
    """Return the greatest whole number from low to high at which a function that does not fall is at most `wanted`.

    function(low) counts as at most `wanted`. Each step goes to where the straight line between the ends reaches `wanted`, or, as
    often as that has not halved the interval, to its middle. [Press et al., Numerical Recipes, 9.2]
    """
    if function(high) <= wanted:
        return high
    bottom, top = function(low), function(high)
    halve = False
    while high - low > 1:
        share = (wanted - bottom) / (top - bottom) if top > bottom else 0.5
        middle = (low + high) // 2 if halve else min(max(low + int(share * (high - low)), low + 1), high - 1)
        value, width = function(middle), high - low
        if value <= wanted:
            low, bottom = middle, value
        else:
            high, top = middle, value
        halve = 2 * (high - low) > width
    return low


def patches_within(counts: Counts, whole: Patch, budget: float, uncut: bool = False) -> Iterator[Patch]:
    """Yield the patches of a picture, from the top, each within a budget of bytes unless it is a single tile.

    `uncut` patches are as wide as the picture: those may be single rows of tiles that need more.
    """
    top = whole.top
    while top < whole.bottom:
        bottom = _rows_within(counts, whole._replace(top=top), budget)
        band = whole._replace(top=top, bottom=bottom)
        while band.left < whole.right:
            right = whole.right if uncut else _columns_within(counts, band, budget)
            yield band._replace(right=right)
            band = band._replace(left=right)
        top = bottom


def _rows_within(counts: Counts, patch: Patch, budget: float) -> int:
    """Return the end of the most rows of a patch, from its top, that fit; one more than its top if none do."""
    return false_position(lambda end: counts.memory(patch._replace(bottom=end)), patch.top + 1, patch.bottom, budget)


def _columns_within(counts: Counts, patch: Patch, budget: float) -> int:
    """Return the end of the most columns of a patch, from its left, that fit; one more than its left if none do."""
    return false_position(lambda end: counts.memory(patch._replace(right=end)), patch.left + 1, patch.right, budget)
