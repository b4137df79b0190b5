"""Samples: every fragment of every pixel, nearest first, and what single numbers are made of them.

For what is wanted besides the picture: deep files, and channels such as depth. A band of one row of tiles
at a time is made, so that memory follows the fragments of a band. The order is the renderer's, (key, rank).

    seen_i = |a_i| product over j < i of (1 - max(a_j, 0))        how much of fragment i is seen; a < 0: the blend is `add`
    nearest = the least depth of those with seen > 0
    strongest = the particle of the fragment that is seen most, the nearest among equals

A fragment of a polygon covers some of a pixel's sixteen samples. Its opacity here is what it takes from the light that
the polygons before it let through, a mean_s(M_s P_s) / mean_s(P_s) as in cover.py, so that the samples still composite to
the picture. Particles that opaque polygons are known to hide are left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from graphfx.lanes import compiled, mask_bits, store
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.cover import hides
from graphfx.render.layer import (
    GROUP_HEIGHT,
    TILE_HEIGHT,
    TILE_WIDTH,
    alpha_of,
    colored,
    fragments,
    groups_touched,
    localize,
)
from graphfx.render.layers import Layers
from graphfx.render.order import merge_sort, ordered_bits
from graphfx.render.pending import LANES, PLANES
from graphfx.render.segments import Segments
from graphfx.render.tiles import Tiles, lanes_inside, tile_corner
from graphfx.store.primitives import offsets
from graphfx.store.threads import parallel_ranges, ranges

NOTHING = -1
"""The particle of a pixel in which nothing is seen, and of polygons."""


@dataclass
class Samples:
    """The fragments of some whole rows of the picture, pixel after pixel.

    Those of the pixel in row `top` + y and column x are offsets[p] ... offsets[p + 1] - 1, p = y `width` + x.
    `opacity` is negative where the blend is `add`; `color` (n, 3) is linear and not multiplied by it; `depth` is in m
    along the camera's axis; `particle` counts through all streams, and is NOTHING for polygons.
    """

    top: int
    width: int
    offsets: np.ndarray
    depth: np.ndarray
    opacity: np.ndarray
    color: np.ndarray
    particle: np.ndarray


class Room(NamedTuple):
    """Room for a band: pixel p has fragments from row starts[p] on, so far filled[p]; polygons are -1 - their samples as bits."""

    starts: np.ndarray
    filled: np.ndarray
    words: np.ndarray
    values: np.ndarray
    particle: np.ndarray
    keys: np.ndarray


def _room_for(counts: np.ndarray) -> Room:
    """Return room for so many fragments of each pixel."""
    starts = offsets(counts)
    total = int(starts[-1])
    return Room(
        starts, np.zeros(len(counts), np.int64), np.empty(total, np.uint64), np.empty((total, 4), np.float32),
        np.empty(total, np.int32), np.empty(total, np.uint32),
    )


@inner
def _count(local, group, square, inside, counts, at, width):
    """Count one segment's fragments in one group, whose first pixel is number `at` of the band."""
    _, _, _, hit = fragments(local, group, square)
    bits = mask_bits(hit) & inside
    for lane in range(LANES):
        if bits >> lane & 1:
            counts[at + lane // TILE_WIDTH * width + lane % TILE_WIDTH] += 1


@inner
def _count_polygons(tiles, layers, k, left, top, counts):
    """Count the fragments of polygons in each pixel of a tile."""
    firsts = layers.firsts[layers.rows[k]]
    for pixel in range(TILE_WIDTH * TILE_HEIGHT):
        y, x = pixel // TILE_WIDTH, left + pixel % TILE_WIDTH
        if x < tiles.width and top + y < tiles.height:
            counts[y * tiles.width + x] += firsts[pixel + 1] - firsts[pixel]


@inner
def _append(room, pixel, bits, particle):
    """Append a fragment to a pixel, apart from its values; return its row."""
    place = room.starts[pixel] + room.filled[pixel]
    room.words[place] = ordered_bits(bits) << np.uint64(32) | np.uint64(room.filled[pixel])
    room.particle[place] = particle
    room.filled[pixel] += 1
    return place


@inner
def _gather(segments, q, local, group, square, inside, planes, at, width, room):
    """Append one segment's fragments in one group to their pixels."""
    key, shape, t, hit = fragments(local, group, square)
    bits = mask_bits(hit) & inside
    if bits == 0:
        return
    opacity, red, green, blue = colored(segments, q, local, key, t, square)
    store(planes, 0, key)
    store(planes, LANES, where(hit, alpha_of(opacity, shape), 0.0))
    store(planes, 2 * LANES, red)
    store(planes, 3 * LANES, green)
    store(planes, 4 * LANES, blue)
    key_bits = planes.view(np.uint32)
    for lane in range(LANES):
        if bits >> lane & 1:
            pixel = at + lane // TILE_WIDTH * width + lane % TILE_WIDTH
            place = _append(room, pixel, key_bits[lane], segments.particle[q])
            for plane in range(4):
                room.values[place, plane] = planes[(plane + 1) * LANES + lane]


@inner
def _gather_polygons(tiles, layers, k, left, top, room):
    """Append the fragments of polygons in a tile; they come first, since they go before particles of the same key."""
    firsts, key_bits = layers.firsts[layers.rows[k]], layers.keys.view(np.uint32)
    for pixel in range(TILE_WIDTH * TILE_HEIGHT):
        y, x = pixel // TILE_WIDTH, left + pixel % TILE_WIDTH
        if x < tiles.width and top + y < tiles.height:
            for row in range(firsts[pixel], firsts[pixel + 1]):
                place = _append(room, y * tiles.width + x, key_bits[row], -1 - np.int64(layers.masks[row]))
                for plane in range(4):
                    room.values[place, plane] = layers.values[row, plane]


@compiled
def find_samples(segments, tiles, layers, start, stop, counts, planes, room):
    """Count the fragments of each pixel of tiles start ... stop - 1, all in one row of tiles; or, if there is room, write them.

    Each pixel's are in order of rank, those of polygons before all others.
    """
    for k in range(start, stop):
        left, top = tile_corner(tiles, k)
        if layers is not None and layers.rows[k] >= 0:
            if room is None:
                _count_polygons(tiles, layers, k, left, top, counts)
            else:
                _gather_polygons(tiles, layers, k, left, top, room)
        for place in range(tiles.starts[k], tiles.starts[k + 1]):
            q = tiles.members[place]
            local = localize(segments, q, left + 0.5, top + 0.5)
            first, last = groups_touched(local)
            for group in range(first, last + 1):
                if layers is not None and hides(layers, k, group, local.nearest):
                    continue
                inside = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
                at = GROUP_HEIGHT * group * tiles.width + left
                if room is None:
                    _count(local, group, tiles.perspective, inside, counts, at, tiles.width)
                else:
                    _gather(segments, q, local, group, tiles.perspective, inside, planes, at, tiles.width, room)


@inner
def _sort_pixel(room, first, stop, spare_words, spare_values, spare_particle):
    """Bring one pixel's fragments, in rows first ... stop - 1, into order, and write their keys as bits."""
    count = stop - first
    merge_sort(room.words[first:stop], spare_words, count)
    for i in range(count):
        spare_particle[i] = room.particle[first + i]
        for plane in range(4):
            spare_values[i, plane] = room.values[first + i, plane]
    for i in range(count):
        word, row = room.words[first + i], first + i
        place = np.int64(word & np.uint64(0xFFFFFFFF))
        bits = word >> np.uint64(32)
        room.keys[row] = np.uint32(bits ^ (np.uint64(0x80000000) if bits >> np.uint64(31) else np.uint64(0xFFFFFFFF)))
        room.particle[row] = spare_particle[place]
        for plane in range(4):
            room.values[row, plane] = spare_values[place, plane]


@inner
def _cover_pixel(room, first, stop, passed):
    """Give the polygons among one pixel's fragments the opacity that they have for the whole pixel; `passed` is P_s."""
    for s in range(LANES):
        passed[s] = np.float32(1.0)
    for row in range(first, stop):
        if room.particle[row] < 0:
            samples, opacity = -1 - np.int64(room.particle[row]), room.values[row, 0]
            total = taken = np.float32(0.0)
            for s in range(LANES):
                total += passed[s]
                if samples >> s & 1:
                    taken += passed[s] * opacity
                    passed[s] -= passed[s] * opacity
            room.values[row, 0] = min(taken / total, np.float32(1.0)) if total > 0.0 else np.float32(0.0)
            room.particle[row] = NOTHING


@compiled
def sort_samples(tiles, layers, start, stop, room):
    """Sort the fragments of each pixel of tiles start ... stop - 1, all in one row of tiles."""
    first_column = tile_corner(tiles, start)[0]
    last_column = min(tile_corner(tiles, stop - 1)[0] + TILE_WIDTH, tiles.width)
    most = 0
    for pixel in range(len(room.filled)):
        if first_column <= pixel % tiles.width < last_column:
            most = max(most, room.filled[pixel])
    spare_words, spare_values = np.empty(most, np.uint64), np.empty((most, 4), np.float32)
    spare_particle, passed = np.empty(most, np.int32), np.empty(LANES, np.float32)
    for pixel in range(len(room.filled)):
        if first_column <= pixel % tiles.width < last_column:
            first, last = room.starts[pixel], room.starts[pixel + 1]
            _sort_pixel(room, first, last, spare_words, spare_values, spare_particle)
            if layers is not None:
                _cover_pixel(room, first, last, passed)


def sample_bands(segments: Segments, tiles: Tiles, layers: Layers | None, threads: int) -> Iterator[Samples]:
    """Yield the samples of each row of a patch's tiles, from the top; the patch is as wide as the picture."""
    for row in range((len(tiles.starts) - 1) // tiles.across):
        yield _band(segments, tiles, layers, row, threads)


def _band(segments: Segments, tiles: Tiles, layers: Layers | None, row: int, threads: int) -> Samples:
    top, first = (tiles.row + row) * TILE_HEIGHT, row * tiles.across
    counts = np.zeros(min(TILE_HEIGHT, tiles.height - top) * tiles.width, np.int64)
    bounds = [(first + start, first + stop) for start, stop in ranges(tiles.across, threads)]

    def count(_: int, start: int, stop: int) -> None:
        find_samples(segments, tiles, layers, start, stop, counts, None, None)

    parallel_ranges(count, bounds, threads)
    room = _room_for(counts)

    def gather(_: int, start: int, stop: int) -> None:
        find_samples(segments, tiles, layers, start, stop, counts, np.zeros(PLANES * LANES, np.float32), room)
        sort_samples(tiles, layers, start, stop, room)

    parallel_ranges(gather, bounds, threads)
    key = room.keys.view(np.float32)
    depth = -1.0 / key if tiles.perspective else key
    opacity, color = np.ascontiguousarray(room.values[:, 0]), room.values[:, 1:]
    return Samples(top, tiles.width, room.starts, depth, opacity, color, room.particle)


@compiled
def fold_samples(starts: Any, depth: Any, opacity: Any, particle: Any, nearest: Any, strongest: Any) -> None:
    """Write each pixel's nearest depth and strongest particle, where anything is seen in it."""
    for pixel in range(len(starts) - 1):
        through, most, empty = np.float32(1.0), np.float32(0.0), True
        for i in range(starts[pixel], starts[pixel + 1]):
            seen = through * abs(opacity[i])
            if seen > 0.0 and empty:
                nearest[pixel], empty = depth[i], False
            if seen > most:
                most, strongest[pixel] = seen, particle[i]
            through -= through * max(opacity[i], np.float32(0.0))
