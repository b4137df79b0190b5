"""Segments: what is left of streaks on the screen, as columns in memory."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

THIN, VARYING, SOLID = 4, 8, 16
"""Bits of a segment's kind, beside its falloff: radius under a pixel somewhere; colour or opacity differ; not exposed."""
X, Y, DX, DY = 0, 1, 2, 3
"""Places in a segment's row of float64: the head on the screen and the way to the tail, pixels."""
RADIUS0, RADIUS1, KEY0, KEY1, OPACITY, RED, GREEN, BLUE = range(8, 16)
"""Places in the same row seen as float32. A negative opacity says that the stream's blend is `add`."""


class Segments(NamedTuple):
    """Segments as columns: 64 bytes a row, the same memory as float64 and as float32, and what not all need.

    `particle` is the number of the segment's particle among those of all streams, where samples are wanted.
    """

    places: np.ndarray
    values: np.ndarray
    tails: np.ndarray
    pace: np.ndarray
    kind: np.ndarray
    nearest: np.ndarray
    particle: np.ndarray


def segment_bytes(varies: bool, sampled: bool) -> int:
    """Return the most memory that a segment takes while it is put in order: two rows of all columns, and three row numbers."""
    return 2 * (64 + 16 * varies + 8 * sampled + 9) + 12


def empty_segments(count: int, varies: bool, sampled: bool) -> Segments:
    """Return room for `count` segments; colours of tails only if any varies, particles only if they are sampled."""
    places = np.empty((count, 8), np.float64)
    return Segments(
        places, places.view(np.float32), np.empty((count if varies else 0, 4), np.float32),
        np.empty(count, np.float32), np.empty(count, np.uint8), np.empty(count, np.float32),
        np.empty(count if sampled else 0, np.int64),
    )
