"""Bin triangles into tiles, in two passes as segments are, in the order of triangles.

A triangle belongs to a tile if its bounding box touches it and no edge has the whole tile, and a pixel more, outside.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH
from graphfx.render.shading import twice_area
from graphfx.render.triangles import GRAIN, Triangles
from graphfx.store.primitives import offsets
from graphfx.store.threads import parallel_ranges, ranges

SAFE = 1e6
"""Pixels within which edges are told from tiles without doubt."""


class TriangleBins(NamedTuple):
    """The grid of tiles: the triangles of tile k are members[starts[k] : starts[k + 1]]."""

    starts: np.ndarray
    members: np.ndarray
    across: int
    width: int
    height: int


@inner
def _tiles(a, b, c, size, count):
    """Return the first and last of `count` tiles of a size between three coordinates."""
    low, high = min(a, min(b, c)), max(a, max(b, c))
    first = math.floor(min(max(low / size, 0.0), float(count)))
    last = math.floor(min(max(high / size, -1.0), float(count - 1)))
    return int(first), int(last)


@inner
def _outside(x0, y0, x1, y1, sign, left, top):
    """Return whether a tile, a pixel wider each way, lies outside an edge."""
    dx, dy = sign * (x1 - x0), sign * (y1 - y0)
    x = left - 1.0 if dy > 0.0 else left + (TILE_WIDTH + 1.0)
    y = top + (TILE_HEIGHT + 1.0) if dx > 0.0 else top - 1.0
    return dx * (y - y0) - dy * (x - x0) < 0.0


@inner
def _misses(place, sign, safe, left, top):
    """Return whether one of a triangle's edges has a tile outside."""
    return safe and (
        _outside(place[0], place[1], place[2], place[3], sign, left, top)
        or _outside(place[2], place[3], place[4], place[5], sign, left, top)
        or _outside(place[4], place[5], place[0], place[1], sign, left, top)
    )


@compiled
def _bin(triangles, start, stop, across, down, places, members):
    """Count each tile's triangles in `places`; or, if there are `members`, write them there and move the places on."""
    write = members.size > 0
    for t in range(start, stop):
        place = triangles.places[t]
        sign = 1.0 if twice_area(place) > 0.0 else -1.0
        safe = True
        for c in range(6):
            safe = safe and abs(place[c]) < SAFE
        first_column, last_column = _tiles(place[0], place[2], place[4], TILE_WIDTH, across)
        first_row, last_row = _tiles(place[1], place[3], place[5], TILE_HEIGHT, down)
        for row in range(first_row, last_row + 1):
            for column in range(first_column, last_column + 1):
                if _misses(place, sign, safe, float(column * TILE_WIDTH), float(row * TILE_HEIGHT)):
                    continue
                tile = row * across + column
                if write:
                    members[places[tile]] = t
                places[tile] += 1


def bin_triangles(triangles: Triangles, width: int, height: int, threads: int) -> TriangleBins:
    """Return which triangles touch which tile, in order."""
    across, down = -(-width // TILE_WIDTH), -(-height // TILE_HEIGHT)
    bounds = ranges(len(triangles.look), threads, GRAIN)
    counts = np.zeros((len(bounds), across * down), np.int64)
    nothing = np.empty(0, np.int32)

    def count(piece: int, start: int, stop: int) -> None:
        _bin(triangles, start, stop, across, down, counts[piece], nothing)

    parallel_ranges(count, bounds, threads)
    starts = offsets(counts.sum(axis=0))
    places = starts[:-1] + np.cumsum(counts, axis=0) - counts
    members = np.empty(starts[-1], np.int32)

    def scatter(piece: int, start: int, stop: int) -> None:
        _bin(triangles, start, stop, across, down, places[piece], members)

    if members.size:
        parallel_ranges(scatter, bounds, threads)
    return TriangleBins(starts, members, across, width, height)
