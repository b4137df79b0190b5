"""Segments: what is left of streaks on the screen, as columns in memory."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

THIN, VARYING, SOLID, BLURRED = 4, 8, 16, 128
"""Bits of a segment's kind, beside its falloff: radius under a pixel somewhere; colour or opacity differ; not exposed; out
of focus (those are THIN as well)."""
JOINED_HEAD, JOINED_TAIL = 32, 64
"""Bits of a segment that goes on in another at its head or tail: it ends there in the plane between them."""
HEAD_X, HEAD_Y, TAIL_X, TAIL_Y = range(4)
"""Places in the row of such a segment: the normals of these planes, from its head's side to its tail's."""
X, Y, DX, DY = 0, 1, 2, 3
"""Places in a segment's row of float64: the head on the screen and the way to the tail, pixels."""
RADIUS0, RADIUS1, KEY0, KEY1, OPACITY, RED, GREEN, BLUE = range(8, 16)
"""Places in the same row seen as float32. A negative opacity says that the stream's blend is `add`; the radii are those
that are drawn, out of focus."""
SHARP0, SHARP1, CONFUSION0, CONFUSION1 = range(4)
"""Places in the row of a segment that is out of focus: its radii in focus, and how far it is out at its ends, pixels."""


LINE = 64
"""Bytes of a line of the cache, and of a row of segments."""


class Segments(NamedTuple):
    """Segments as columns: 64 bytes a row, the same memory as float64 and as float32, and what not all need.

    `particle` is the number of the segment's particle among those of all streams, where samples are wanted; `curve` is where the
    table of its falloff lies, where any is a curve.
    """

    places: np.ndarray
    values: np.ndarray
    tails: np.ndarray
    pace: np.ndarray
    kind: np.ndarray
    nearest: np.ndarray
    particle: np.ndarray
    focus: np.ndarray
    joints: np.ndarray
    curve: np.ndarray

    @property
    def extras(self) -> Extras:
        """Return what these segments have."""
        return Extras(*(len(column) > 0 for column in (self.tails, self.particle, self.focus, self.joints, self.curve)))


class Extras(NamedTuple):
    """What not all pictures need of segments: colours of tails, numbers of particles, radii in focus, joints, curves."""

    varies: bool
    sampled: bool
    blurred: bool
    joined: bool
    curved: bool


def segment_bytes(extras: Extras) -> int:
    """Return the most memory that a segment takes while it is put in order: two rows of all columns, and three row numbers."""
    more = 16 * (extras.varies + extras.blurred + extras.joined) + 8 * (extras.sampled + extras.curved)
    return 2 * (64 + 9 + more) + 12


def empty_segments(count: int, extras: Extras) -> Segments:
    """Return room for `count` segments; what not all need, only where any needs it."""
    places = lines(count).view(np.float64).reshape(count, LINE // 8)
    return Segments(
        places, places.view(np.float32), np.empty((count * extras.varies, 4), np.float32),
        np.empty(count, np.float32), np.empty(count, np.uint8), np.empty(count, np.float32),
        np.empty(count * extras.sampled, np.int64), np.empty((count * extras.blurred, 4), np.float32),
        np.empty((count * extras.joined, 4), np.float32), np.empty(count * extras.curved, np.int64),
    )


def lines(count: int) -> np.ndarray:
    """Return room for lines of the cache, as float32 and beginning at one: nothing read at once lies in two of them."""
    room = np.empty((count + 1) * LINE, np.uint8)
    first = -room.ctypes.data % LINE
    return room[first : first + count * LINE].view(np.float32)
