"""Layers: the fragments of polygons, made tile by tile, in order for each pixel.

A fragment has the samples in which its triangle is seen, and the triangle's key, opacity and colour there. A pixel's
fragments are in the order of (key, triangle). Behind a group of pixels that are covered whole, in all
their samples, by fragments of opacity exactly 1, nothing is seen: the farthest of their keys is its limit.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.coverage import ALL, PIXELS, SAMPLES
from graphfx.render.layer import GROUPS, TILE_HEIGHT, TILE_WIDTH
from graphfx.render.order import merge_sort, ordered_bits
from graphfx.render.pending import LANES
from graphfx.render.resolve import (
    clear_depths,
    enter_depths,
    pixels_spanned,
    pixels_touched,
    samples_before,
    samples_named,
    shape_of,
)
from graphfx.render.shading import middle, shade


class Layers(NamedTuple):
    """The fragments of the tiles of a patch, row by row, and the limits of their groups.

    Tile k has the row rows[k] of `firsts`, or none, -1; its pixel p (8 to a row) has the fragments
    firsts[row, p] : firsts[row, p + 1], nearest first: keys, samples as bits, and (opacity, red, green, blue).
    """

    rows: np.ndarray
    firsts: np.ndarray
    keys: np.ndarray
    masks: np.ndarray
    values: np.ndarray
    limits: np.ndarray


class Fragments(NamedTuple):
    """Room for the fragments of one tile as they are found, in the order of triangles."""

    pixels: np.ndarray
    triangles: np.ndarray
    masks: np.ndarray
    keys: np.ndarray
    key_bits: np.ndarray
    values: np.ndarray
    words: np.ndarray
    spare: np.ndarray


@inner
def _depths(triangles, members, room, left, top):
    """Resolve the opaque triangles of a tile; return the most fragments that it can have."""
    clear_depths(room)
    most = 0
    for number in range(members.shape[0]):
        t = members[number]
        shape = shape_of(triangles.places[t], room, left, top)
        most += pixels_touched(shape)
        if triangles.opaque[t]:
            enter_depths(shape, room, number, left, top)
    return most


@inner
def _find(triangles, members, room, left, top, made):
    """Write the fragments of a tile; return how many."""
    count = 0
    for number in range(members.shape[0]):
        t = members[number]
        shape = shape_of(triangles.places[t], room, left, top)
        for row in range(shape.top, shape.bottom + 1):
            for column in range(shape.left, shape.right + 1):
                pixel = row * TILE_WIDTH + column
                if triangles.opaque[t]:
                    bits = samples_named(room, pixel, number)
                else:
                    bits = samples_before(shape, room, number, pixel, left + column, top + row)
                if bits:
                    made.pixels[count], made.triangles[count], made.masks[count] = pixel, t, bits
                    count += 1
    return count


@inner
def _shade(triangles, looks, left, top, made, count):
    """Give fragments their keys and looks."""
    for i in range(count):
        across, down = middle(np.int64(made.masks[i]))
        x, y = left + made.pixels[i] % TILE_WIDTH, top + made.pixels[i] // TILE_WIDTH
        centre, mean = (x + 0.5, y + 0.5), (x + across, y + down)
        made.keys[i] = shade(triangles, looks, made.triangles[i], centre, mean, made.values[i]) + np.float32(0.0)


@inner
def _sort(made, count, firsts, at, keys, masks, values):
    """Put fragments that are seen in order at row `at` of the output, and note each pixel's first; return the next row."""
    for pixel in range(PIXELS + 1):
        firsts[pixel] = 0
    for i in range(count):
        if made.values[i, 0] > 0.0:
            firsts[made.pixels[i] + 1] += 1
    for pixel in range(PIXELS):
        firsts[pixel + 1] += firsts[pixel]
    for i in range(count):
        if made.values[i, 0] > 0.0:
            pixel = made.pixels[i]
            made.words[firsts[pixel]] = ordered_bits(made.key_bits[i]) << np.uint64(32) | np.uint64(i)
            firsts[pixel] += 1
    start = 0
    for pixel in range(PIXELS):
        stop = firsts[pixel]
        merge_sort(made.words[start:stop], made.spare, stop - start)
        firsts[pixel] = at + start
        start = stop
    firsts[PIXELS] = at + start
    for place in range(start):
        i = int(made.words[place] & np.uint64(0xFFFFFFFF))
        keys[at + place], masks[at + place] = made.keys[i], made.masks[i]
        for c in range(4):
            values[at + place, c] = made.values[i, c]
    return at + start


@inner
def _closing_key(layers, start, stop):
    """Return the key at which fragments of opacity 1 have covered a pixel whole; infinity if they never do."""
    covered = 0
    for i in range(start, stop):
        if layers.values[i, 0] == 1.0:
            covered |= int(layers.masks[i])
        if covered == ALL:
            return layers.keys[i]
    return np.float32(np.inf)


@inner
def _limit(firsts, layers, group, columns, rows):
    """Return a group's limit; of its pixels only those in the picture count, `columns` by `rows` of the tile."""
    limit = np.float32(-np.inf)
    for pixel in range(group * LANES, (group + 1) * LANES):
        if pixel % TILE_WIDTH < columns and pixel // TILE_WIDTH < rows:
            limit = max(limit, _closing_key(layers, firsts[pixel], firsts[pixel + 1]))
    return limit


@compiled
def most_fragments(triangles, bins, start, stop, most):
    """Write how many fragments each of tiles start ... stop - 1 of the picture can have, at most."""
    for k in range(start, stop):
        left, top = np.float64(k % bins.across * TILE_WIDTH), np.float64(k // bins.across * TILE_HEIGHT)
        opaque = 0
        for number in range(bins.starts[k], bins.starts[k + 1]):
            t = bins.members[number]
            count = pixels_spanned(triangles.places[t], left, top)
            if triangles.opaque[t]:
                opaque += count
            else:
                most[k] += count
        most[k] += min(opaque, PIXELS * SAMPLES)


@compiled
def make_layers(triangles, looks, bins, patch, first, stop, room, made, layers):
    """Make the layers of tiles first ... stop - 1 of a patch, until there is no room.

    Return the tile reached, the rows and fragments that are used, and, where there was none, the room wanted.
    """
    row, at = 0, 0
    for k in range(first, stop):
        across = patch.right - patch.left
        tile_column, tile_row = patch.left + k % across, patch.top + k // across
        place = tile_row * bins.across + tile_column
        members = bins.members[bins.starts[place] : bins.starts[place + 1]]
        if members.shape[0] == 0:
            continue
        left, top = tile_column * TILE_WIDTH, tile_row * TILE_HEIGHT
        most = _depths(triangles, members, room, np.float64(left), np.float64(top))
        if most > min(made.keys.shape[0], layers.keys.shape[0] - at):
            return k, row, at, most
        count = _find(triangles, members, room, np.float64(left), np.float64(top), made)
        _shade(triangles, looks, left, top, made, count)
        firsts = layers.firsts[row]
        at = _sort(made, count, firsts, at, layers.keys, layers.masks, layers.values)
        for group in range(GROUPS):
            layers.limits[k - first, group] = _limit(firsts, layers, group, bins.width - left, bins.height - top)
        layers.rows[k - first] = row
        row += 1
    return stop, row, at, 0
