"""Quick pictures: each particle a line from head to tail in its head's colour, one pixel wide, not sorted.

The line is longer than head to tail by half a pixel at each end, so that a still particle is a dot of one pixel; but not
where it goes on in another, as after a bounce. In each column of pixels that it crosses (in each row, where it is steep) the
light that belongs there is shared out among the three nearest pixels,

    share(v) = max(0, 1 - |v| cos(slope)),  scaled so that the column's shares sum to 1 / cos(slope)

with v the distance of a pixel's centre along the column, so that whatever its direction and its place

    sum of the pixels' alpha = opacity (length + 1)                            [Gupta and Sproull 1981, a cone of light]

A pixel that n lines cover with alphas a and colours c gets the coverage of them all and their mean colour,

    alpha = 1 - (1 - a_1) ... (1 - a_n),   colour = (a_1 c_1 + ... + a_n c_n) / (a_1 + ... + a_n)

[Bavoil and Myers 2008], which needs no order and is exact for one; lines that add shine on top of that. A pixel takes
its lines in the order of particles, so any number of threads gives the same bytes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.bits import float_at
from graphfx.lanes.inner import inner
from graphfx.render.camera import Camera
from graphfx.render.film import Film
from graphfx.render.streaks import Streaks, addresses
from graphfx.render.strokes import Lines, draw_band
from graphfx.store.threads import parallel_ranges, ranges

PROJECTED = 4096
"""Fewest particles to project worth a thread of their own."""
BANDS = 4
"""Bands of rows for each thread: enough that none waits long for the last."""
BAND_PIXELS = 1 << 19
"""About the most pixels of a band, of 32 bytes each while it is drawn."""
PLACES = tuple(range(6))
"""The columns of streaks that say where they are: head and tail."""
LOOKS = (8, 9, 10, 14)
"""Those that say how they look: the head's colour and opacity."""
JOINED, HEAD_MOMENT, TAIL_MOMENT = 18, 19, 20
"""Whether a line goes on in another, and when its ends are seen."""
BRIGHTEST = np.float32(1e30)
"""Colours are kept within this, so that sums of them stay finite."""
OUTSIDE = 2.0
"""Pixels around the picture to which lines are cut: more than a line's width."""


class Screen(NamedTuple):
    """The two cameras, the planes between which they see, and the picture."""

    head: np.ndarray
    tail: np.ndarray
    near: float
    far: float
    perspective: bool
    width: int
    height: int


def draw_lines(
    streams: Sequence[Streaks], head_camera: Camera, tail_camera: Camera | None, width: int, height: int, threads: int = 1
) -> Film:
    """Return the film of all streams, drawn as lines; the cameras are those at the end and at the opening of the shutter."""
    tail_camera = tail_camera or head_camera
    if tail_camera.projection != head_camera.projection:
        raise ValueError("a camera's projection cannot change while the shutter is open")
    view = Screen(head_camera.screen_matrix(width, height), tail_camera.screen_matrix(width, height), *head_camera.planes,
                  head_camera.perspective, width, height)
    count = sum(stream.count for stream in streams)
    lines = Lines(np.empty((count, 4), np.float32), np.empty((count, 4), np.float32), np.empty((count, 2), np.int32))
    spans: list[tuple[int, int]] = []
    offset = dropped = 0
    for stream in streams:
        found, lost = _project(stream, view, lines, offset, threads)
        spans += found
        dropped += lost
        offset += stream.count
    pixels = np.empty((height, width, 4), np.float32)
    bounds = ranges(height, max(threads * BANDS if threads > 1 else 1, width * height // BAND_PIXELS))
    fragments = [0] * len(bounds)
    listed = np.array(spans, np.int64).reshape(-1, 2)

    def work(piece: int, top: int, bottom: int) -> None:
        fragments[piece] = draw_band(lines, listed, top, bottom, pixels)

    parallel_ranges(work, bounds, threads)
    return Film(pixels, sum(fragments), dropped)


def _project(stream: Streaks, view: Screen, lines: Lines, offset: int, threads: int) -> tuple[list[tuple[int, int]], int]:
    """Write a stream's lines from row `offset` on; return the spans of rows written, and how many particles were dropped."""
    bounds = ranges(stream.count, threads, PROJECTED)
    results = [(0, 0)] * len(bounds)
    adds = stream.blend == "add"

    def work(piece: int, start: int, stop: int) -> None:
        columns = stream.columns(start, stop)
        results[piece] = project_lines(addresses(columns), view, adds, stop - start, lines, offset + start)

    parallel_ranges(work, bounds, threads)
    spans = [(offset + start, offset + start + kept) for (start, _), (kept, _) in zip(bounds, results, strict=True)]
    return spans, sum(lost for _, lost in results)


@inner
def _read(columns, c, i):
    """Return particle i's value of column c: row 0 of `columns` holds the addresses, row 1 the masks of the index."""
    return np.float64(float_at(columns[0, c], i & columns[1, c]))


@inner
def _transformed(view, row, columns, first, moment, i):
    """Return one coordinate of the point in columns first ... first + 2, on the screen times its depth, seen at a moment."""
    x, y, z = _read(columns, first, i), _read(columns, first + 1, i), _read(columns, first + 2, i)
    late = early = 0.0
    if moment != 1.0:
        late = view.head[row, 0] * x + view.head[row, 1] * y + view.head[row, 2] * z + view.head[row, 3]
    if moment != 0.0:
        early = view.tail[row, 0] * x + view.tail[row, 1] * y + view.tail[row, 2] * z + view.tail[row, 3]
    return (1.0 - moment) * late + moment * early


@inner
def _within(start, stop, from_, way, low, high):
    """Return the part of start ... stop in which from_ + s way lies between low and high; it is empty where stop < start."""
    if low <= min(from_, from_ + way) and max(from_, from_ + way) <= high:
        return start, stop
    if way == 0.0:
        return 1.0, 0.0
    one, other = (low - from_) / way, (high - from_) / way
    return max(start, min(one, other)), min(stop, max(one, other))


@inner
def _ends(columns, i, view):
    """Return (seen, x, y, x, y): the ends of a particle's line in the picture, half a pixel beyond head and tail."""
    late, early = _read(columns, HEAD_MOMENT, i), _read(columns, TAIL_MOMENT, i)
    depth0, depth1 = _transformed(view, 2, columns, 0, late, i), _transformed(view, 2, columns, 3, early, i)
    first, last = _within(0.0, 1.0, depth0, depth1 - depth0, view.near, view.far)
    if last < first:
        return False, 0.0, 0.0, 0.0, 0.0
    x, way_x = _transformed(view, 0, columns, 0, late, i), _transformed(view, 0, columns, 3, early, i)
    y, way_y = _transformed(view, 1, columns, 0, late, i), _transformed(view, 1, columns, 3, early, i)
    way_x, way_y = way_x - x, way_y - y
    x0, y0, x1, y1 = x + first * way_x, y + first * way_y, x + last * way_x, y + last * way_y
    if view.perspective:
        near = 1.0 / min(max(depth0 + first * (depth1 - depth0), view.near), view.far)
        far = 1.0 / min(max(depth0 + last * (depth1 - depth0), view.near), view.far)
        x0, y0, x1, y1 = x0 * near, y0 * near, x1 * far, y1 * far
    dx, dy = x1 - x0, y1 - y0
    length = math.sqrt(dx * dx + dy * dy)
    along_x = dx / length if length > 1e-6 else 1.0
    along_y = dy / length if length > 1e-6 else 0.0
    joined = np.int64(_read(columns, JOINED, i))
    before, after = 0.0 if joined & 1 and first == 0.0 else 0.5, 0.0 if joined & 2 and last == 1.0 else 0.5
    x0, y0 = x0 - before * along_x, y0 - before * along_y
    dx, dy = dx + (before + after) * along_x, dy + (before + after) * along_y
    start, stop = _within(0.0, 1.0, x0, dx, -OUTSIDE, view.width + OUTSIDE)
    start, stop = _within(start, stop, y0, dy, -OUTSIDE, view.height + OUTSIDE)
    return stop > start, x0 + start * dx, y0 + start * dy, x0 + stop * dx, y0 + stop * dy


@inner
def _finite(columns, i):
    total = 0.0
    for c in PLACES:
        value = _read(columns, c, i)
        total += value - value
    for c in LOOKS:
        value = _read(columns, c, i)
        total += value - value
    return total == 0.0


@compiled
def project_lines(columns, view, adds, count, lines, first):
    """Write the lines of particles from row `first` on; return how many, and how many were dropped."""
    at, dropped = first, 0
    for i in range(count):
        if not _finite(columns, i):
            dropped += 1
            continue
        alpha = min(_read(columns, 14, i), 1.0)
        seen, x0, y0, x1, y1 = _ends(columns, i, view)
        if not seen or not alpha > 0.0:
            continue
        ends, looks = lines.ends, lines.looks
        ends[at, 0], ends[at, 1], ends[at, 2], ends[at, 3] = x0, y0, x1, y1
        for c in range(3):
            looks[at, c] = min(max(np.float32(_read(columns, 8 + c, i)), -BRIGHTEST), BRIGHTEST)
        looks[at, 3] = -alpha if adds else alpha
        lines.rows[at, 0] = math.floor(min(y0, y1)) - 2
        lines.rows[at, 1] = math.floor(max(y0, y1)) + 3
        at += 1
    return at - first, dropped
