"""The textbook renderer in C, and the approximation of one depth a particle: what the renderer is measured against."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path

import numpy as np
from c_library import COMMON, HERE

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.bins import bin_segments
from graphfx.render.camera import Camera
from graphfx.render.layer import GROUP_HEIGHT, GROUPS, alpha_of, colored, fragments, groups_touched, localize
from graphfx.render.order import ordered
from graphfx.render.patches import whole_picture
from graphfx.render.pending import LIGHT, add_layer, clear_light
from graphfx.render.scene import make_scene
from graphfx.render.streaks import Streaks
from graphfx.render.tiles import lanes_inside, new_scratch, tile_corner, write_pixels
from graphfx.store.primitives import offsets
from graphfx.store.threads import parallel_ranges, ranges

SIZE = 16
PIECES = 16


class Textbook:
    """Tiles, a buffer, insertion sort per pixel: streaks.c at gcc -O3 -march=native."""

    def __init__(self, folder: Path, width: int, height: int, threads: int):
        file = folder / "streaks.so"
        subprocess.run(["gcc", *COMMON, "-mprefer-vector-width=512", str(HERE / "streaks.c"), "-o", str(file), "-lm"], check=True)
        self.library = ctypes.CDLL(str(file))
        self.library.tiles.restype = ctypes.c_long
        self.width, self.height, self.threads = width, height, threads
        self.across, self.down = -(-width // SIZE), -(-height // SIZE)

    def render(self, streaks: Streaks) -> tuple[np.ndarray, int]:
        """Return the film of streaks that are given in pixels, and the number of fragments."""
        given = [*streaks.head, *streaks.tail, streaks.head_radius, streaks.head_opacity, *streaks.head_color]
        columns = [np.ascontiguousarray(column, np.float32) for column in given]
        table = (ctypes.c_void_p * len(columns))(*(column.ctypes.data for column in columns))
        count, tiles = streaks.count, self.across * self.down
        rows = np.empty(count, np.uint32)
        self.library.order(table, ctypes.c_long(count), _at(rows))
        bounds = ranges(count, self.threads)
        counts = np.zeros((len(bounds), tiles), np.int64)

        def bin_streaks(start: int, stop: int, places: np.ndarray, members: np.ndarray | None) -> None:
            self.library.bin(table, _at(rows), ctypes.c_long(start), ctypes.c_long(stop), self.across, self.down, _at(places),
                             None if members is None else _at(members))

        parallel_ranges(lambda piece, start, stop: bin_streaks(start, stop, counts[piece], None), bounds, self.threads)
        starts = offsets(counts.sum(axis=0))
        places = starts[:-1] + np.cumsum(counts, axis=0) - counts
        members = np.empty(starts[-1], np.uint32)
        parallel_ranges(lambda piece, start, stop: bin_streaks(start, stop, places[piece], members), bounds, self.threads)
        film = np.zeros((self.height, self.width, 4), np.float32)
        bounds = ranges(tiles, self.threads * PIECES)
        fragments = [0] * len(bounds)

        def draw(piece: int, start: int, stop: int) -> None:
            fragments[piece] = self.library.tiles(table, _at(starts), _at(members), ctypes.c_long(start), ctypes.c_long(stop),
                                                  self.across, self.width, self.height, _at(film))

        parallel_ranges(draw, bounds, self.threads)
        return film, sum(fragments)


def _at(array: np.ndarray) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


@inner
def _draw(segments, q, local, group, square, scratch):
    key, shape, t, hit = fragments(local, group, square)
    opacity, red, green, blue = colored(segments, q, local, key, t, square)
    add_layer(scratch.light, group * LIGHT, where(hit, alpha_of(opacity, shape), 0.0), red, green, blue, None)


@compiled
def _tiles_by_one_depth(segments, tiles, start, stop, scratch, pixels):
    """Composite the segments of each tile as they come: each particle wholly before the next."""
    for k in range(start, stop):
        left, top = tile_corner(tiles, k)
        for group in range(GROUPS):
            scratch.inside[group] = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
            clear_light(scratch.light, group * LIGHT)
        for place in range(tiles.starts[k], tiles.starts[k + 1]):
            q = tiles.members[place]
            local = localize(segments, q, left + 0.5, top + 0.5)
            first, last = groups_touched(local)
            for group in range(first, last + 1):
                _draw(segments, q, local, group, tiles.perspective, scratch)
        for group in range(GROUPS):
            write_pixels(scratch.light, group * LIGHT, pixels, left, top + GROUP_HEIGHT * group, scratch.inside[group], None)


def by_one_depth(streaks: Streaks, camera: Camera, width: int, height: int, threads: int) -> np.ndarray:
    """Return the film in which each particle has one depth, its nearest: an approximation, made by the renderer's own parts."""
    scene, whole = make_scene([streaks], camera, camera, width, height, threads, False), whole_picture(width, height)
    segments, rows, _ = scene.segments(whole)
    segments = ordered(segments, rows, threads)
    tiles = bin_segments(segments, whole, width, height, camera.perspective, threads)
    assert tiles is not None
    pixels = np.zeros((height, width, 4), np.float32)
    bounds = ranges(len(tiles.starts) - 1, threads * PIECES)
    parallel_ranges(
        lambda _, start, stop: _tiles_by_one_depth(segments, tiles, start, stop, new_scratch(), pixels), bounds, threads
    )
    return pixels
