"""Points of streaks as two cameras see them, and as one would that is on its way between them."""

from __future__ import annotations

import numpy as np

from graphfx.lanes.bits import float_at
from graphfx.lanes.inner import inner


@inner
def value_of(columns, c, i):
    """Return particle i's value of column c: row 0 of `columns` holds the addresses, row 1 the masks of the index."""
    return np.float64(float_at(columns[0, c], i & columns[1, c]))


@inner
def _transformed(columns, i, place, size, seen):
    """Return (x w, y w, w, radius w, c w) of particle i's point in columns `place` ... + 2, its radius in column `size`."""
    matrix = seen.matrix
    x, y, z = value_of(columns, place, i), value_of(columns, place + 1, i), value_of(columns, place + 2, i)
    depth = matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z + matrix[2, 3]
    return (
        matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z + matrix[0, 3],
        matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z + matrix[1, 3],
        depth,
        max(value_of(columns, size, i), 0.0) * seen.scale,
        seen.confusion * (depth - seen.focus),
    )


@inner
def seen_at(columns, i, place, size, moment, view):
    """Return the same at a moment between the cameras, 0 the head's and 1 the tail's."""
    if moment == 0.0:
        return _transformed(columns, i, place, size, view.head)
    after = _transformed(columns, i, place, size, view.tail)
    if moment == 1.0:
        return after
    before = _transformed(columns, i, place, size, view.head)
    return (
        mixed(before[0], after[0], moment), mixed(before[1], after[1], moment), mixed(before[2], after[2], moment),
        mixed(before[3], after[3], moment), mixed(before[4], after[4], moment),
    )


@inner
def between_planes(head, tail, near, far):
    """Return the part of s = 0 ... 1 that lies between the planes; its end is below its start where there is none."""
    start, stop = 0.0, 1.0
    way = tail - head
    if way == 0.0:
        return (0.0, 1.0) if near <= head <= far else (1.0, 0.0)
    at_near, at_far = (near - head) / way, (far - head) / way
    return max(start, min(at_near, at_far)), min(stop, max(at_near, at_far))


@inner
def mixed(a, b, s):
    """Return a + s (b - a), exactly a at 0 and b at 1."""
    return b if s == 1.0 else a + s * (b - a)
