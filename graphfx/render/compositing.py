"""Composite a patch: its tiles, then the groups whose lists overflowed, on all threads."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from graphfx.render.cover import Cover, begin_group, new_cover
from graphfx.render.deep import FIRST_CAPACITY, Buffer, clear_buffer, new_buffer, render_deep
from graphfx.render.layer import GROUPS
from graphfx.render.layers import Layers
from graphfx.render.segments import Segments
from graphfx.render.tiles import Tiles, new_scratch, render_tiles
from graphfx.store.threads import parallel_ranges, ranges

PIECES = 16
"""Pieces of a patch for each thread: enough that none waits long for the last."""


def composite(segments: Segments, tiles: Tiles, layers: Layers | None, threads: int, pixels: np.ndarray) -> int:
    """Write the pixels of a patch; return the number of fragments."""
    count = len(tiles.starts) - 1
    overflowed = np.zeros(count * GROUPS, np.bool_)
    bounds = ranges(count, threads * PIECES if threads > 1 else 1)
    fragments = [0] * len(bounds)

    def work(piece: int, start: int, stop: int) -> None:
        cover = new_cover(layers)
        fragments[piece] = render_tiles(segments, tiles, start, stop, True, True, new_scratch(), overflowed, pixels, cover)

    parallel_ranges(work, bounds, threads)
    deep = np.flatnonzero(overflowed)
    bounds = ranges(len(deep), threads * PIECES)
    deep_fragments = [0] * len(bounds)

    def work_deep(piece: int, start: int, stop: int) -> None:
        buffer = new_buffer(FIRST_CAPACITY)
        for number in deep[start:stop]:
            clear_buffer(buffer)
            made, buffer = render_deep(segments, tiles, number, True, buffer, pixels, _begun_cover(layers, number))
            deep_fragments[piece] += made

    parallel_ranges(work_deep, bounds, threads)
    return sum(fragments) + sum(deep_fragments)


def _begun_cover(layers: Layers | None, number: int) -> Cover | None:
    """Return a cover for one group, `number` = tile * GROUPS + group."""
    cover = new_cover(layers)
    if cover is not None:
        begin_group(cover, number // GROUPS, number % GROUPS)
    return cover


class Slabs:
    """One tile whose segments come slab after slab, the nearest first: what is pending waits for the next slab."""

    def __init__(self, layers: Layers | None) -> None:
        self.scratch, self.cover = new_scratch(), new_cover(layers)
        self.layers = layers
        self.overflowed = np.zeros(GROUPS, np.bool_)
        self.begun = False
        self.buffers: dict[int, tuple[Buffer, Cover | None]] = {}

    def add(self, segments: Segments, tiles: Tiles, finish: bool, pixels: np.ndarray) -> int:
        """Go on with a slab; return the number of fragments that are done, all but those of groups that overflowed."""
        begin, self.begun = not self.begun, True
        return int(render_tiles(
            segments, tiles, 0, 1, begin, finish, self.scratch, self.overflowed, pixels, self.cover
        ))

    def add_deep(self, segments: Segments, tiles: Tiles, finish: bool, pixels: np.ndarray) -> int:
        """Go on with a slab in the groups that overflowed, when all slabs have been added once; return their fragments."""
        total = 0
        for group in np.flatnonzero(self.overflowed):
            buffer, cover = self.buffers.get(int(group)) or (new_buffer(FIRST_CAPACITY), _begun_cover(self.layers, int(group)))
            made, buffer = render_deep(segments, tiles, group, finish, buffer, pixels, cover)
            self.buffers[int(group)] = buffer, cover
            total += made
        return total


def composite_slabs(slabs: Iterable[tuple[Segments, Tiles, bool]], state: Slabs, deep: bool, pixels: np.ndarray) -> int:
    """Composite slabs, each with whether it is the last; return the number of fragments."""
    add = state.add_deep if deep else state.add
    return sum(add(segments, tiles, last, pixels) for segments, tiles, last in slabs)
