"""Resolve the triangles of a tile: which are seen in which samples of its pixels.

Opaque triangles go through a buffer of depths, one for each sample,

    key of a sample = K(p) + (g_x o.x + g_y o.y)       K(p): at the pixel's corner; float32, between the corners' keys

so that where they meet, too, the edge is anti-aliased, and a pixel has at most sixteen of their fragments.
What is left of a transparent triangle are the samples in which no opaque one is before it. At equal keys the earlier
triangle is before the later.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes import any_lane, load, mask_bits, mask_from_bits, store
from graphfx.lanes.inner import inner
from graphfx.math.primitives import maximum, minimum, where
from graphfx.render.coverage import (
    ALL,
    PIXELS,
    SAMPLE_X,
    SAMPLE_Y,
    SAMPLES,
    contains_tile,
    samples_inside,
    write_edge,
)
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH
from graphfx.render.shading import Plane, key_at, plane_of, twice_area

F = np.float32


class Room(NamedTuple):
    """One thread's memory: three edges, the offsets of the samples from them and of their keys, and the buffer of depths.

    `names` are the triangles that are nearest, by their places in the tile's list, -1 where there is none; `name` has
    room for one. Both are there a second time as if they were floats, to be moved as lanes.
    """

    edges: np.ndarray
    offsets: np.ndarray
    slopes: np.ndarray
    depths: np.ndarray
    names: np.ndarray
    name_lanes: np.ndarray
    name: np.ndarray
    name_lane: np.ndarray


def new_room() -> Room:
    """Return memory for one thread."""
    names, name = np.empty(PIXELS * SAMPLES, np.int32), np.empty(1, np.int32)
    return Room(
        np.empty((3, 7)), np.empty((3, SAMPLES)), np.empty(SAMPLES, F), np.empty(PIXELS * SAMPLES, F),
        names, names.view(F), name, name.view(F),
    )


class Shape(NamedTuple):
    """A triangle in a tile: its plane, whether it holds the whole tile, the tile's columns and rows that it may touch."""

    plane: Plane
    whole: bool
    left: np.int64
    right: np.int64
    top: np.int64
    bottom: np.int64


@inner
def _span(a, b, c, start, size):
    """Return the first and last of `size` pixels from `start` on that hold something between three coordinates."""
    low, high = min(a, min(b, c)) - start, max(a, max(b, c)) - start
    first, last = math.floor(min(max(low, 0.0), float(size))), math.floor(min(max(high, -1.0), float(size - 1)))
    return np.int64(first), np.int64(last)


@inner
def shape_of(place, room, left, top):
    """Return a triangle in the tile at (left, top), and write its edges and the offsets of the samples."""
    turn, whole = twice_area(place), True
    for e in range(3):
        a, b = 2 * e, 2 * ((e + 1) % 3)
        write_edge(room.edges[e], room.offsets[e], place[a], place[a + 1], place[b], place[b + 1], turn)
        whole = whole and contains_tile(room.edges[e], left, top)
    plane = plane_of(place)
    for i in range(SAMPLES):
        room.slopes[i] = F(plane.kx * SAMPLE_X[i] + plane.ky * SAMPLE_Y[i])
    column, last_column = _span(place[0], place[2], place[4], left, TILE_WIDTH)
    row, last_row = _span(place[1], place[3], place[5], top, TILE_HEIGHT)
    return Shape(plane, whole, column, last_column, row, last_row)


@inner
def pixels_spanned(place, left, top):
    """Return how many pixels of the tile at (left, top) the box of a triangle spans."""
    column, last_column = _span(place[0], place[2], place[4], left, TILE_WIDTH)
    row, last_row = _span(place[1], place[3], place[5], top, TILE_HEIGHT)
    return max(last_column - column + 1, 0) * max(last_row - row + 1, 0)


@inner
def pixels_touched(shape):
    """Return how many pixels the triangle may touch."""
    return max(shape.right - shape.left + 1, 0) * max(shape.bottom - shape.top + 1, 0)


@inner
def samples_covered(shape, room, x, y):
    """Return the bits of a pixel's samples in a triangle."""
    return ALL if shape.whole else samples_inside(room.edges, room.offsets, x, y)


@inner
def _sample_keys(plane, room, x, y):
    """Return the keys of a pixel's samples."""
    keys = load(room.slopes, 0) + F(key_at(plane, x, y))
    return minimum(maximum(keys, F(plane.nearest)), F(plane.farthest))


@inner
def clear_depths(room):
    """Begin a tile: nothing is there."""
    for i in range(PIXELS * SAMPLES):
        room.depths[i] = F(np.inf)
        room.names[i] = -1


@inner
def enter_depths(shape, room, number, left, top):
    """Put an opaque triangle, `number` in the tile's list, where it is nearest; later ones go behind at equal keys."""
    room.name[0] = number
    name = room.name_lane[0]
    for row in range(shape.top, shape.bottom + 1):
        for column in range(shape.left, shape.right + 1):
            x, y = left + column, top + row
            bits = samples_covered(shape, room, x, y)
            if bits == 0:
                continue
            at = (row * TILE_WIDTH + column) * SAMPLES
            keys, depths = _sample_keys(shape.plane, room, x, y), load(room.depths, at)
            nearer = mask_from_bits(bits) & (keys < depths)
            if any_lane(nearer):
                store(room.depths, at, where(nearer, keys, depths))
                store(room.name_lanes, at, where(nearer, name, load(room.name_lanes, at)))


@inner
def samples_named(room, pixel, number):
    """Return the bits of a pixel's samples in which an opaque triangle is the nearest."""
    bits = 0
    for i in range(SAMPLES):
        if room.names[pixel * SAMPLES + i] == number:
            bits |= 1 << i
    return bits


@inner
def samples_before(shape, room, number, pixel, x, y):
    """Return the bits of a pixel's samples in which a transparent triangle lies before all opaque ones."""
    bits = samples_covered(shape, room, x, y)
    if bits == 0:
        return 0
    keys, depths = _sample_keys(shape.plane, room, x, y), load(room.depths, pixel * SAMPLES)
    equal = bits & mask_bits(keys == depths)
    found = bits & mask_bits(keys < depths)
    if equal:
        for i in range(SAMPLES):
            if equal >> i & 1 and room.names[pixel * SAMPLES + i] > number:
                found |= 1 << i
    return found
