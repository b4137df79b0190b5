"""Surfaces: all polygons of a picture, projected and binned, of which layers are made patch by patch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphfx.render.camera import Camera
from graphfx.render.coverage import PIXELS
from graphfx.render.layer import GROUPS, TILE_HEIGHT
from graphfx.render.layers import Fragments, Layers, make_layers, most_fragments
from graphfx.render.patches import Patch
from graphfx.render.polygons import Lighting, Polygons
from graphfx.render.resolve import new_room
from graphfx.render.shading import Looks
from graphfx.render.textures import tables
from graphfx.render.triangle_bins import TriangleBins, bin_triangles
from graphfx.render.triangles import Triangles, project_polygons
from graphfx.store.threads import parallel_ranges, ranges

PIECES = 8
"""Pieces of a patch for each thread."""
FIRST_CAPACITY = 4096
FRAGMENT_BYTES = 2 * (4 + 2 + 16)
"""Memory of a fragment: there are two of each while those of several threads are joined."""
ROW_BYTES = 2 * 8 * (PIXELS + 1)
"""Memory of a tile with fragments beside these."""


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
        self.given = list(given)
        """Whose textures the looks name by address."""

    def layer_bytes(self, threads: int = 1) -> np.ndarray:
        """Return the bytes (rows, columns) that the layers of each tile take while they are made, at most."""
        rows = -(-self.bins.height // TILE_HEIGHT)
        most = np.zeros(rows * self.bins.across, np.int64)
        bounds = ranges(len(most), threads)
        parallel_ranges(lambda _, start, stop: most_fragments(self.triangles, self.bins, start, stop, most), bounds, threads)
        return (np.where(most > 0, ROW_BYTES, 0) + FRAGMENT_BYTES * most).reshape(rows, self.bins.across)

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
            reached, rows, count, wanted = make_layers(
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
    levels, spans = tables(textures)
    span = {id(texture): each for texture, each in zip(textures, spans, strict=True)}
    rows = [
        (*span.get(id(polygons.color_map), (0, 0)), *span.get(id(polygons.opacity_map), (0, 0)), polygons.shading != "unlit")
        for polygons in given
    ]
    return Looks(np.array(rows, np.int64).reshape(-1, 5), lighting.rows(camera.axes()), levels, camera.perspective)
