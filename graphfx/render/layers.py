"""Layers: the fragments of polygons, made tile by tile, in order for each pixel.

A fragment has the samples in which its triangle is seen, and the triangle's key, opacity and colour there. A pixel's
fragments are in the order of (key, triangle). Behind a group of pixels that are covered whole, in all
their samples, by fragments of opacity exactly 1, nothing is seen: the farthest of their keys is its limit.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.camera import Camera
from graphfx.render.coverage import ALL
from graphfx.render.layer import GROUPS, TILE_HEIGHT, TILE_WIDTH
from graphfx.render.order import merge_sort, ordered_bits
from graphfx.render.patches import Patch
from graphfx.render.pending import LANES
from graphfx.render.polygons import Lighting, Polygons
from graphfx.render.resolve import (
    PIXELS,
    clear_depths,
    enter_depths,
    new_room,
    pixels_touched,
    samples_before,
    samples_named,
    shape_of,
)
from graphfx.render.shading import Looks, middle, shade
from graphfx.render.textures import tables
from graphfx.render.triangle_bins import TriangleBins, bin_triangles
from graphfx.render.triangles import Triangles, project_polygons
from graphfx.store.threads import parallel_ranges, ranges

PIECES = 8
"""Pieces of a patch for each thread."""
FIRST_CAPACITY = 4096


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


def _room_for(count: int) -> Fragments:
    """Return room for so many fragments of a tile."""
    keys = np.empty(count, np.float32)
    return Fragments(
        np.empty(count, np.int32), np.empty(count, np.int32), np.empty(count, np.uint16), keys, keys.view(np.uint32),
        np.empty((count, 4), np.float32), np.empty(count, np.uint64), np.empty(count, np.uint64),
    )


def _layers_for(tiles: int, count: int) -> Layers:
    """Return room for the layers of so many tiles with so many fragments."""
    return Layers(
        np.full(tiles, -1, np.int32), np.empty((tiles, PIXELS + 1), np.int64), np.empty(count, np.float32),
        np.empty(count, np.uint16), np.empty((count, 4), np.float32), np.full((tiles, GROUPS), np.inf, np.float32),
    )


@compiled
def _make(triangles, looks, bins, patch, first, stop, room, made, layers):
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


class Surfaces:
    """All polygons of a picture on the screen, of which layers are made patch by patch."""

    def __init__(
        self, given: Sequence[Polygons], lighting: Lighting, camera: Camera, width: int, height: int, threads: int = 1
    ):
        """Project and bin; `dropped` triangles have numbers that are not finite."""
        self.triangles: Triangles
        self.bins: TriangleBins
        self.triangles, self.dropped = project_polygons(given, camera, width, height, threads)
        self.bins = bin_triangles(self.triangles, width, height, threads)
        self.looks = _looks(given, lighting, camera)

    def layers(self, patch: Patch, threads: int = 1) -> Layers:
        """Return the layers of a patch."""
        tiles = (patch.right - patch.left) * (patch.bottom - patch.top)
        bounds = ranges(tiles, threads * PIECES if threads > 1 else 1)
        made: list[list[Layers]] = [[] for _ in bounds]

        def work(piece: int, start: int, stop: int) -> None:
            made[piece] = self._range(patch, start, stop)

        parallel_ranges(work, bounds, threads)
        return _joined([part for parts in made for part in parts])

    def _range(self, patch: Patch, first: int, stop: int) -> list[Layers]:
        """Return the layers of tiles first ... stop - 1 of a patch, in parts for which there was room."""
        parts: list[Layers] = []
        room, wanted = new_room(), FIRST_CAPACITY
        fragments = _room_for(wanted)
        while first < stop:
            if wanted > len(fragments.keys):
                fragments = _room_for(wanted)
            layers = _layers_for(stop - first, max(wanted, (stop - first) * PIXELS))
            reached, rows, count, wanted = _make(
                self.triangles, self.looks, self.bins, patch, first, stop, room, fragments, layers
            )
            parts.append(_trimmed(layers, reached - first, rows, count))
            first = reached
        return parts


def _trimmed(layers: Layers, tiles: int, rows: int, count: int) -> Layers:
    numbers, firsts, keys, masks, values, limits = layers
    return Layers(numbers[:tiles], firsts[:rows], keys[:count], masks[:count], values[:count], limits[:tiles])


def _joined(parts: list[Layers]) -> Layers:
    """Return the layers of ranges that follow each other as one."""
    if len(parts) == 1:
        return parts[0]
    rows = np.cumsum([0, *(len(part.firsts) for part in parts)])
    places = np.cumsum([0, *(len(part.keys) for part in parts)])
    return Layers(
        np.concatenate([np.where(part.rows < 0, -1, part.rows + row).astype(np.int32)
                        for part, row in zip(parts, rows, strict=False)]),
        np.concatenate([part.firsts + place for part, place in zip(parts, places, strict=False)]),
        *(np.concatenate([part[column] for part in parts]) for column in range(2, 6)),
    )


def _looks(given: Sequence[Polygons], lighting: Lighting, camera: Camera) -> Looks:
    """Return what the triangles share; a texture that several use is there once."""
    maps = [texture for polygons in given for texture in (polygons.color_map, polygons.opacity_map) if texture is not None]
    textures = list({id(texture): texture for texture in maps}.values())
    texels, levels, spans = tables(textures)
    span = {id(texture): each for texture, each in zip(textures, spans, strict=True)}
    rows = [
        (*span.get(id(polygons.color_map), (0, 0)), *span.get(id(polygons.opacity_map), (0, 0)), polygons.shading != "unlit")
        for polygons in given
    ]
    return Looks(np.array(rows, np.int64).reshape(-1, 5), lighting.rows(camera.axes()), texels, levels, camera.perspective)
