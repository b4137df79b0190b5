"""Composite a patch: its tiles, then the groups whose lists overflowed, on all threads."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from graphfx.render.cover import Cover, new_cover
from graphfx.render.deep import BEGIN, FIRST_CAPACITY, Buffer, enlarged, new_buffer, render_deep
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
    deep = np.flatnonzero(overflowed.reshape(count, GROUPS).any(axis=1))
    bounds = ranges(len(deep), threads * PIECES)
    deep_fragments = [0] * len(bounds)

    def work_deep(piece: int, start: int, stop: int) -> None:
        buffer, cover = new_buffer(FIRST_CAPACITY), new_cover(layers)
        numbers = deep[start:stop]
        deep_fragments[piece], _ = composite_deep(segments, tiles, numbers, BEGIN, True, overflowed, buffer, pixels, cover)

    if len(deep):
        parallel_ranges(work_deep, bounds, threads)
    return sum(fragments) + sum(deep_fragments)


def composite_deep(
    segments: Segments, tiles: Tiles, numbers: np.ndarray, place: int, finish: bool, overflowed: np.ndarray, buffer: Buffer,
    pixels: np.ndarray, cover: Cover | None,
) -> tuple[int, Buffer]:
    """Composite the groups of some tiles that overflowed; return the number of fragments, and the buffer that goes on."""
    at = total = 0
    while True:
        at, place, made = render_deep(segments, tiles, numbers, at, place, finish, overflowed, buffer, pixels, cover)
        total += made
        if at == len(numbers):
            return total, buffer
        buffer = enlarged(buffer)


class Slabs:
    """One tile whose segments come slab after slab, the nearest first: what is pending waits for the next slab."""

    def __init__(self, layers: Layers | None) -> None:
        self.scratch, self.cover = new_scratch(), new_cover(layers)
        self.deep_cover = new_cover(layers)
        self.overflowed = np.zeros(GROUPS, np.bool_)
        self.begun = False
        self.buffer: Buffer | None = None

    def add(self, segments: Segments, tiles: Tiles, finish: bool, pixels: np.ndarray) -> int:
        """Go on with a slab; return the number of fragments that are done, all but those of groups that overflowed."""
        begin, self.begun = not self.begun, True
        return int(render_tiles(
            segments, tiles, 0, 1, begin, finish, self.scratch, self.overflowed, pixels, self.cover
        ))

    def add_deep(self, segments: Segments, tiles: Tiles, finish: bool, pixels: np.ndarray) -> int:
        """Go on with a slab in the groups that overflowed, when all slabs have been added once; return their fragments."""
        place, buffer = (BEGIN, new_buffer(FIRST_CAPACITY)) if self.buffer is None else (0, self.buffer)
        total, self.buffer = composite_deep(
            segments, tiles, np.zeros(1, np.int64), place, finish, self.overflowed, buffer, pixels, self.deep_cover
        )
        return total


def composite_slabs(slabs: Iterable[tuple[Segments, Tiles, bool]], state: Slabs, deep: bool, pixels: np.ndarray) -> int:
    """Composite slabs, each with whether it is the last; return the number of fragments."""
    add = state.add_deep if deep else state.add
    return sum(add(segments, tiles, last, pixels) for segments, tiles, last in slabs)
