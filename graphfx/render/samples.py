"""Samples: every fragment of every pixel, nearest first, and what single numbers are made of them.

For what is wanted besides the picture: deep files, and channels such as depth. A band of one row of tiles
at a time is made, so that memory follows the fragments of a band. The order is the renderer's, (key, rank).

    seen_i = |a_i| product over j < i of (1 - max(a_j, 0))        how much of fragment i is seen; a < 0: the blend is `add`
    nearest = the least depth of those with seen > 0
    strongest = the particle of the fragment that is seen most, the nearest among equals
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.lanes import compiled, mask_bits, store
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.layer import (
    GROUP_HEIGHT,
    TILE_HEIGHT,
    TILE_WIDTH,
    colored,
    fragments,
    groups_touched,
    localize,
)
from graphfx.render.order import merge_sort, ordered_bits
from graphfx.render.pending import LANES, PLANES
from graphfx.render.segments import Segments
from graphfx.render.tiles import Tiles, lanes_inside, tile_corner
from graphfx.store.primitives import offsets
from graphfx.store.threads import parallel_ranges, ranges

NOTHING = -1
"""The particle of a pixel in which nothing is seen."""


@dataclass
class Samples:
    """The fragments of some whole rows of the picture, pixel after pixel.

    Those of the pixel in row `top` + y and column x are offsets[p] ... offsets[p + 1] - 1, p = y `width` + x.
    `opacity` is negative where the blend is `add`; `color` (n, 3) is linear and not multiplied by it; `depth` is in m
    along the camera's axis; `particle` counts through all streams.
    """

    top: int
    width: int
    offsets: np.ndarray
    depth: np.ndarray
    opacity: np.ndarray
    color: np.ndarray
    particle: np.ndarray


@inner
def _count(segments, q, local, group, square, inside, counts, at, width):
    """Count one segment's fragments in one group, whose first pixel is number `at` of the band."""
    _, _, _, hit = fragments(local, group, square)
    bits = mask_bits(hit) & inside
    for lane in range(LANES):
        if bits >> lane & 1:
            counts[at + lane // TILE_WIDTH * width + lane % TILE_WIDTH] += 1


@compiled
def count_samples(segments, tiles, start, stop, counts):
    """Count the fragments of each pixel of tiles start ... stop - 1, all in one row of tiles."""
    for k in range(start, stop):
        left, top = tile_corner(tiles, k)
        for place in range(tiles.starts[k], tiles.starts[k + 1]):
            q = tiles.members[place]
            local = localize(segments, q, left + 0.5, top + 0.5)
            first, last = groups_touched(local)
            for group in range(first, last + 1):
                inside = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
                at = GROUP_HEIGHT * group * tiles.width + left
                _count(segments, q, local, group, tiles.perspective, inside, counts, at, tiles.width)


@inner
def _gather(segments, q, local, group, square, inside, planes, at, width, starts, filled, words, values, particle):
    """Append one segment's fragments in one group to their pixels."""
    key, shape, t, hit = fragments(local, group, square)
    bits = mask_bits(hit) & inside
    if bits == 0:
        return
    opacity, red, green, blue = colored(segments, q, local, key, t, square)
    store(planes, 0, key)
    store(planes, LANES, where(hit, opacity * shape, 0.0))
    store(planes, 2 * LANES, red)
    store(planes, 3 * LANES, green)
    store(planes, 4 * LANES, blue)
    key_bits = planes.view(np.uint32)
    for lane in range(LANES):
        if bits >> lane & 1:
            pixel = at + lane // TILE_WIDTH * width + lane % TILE_WIDTH
            place = starts[pixel] + filled[pixel]
            words[place] = ordered_bits(key_bits[lane]) << np.uint64(32) | np.uint64(filled[pixel])
            for plane in range(4):
                values[place, plane] = planes[(plane + 1) * LANES + lane]
            particle[place] = segments.particle[q]
            filled[pixel] += 1


@inner
def _sort_pixel(words, values, particle, spare_words, spare_values, spare_particle, keys):
    """Bring one pixel's fragments into order, and write their keys as bits."""
    count = len(words)
    merge_sort(words, spare_words, count)
    for i in range(count):
        spare_particle[i] = particle[i]
        for plane in range(4):
            spare_values[i, plane] = values[i, plane]
    for i in range(count):
        place = np.int64(words[i] & np.uint64(0xFFFFFFFF))
        bits = words[i] >> np.uint64(32)
        keys[i] = np.uint32(bits ^ (np.uint64(0x80000000) if bits >> np.uint64(31) else np.uint64(0xFFFFFFFF)))
        particle[i] = spare_particle[place]
        for plane in range(4):
            values[i, plane] = spare_values[place, plane]


@compiled
def gather_samples(segments, tiles, start, stop, starts, planes, filled, words, values, particle):
    """Write the fragments of tiles start ... stop - 1, of one row, each pixel's from `starts` on, in order of rank."""
    for k in range(start, stop):
        left, top = tile_corner(tiles, k)
        for place in range(tiles.starts[k], tiles.starts[k + 1]):
            q = tiles.members[place]
            local = localize(segments, q, left + 0.5, top + 0.5)
            first, last = groups_touched(local)
            for group in range(first, last + 1):
                inside = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
                at = GROUP_HEIGHT * group * tiles.width + left
                _gather(segments, q, local, group, tiles.perspective, inside, planes, at, tiles.width,
                        starts, filled, words, values, particle)


@compiled
def sort_samples(tiles, start, stop, starts, words, values, particle, keys):
    """Sort the fragments of each pixel of tiles start ... stop - 1, all in one row of tiles."""
    left, right = start % tiles.across * TILE_WIDTH, min(((stop - 1) % tiles.across + 1) * TILE_WIDTH, tiles.width)
    most = 0
    for pixel in range(len(starts) - 1):
        if left <= pixel % tiles.width < right:
            most = max(most, starts[pixel + 1] - starts[pixel])
    spare_words, spare_values = np.empty(most, np.uint64), np.empty((most, 4), np.float32)
    spare_particle = np.empty(most, np.int32)
    for pixel in range(len(starts) - 1):
        if left <= pixel % tiles.width < right:
            a, b = starts[pixel], starts[pixel + 1]
            _sort_pixel(words[a:b], values[a:b], particle[a:b], spare_words, spare_values, spare_particle, keys[a:b])


def sample_bands(segments: Segments, tiles: Tiles, threads: int) -> Iterator[Samples]:
    """Yield the samples of each row of a patch's tiles, from the top; the patch is as wide as the picture."""
    for row in range((len(tiles.starts) - 1) // tiles.across):
        yield _band(segments, tiles, row, threads)


def _band(segments: Segments, tiles: Tiles, row: int, threads: int) -> Samples:
    top, first = (tiles.row + row) * TILE_HEIGHT, row * tiles.across
    counts = np.zeros(min(TILE_HEIGHT, tiles.height - top) * tiles.width, np.int64)
    bounds = [(first + start, first + stop) for start, stop in ranges(tiles.across, threads)]
    parallel_ranges(lambda _, start, stop: count_samples(segments, tiles, start, stop, counts), bounds, threads)
    starts = offsets(counts)
    total = int(starts[-1])
    words, values, particle = np.empty(total, np.uint64), np.empty((total, 4), np.float32), np.empty(total, np.int32)
    keys, filled = np.empty(total, np.uint32), np.zeros(len(counts), np.int64)

    def gather(_: int, start: int, stop: int) -> None:
        planes = np.zeros(PLANES * LANES, np.float32)
        gather_samples(segments, tiles, start, stop, starts, planes, filled, words, values, particle)
        sort_samples(tiles, start, stop, starts, words, values, particle, keys)

    parallel_ranges(gather, bounds, threads)
    key = keys.view(np.float32)
    depth = -1.0 / key if tiles.perspective else key
    return Samples(top, tiles.width, starts, depth, np.ascontiguousarray(values[:, 0]), values[:, 1:], particle)


@compiled
def fold_samples(starts: Any, depth: Any, opacity: Any, particle: Any, nearest: Any, strongest: Any) -> None:
    """Write each pixel's nearest depth and strongest particle, where anything is seen in it."""
    for pixel in range(len(starts) - 1):
        through, most = np.float32(1.0), np.float32(0.0)
        for i in range(starts[pixel], starts[pixel + 1]):
            seen = through * abs(opacity[i])
            if seen > 0.0 and strongest[pixel] == NOTHING:
                nearest[pixel] = depth[i]
            if seen > most:
                most, strongest[pixel] = seen, particle[i]
            through -= through * max(opacity[i], np.float32(0.0))
