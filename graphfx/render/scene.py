"""The scene: all streams of a picture and its cameras, gone through piece by piece."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphfx.render.camera import Camera
from graphfx.render.joints import new_path
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH
from graphfx.render.patches import Counts, Patch, whole_picture
from graphfx.render.projection import project
from graphfx.render.segments import Extras, Segments, empty_segments, segment_bytes
from graphfx.render.streaks import Streaks, addresses
from graphfx.render.survey import count_keys, survey
from graphfx.render.view import Look, Slab, View, Window, look_of, view_of
from graphfx.store.primitives import offsets
from graphfx.store.threads import parallel, parallel_ranges, ranges

PIECE = 1 << 17
"""Particles that are looked at together: their columns are copied where they are not float32."""
GRAIN = 4096
"""Fewest particles worth a thread of their own."""
EVERYWHERE = Slab(False, 0, 0, 0, 0)


class Piece(NamedTuple):
    """Particles start ... stop - 1 of a stream; the first of them is number `first` of all streams.

    No path is in two pieces; if any is of several streaks, `longest` is the most of them."""

    stream: Streaks
    look: Look
    first: int
    start: int
    stop: int
    longest: int

    @property
    def length(self) -> int:
        """Return the number of particles."""
        return self.stop - self.start

    @property
    def end(self) -> int:
        """Return the number, of all streams, of the particle that follows."""
        return self.first + self.length

    def columns(self) -> list[np.ndarray]:
        """Return the columns of these particles, which must be kept while a kernel reads at their addresses."""
        return self.stream.columns(self.start, self.stop)


@dataclass
class Scene:
    """What is to be seen, and by whom.

    `reaches` holds the first and the last row of tiles that each particle reaches, once they were looked for.
    """

    view: View
    width: int
    height: int
    pieces: list[Piece]
    extras: Extras
    threads: int
    reaches: tuple[np.ndarray, np.ndarray] | None = None

    @property
    def count(self) -> int:
        """Return the number of particles."""
        return self.pieces[-1].end if self.pieces else 0

    @property
    def segment_bytes(self) -> int:
        """Return the memory that one segment takes while it is put in order."""
        return segment_bytes(self.extras)

    @property
    def surveyed_bytes(self) -> int:
        """Return the memory of what is known of all particles once they were looked for."""
        return sum(rows.nbytes for rows in self.reaches or ())

    def window(self, patch: Patch, slab: Slab = EVERYWHERE) -> Window:
        """Return the part of the picture that is a patch."""
        nothing = np.empty(0, np.uint16)
        right, bottom = min(patch.right * TILE_WIDTH, self.width), min(patch.bottom * TILE_HEIGHT, self.height)
        tops, bottoms = self.reaches or (nothing, nothing)
        left, top = patch.left * TILE_WIDTH, patch.top * TILE_HEIGHT
        return Window(left, top, right, bottom, patch.top, patch.bottom - 1, tops, bottoms, slab)

    def segments(self, patch: Patch) -> tuple[Segments, np.ndarray, int]:
        """Return the segments that may touch a patch: room for them, the rows that they are in, and particles dropped."""
        window = self.window(patch)
        rooms = np.array([self._room(piece, patch) for piece in self.pieces], np.int64)
        starts = offsets(rooms)
        segments = empty_segments(int(starts[-1]), self.extras)
        kept, dropped = [0] * len(self.pieces), [0] * len(self.pieces)

        def work(number: int) -> None:
            if rooms[number]:
                kept[number], dropped[number] = self._project(self.pieces[number], window, segments, int(starts[number]))

        parallel(work, len(self.pieces), self.threads)
        rows = [np.arange(start, start + count, dtype=np.uint32) for start, count in zip(starts, kept, strict=False)]
        return segments, np.concatenate([np.empty(0, np.uint32), *rows]), sum(dropped)

    def slab_segments(self, patch: Patch, slab: Slab, most: int) -> tuple[Segments, np.ndarray]:
        """Return the segments of a slab of a patch, at most so many."""
        segments, window, at = empty_segments(most + 1, self.extras), self.window(patch, slab), 0
        for piece in self.pieces:
            if slab.start < piece.end and piece.first < slab.stop:
                at += self._project(piece, window, segments, at)[0]
        return segments, np.arange(at, dtype=np.uint32)

    def _room(self, piece: Piece, patch: Patch) -> int:
        """Return how many particles of a piece may reach a patch."""
        if self.reaches is None:
            return piece.length
        tops, bottoms = (rows[piece.first : piece.end] for rows in self.reaches)
        return int(np.count_nonzero((tops < patch.bottom) & (bottoms >= patch.top)))

    def _project(self, piece: Piece, window: Window, segments: Segments, at: int) -> tuple[int, int]:
        columns = piece.columns()
        kept, dropped = project(
            addresses(columns), self.view, piece.look, window, piece.first, piece.length, segments, at, new_path(piece.longest)
        )
        return kept, dropped

    def survey(self, beside: np.ndarray | None = None) -> tuple[Counts, int]:
        """Find the rows that each particle reaches, and count what reaches where; return that, and particles dropped.

        `beside` are the bytes that each tile needs beside segments.
        """
        whole = whole_picture(self.width, self.height)
        kind = np.uint8 if whole.bottom < 255 else np.uint16
        reaches = np.full(self.count, whole.bottom, kind), np.zeros(self.count, kind)
        bounds = ranges(len(self.pieces), self.threads)
        corners = np.zeros((len(bounds), 4, whole.bottom + 1, whole.right + 1), np.int64)
        dropped, window = [0] * len(bounds), self.window(whole)

        def work(number: int, first: int, last: int) -> None:
            for piece in self.pieces[first:last]:
                columns = piece.columns()
                dropped[number] += survey(
                    addresses(columns), self.view, piece.look, window, piece.first, piece.length, *reaches, corners[number]
                )

        parallel_ranges(work, bounds, self.threads)
        self.reaches = reaches
        return Counts(corners.sum(axis=0), self.segment_bytes, beside), sum(dropped)

    def key_counts(self, patch: Patch, low: int, high: int, shift: int) -> np.ndarray:
        """Count the particles that may touch a patch by (key - low) >> shift, keys as ordered bits from low to high."""
        counts, window = np.zeros(((high - low) >> shift) + 1, np.int64), self.window(patch)
        for piece in self.pieces:
            columns = piece.columns()
            count_keys(addresses(columns), self.view, piece.look, window, piece.first, piece.length, low, high, shift, counts)
        return counts


def _pieces_of(stream: Streaks, first: int, threads: int) -> list[Piece]:
    """Return the pieces of a stream of which the first particle is number `first`."""
    look, longest = look_of(stream), 0
    bounds = ranges(stream.count, max(threads, -(-stream.count // PIECE)), GRAIN)
    if stream.is_joined and stream.count:
        starts = stream.path_starts()
        longest = int(np.diff(starts).max())
        bounds = [tuple(starts[np.searchsorted(starts, each)].tolist()) for each in bounds]
    return [Piece(stream, look, first + start, start, stop, longest) for start, stop in bounds if stop > start]


def make_scene(
    streams: Sequence[Streaks], head: Camera, tail: Camera, width: int, height: int, threads: int, sampled: bool
) -> Scene:
    """Return the scene of some streams."""
    pieces: list[Piece] = []
    first = 0
    for stream in streams:
        pieces += _pieces_of(stream, first, threads)
        first += stream.count
    view = view_of(head, tail, width, height)
    varies, curved = any(stream.varies for stream in streams), any(stream.curve is not None for stream in streams)
    joined = any(stream.is_joined for stream in streams)
    return Scene(view, width, height, pieces, Extras(varies, sampled, view.blurred, joined, curved), threads)
