"""Survey: where on the picture streaks are, before any of them is made."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.bins import tiles_near
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH
from graphfx.render.order import ordered_word
from graphfx.render.projection import touches
from graphfx.render.sight import finite, screen_segment

MARGIN = 0.02
"""Pixels added to the reach: no streak may be found in a tile in which it was not surveyed."""


@compiled
def survey(
    columns: Any, view: Any, look: Any, window: Any, first: int, count: int, tops: Any, bottoms: Any, corners: Any
) -> int:
    """Write the first and last row of tiles that each particle reaches, and count its box by its corners (see Counts).

    Return how many particles were dropped. A particle that is not to be seen keeps the rows that it has.
    """
    dropped = 0
    down, across = corners.shape[1] - 1, corners.shape[2] - 1
    for i in range(count):
        if not finite(columns, i):
            dropped += 1
            continue
        visible, _, _, segment, _, _ = screen_segment(columns, i, view, look)
        if not visible or not touches(segment, look.reach, window):
            continue
        x, y, dx, dy, r0, r1, _, _ = segment
        reach = max(r0, r1, 1.0) + look.reach + MARGIN
        left, right = tiles_near(min(x, x + dx) - reach, max(x, x + dx) + reach, TILE_WIDTH, across)
        top, bottom = tiles_near(min(y, y + dy) - reach, max(y, y + dy) + reach, TILE_HEIGHT, down)
        if left > right or top > bottom:
            continue
        tops[first + i], bottoms[first + i] = top, bottom
        corners[0, top, left] += 1
        corners[1, top, right + 1] += 1
        corners[2, bottom + 1, left] += 1
        corners[3, bottom + 1, right + 1] += 1
    return dropped


@inner
def _key(segment):
    """Return a segment's nearest key as ordered bits."""
    nearest = min(np.float32(segment[6] + 0.0), np.float32(segment[7] + 0.0))
    return np.int64(ordered_word(nearest))


@compiled
def count_keys(
    columns: Any, view: Any, look: Any, window: Any, first: int, count: int, low: int, high: int, shift: int, counts: Any
) -> None:
    """Count the particles that may touch a window by (nearest key - low) >> shift, where that key is low ... high."""
    for i in range(count):
        number = first + i
        if window.top_rows[number] > window.last_row or window.bottom_rows[number] < window.first_row:
            continue
        visible, _, _, segment, _, _ = screen_segment(columns, i, view, look)
        if visible and touches(segment, look.reach, window):
            key = _key(segment)
            if low <= key <= high:
                counts[(key - low) >> shift] += 1
