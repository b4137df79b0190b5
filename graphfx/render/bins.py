"""Bin segments into tiles, in two passes: count, then write each to its place, in order.

A segment belongs to a tile if it comes within its reach of the pixel centres there: for each row of
tiles the part of the segment near that row is cut out, and the columns that this part comes near.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.falloff import DISC, DISC_RAMP
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH, clipped
from graphfx.render.patches import Patch
from graphfx.render.segments import DX, DY, KEY0, KEY1, RADIUS0, RADIUS1, Segments, X, Y
from graphfx.render.tiles import Tiles
from graphfx.store.primitives import GRAIN, offsets
from graphfx.store.threads import parallel_ranges, ranges

MARGIN = 0.01
"""Pixels added to the reach, so that rounding never loses a fragment."""


@inner
def tiles_near(low, high, size, count):
    """Return the first and last of `count` tiles whose pixel centres reach into low ... high."""
    first = math.ceil(min(max((low - size + 0.5) / size, 0.0), float(count)))
    last = math.floor(min(max((high - 0.5) / size, -1.0), float(count - 1)))
    return int(first), int(last)


@compiled
def _bin(
    segments: Any, start: int, stop: int, column: int, row: int, across: int, down: int, places: Any, members: Any, limits: Any
) -> None:
    """Count each tile's segments in `places`; or, if there are `members`, write them there and move the places on."""
    write = members.size > 0
    for q in range(start, stop):
        place, values = segments.places[q], segments.values[q]
        x, y, dx, dy = place[X] - column * TILE_WIDTH, place[Y] - row * TILE_HEIGHT, place[DX], place[DY]
        reach = np.float64(max(values[RADIUS0], values[RADIUS1], np.float32(1.0))) + MARGIN
        if segments.kind[q] & 3 == DISC:
            reach += DISC_RAMP
        first_row, last_row = tiles_near(min(y, y + dy) - reach, max(y, y + dy) + reach, TILE_HEIGHT, down)
        for tile_row in range(first_row, last_row + 1):
            low = tile_row * TILE_HEIGHT + 0.5 - reach
            first, last = clipped(y, dy, low, low + TILE_HEIGHT - 1.0 + 2.0 * reach, 0.0, 1.0)
            if first > last:
                continue
            a, b = x + first * dx, x + last * dx
            first_column, last_column = tiles_near(min(a, b) - reach, max(a, b) + reach, TILE_WIDTH, across)
            for tile in range(tile_row * across + first_column, tile_row * across + last_column + 1):
                if limits is not None and min(values[KEY0], values[KEY1]) > limits[tile]:
                    continue
                if write:
                    members[places[tile]] = q
                places[tile] += 1


def bin_segments(
    segments: Segments, patch: Patch, width: int, height: int, perspective: bool, threads: int, most: float = math.inf,
    limits: np.ndarray | None = None,
) -> Tiles | None:
    """Return which segments touch which tile of a patch, nearest first in each; None if there are more than `most` such pairs.

    `limits` are keys, one for each tile of the patch: what lies wholly beyond is not seen there, and is left out.
    """
    across, down = patch.right - patch.left, patch.bottom - patch.top
    bounds = ranges(len(segments.kind), threads, GRAIN)
    counts = np.zeros((len(bounds), across * down), np.int64)
    nothing = np.empty(0, np.int32)
    grid = patch.left, patch.top, across, down

    def count(piece: int, start: int, stop: int) -> None:
        _bin(segments, start, stop, *grid, counts[piece], nothing, limits)

    parallel_ranges(count, bounds, threads)
    starts = offsets(counts.sum(axis=0))
    if starts[-1] > most:
        return None
    places = starts[:-1] + np.cumsum(counts, axis=0) - counts
    members = np.empty(starts[-1], np.int32)

    def scatter(piece: int, start: int, stop: int) -> None:
        _bin(segments, start, stop, *grid, places[piece], members, limits)

    if members.size:
        parallel_ranges(scatter, bounds, threads)
    return Tiles(starts, members, patch.left, patch.top, across, width, height, perspective)
