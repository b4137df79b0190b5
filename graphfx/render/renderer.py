"""Render particles: project, order by nearest depth, bin into tiles, composite every pixel in exact order.

[Sims 1990, section 4; the order of fragments is per pixel, over all streams]
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.bits import prefetch
from graphfx.render.bins import bin_segments
from graphfx.render.camera import Camera
from graphfx.render.deep import render_deep
from graphfx.render.falloff import FALLOFFS
from graphfx.render.film import Film
from graphfx.render.layer import GROUPS
from graphfx.render.pending import LANES, LIGHT, PLANES
from graphfx.render.projection import Look, View, project
from graphfx.render.samples import Samples, sample_bands
from graphfx.render.segments import Segments, empty_segments
from graphfx.render.streaks import Streaks, addresses
from graphfx.render.tiles import AHEAD, Tiles, new_scratch, render_tiles
from graphfx.store.primitives import GRAIN
from graphfx.store.sorting import stable_argsort
from graphfx.store.threads import parallel, parallel_ranges, ranges

PIECES = 16
"""Pieces of the picture for each thread: enough that none waits long for the last."""

PROJECTED = 4096
"""Fewest particles to project worth a thread of their own."""

Listener = Callable[[str], Any]
Sampler = Callable[[Samples], Any]


def render(
    streams: Sequence[Streaks], head_camera: Camera, tail_camera: Camera | None, width: int, height: int,
    threads: int = 1, listener: Listener = lambda step: None, sampler: Sampler | None = None,
) -> Film:
    """Return the film of all streams together.

    The cameras are those at the end and at the opening of the shutter (None: the same); near and far
    planes are the head's. Any number of threads gives the same bytes. `listener` is called with the
    name of each step as it begins, `sampler` with the samples of each band of rows, from the top.
    """
    tail_camera = tail_camera or head_camera
    if tail_camera.projection != head_camera.projection:
        raise ValueError("a camera's projection cannot change while the shutter is open")
    if width < 1 or height < 1:
        raise ValueError(f"a picture of {width} x {height} pixels has no pixels")
    listener("project")
    segments, rows, dropped = _project(streams, head_camera, tail_camera, width, height, threads, sampler is not None)
    listener("order")
    segments = _ordered(segments, rows, threads)
    listener("bin")
    tiles = bin_segments(segments, width, height, head_camera.perspective, threads)
    listener("tiles")
    pixels, fragments = _composite(segments, tiles, threads)
    if sampler is not None:
        listener("samples")
        for samples in sample_bands(segments, tiles, threads):
            sampler(samples)
    return Film(pixels, fragments, dropped)


def _project(
    streams: Sequence[Streaks], head: Camera, tail: Camera, width: int, height: int, threads: int, sampled: bool
) -> tuple[Segments, np.ndarray, int]:
    """Return room for all segments, the rows of those in the picture, and how many particles were dropped."""
    view = View(
        head.screen_matrix(width, height), tail.screen_matrix(width, height), head.scale(width), tail.scale(width),
        *head.planes, head.perspective, width, height,
    )
    segments = empty_segments(sum(stream.count for stream in streams), any(stream.varies for stream in streams), sampled)
    rows: list[np.ndarray] = [np.empty(0, np.int64)]
    offset = dropped = 0
    for stream in streams:
        kept, lost = _project_stream(stream, view, segments, offset, threads)
        rows += kept
        dropped += lost
        offset += stream.count
    return segments, np.concatenate(rows), dropped


def _project_stream(
    stream: Streaks, view: View, segments: Segments, offset: int, threads: int
) -> tuple[list[np.ndarray], int]:
    """Write a stream's segments from row `offset` on; return the rows written, in order, and the number dropped."""
    columns = stream.columns()
    table = addresses(columns)
    sign = -1.0 if stream.blend == "add" else 1.0
    look = Look(*FALLOFFS[stream.falloff], sign, stream.streak == "exposed", stream.varies)
    bounds = ranges(stream.count, threads, PROJECTED)
    results = [(0, 0)] * len(bounds)

    def work(piece: int, start: int, stop: int) -> None:
        results[piece] = project(table, view, look, start, stop, segments, offset)

    parallel_ranges(work, bounds, threads)
    firsts = [offset + start for start, _ in bounds]
    rows = [np.arange(first, first + kept) for first, (kept, _) in zip(firsts, results, strict=True)]
    return rows, sum(lost for _, lost in results)


@compiled
def _pack(source: Any, order: Any, start: int, stop: int, target: Any) -> None:
    """Copy the segments order[start : stop] to rows start ... stop."""
    for i in range(start, stop):
        row, ahead = order[i], order[min(i + AHEAD, stop - 1)]
        prefetch(source.values, ahead * 16)
        prefetch(source.pace, ahead)
        prefetch(source.kind, ahead)
        for c in range(8):
            target.places[i, c] = source.places[row, c]
        target.pace[i] = source.pace[row]
        target.kind[i] = source.kind[row]
        if len(source.particle):
            target.particle[i] = source.particle[row]
        if len(source.tails):
            for c in range(4):
                target.tails[i, c] = source.tails[row, c]


def _ordered(segments: Segments, rows: np.ndarray, threads: int) -> Segments:
    """Return the segments of `rows`, nearest first; equals stay in the order of stream and particle."""
    order = rows[stable_argsort(segments.nearest[rows], threads)]
    packed = empty_segments(len(rows), len(segments.tails) > 0, len(segments.particle) > 0)
    bounds = ranges(len(rows), threads, GRAIN)
    parallel_ranges(lambda _, start, stop: _pack(segments, order, start, stop, packed), bounds, threads)
    return packed


def _composite(segments: Segments, tiles: Tiles, threads: int) -> tuple[np.ndarray, int]:
    """Return the picture and the number of fragments."""
    pixels = np.zeros((tiles.height, tiles.width, 4), np.float32)
    count = len(tiles.starts) - 1
    overflowed = np.zeros(count * GROUPS, np.bool_)
    bounds = ranges(count, threads * PIECES if threads > 1 else 1)
    fragments = [0] * len(bounds)

    def work(piece: int, start: int, stop: int) -> None:
        fragments[piece] = render_tiles(segments, tiles, start, stop, new_scratch(), overflowed, pixels)

    parallel_ranges(work, bounds, threads)
    deep = np.flatnonzero(overflowed)
    deep_fragments = [0] * len(deep)

    def work_deep(piece: int) -> None:
        planes, light, filled = np.zeros(PLANES * LANES, np.float32), np.zeros(LIGHT, np.float32), np.zeros(LANES, np.int64)
        deep_fragments[piece] = render_deep(segments, tiles, deep[piece], planes, light, filled, pixels)

    parallel(work_deep, len(deep), threads)
    return pixels, sum(fragments) + sum(deep_fragments)
