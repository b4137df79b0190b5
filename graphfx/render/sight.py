"""Streaks as two cameras see them, their points also as one camera would that is on its way between the two."""

from __future__ import annotations

import math

import numpy as np

from graphfx.lanes.bits import float_at
from graphfx.lanes.inner import inner

GREATEST_RADIUS = 1e9
"""Pixels; more than this is as good as this, and its square is a float32."""


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


@inner
def unit(value):
    """Return a value kept within 0 ... 1."""
    return min(max(value, 0.0), 1.0)


@inner
def finite(columns, i):
    """Return whether all numbers of particle i are finite."""
    total = 0.0
    for c in range(17):
        value = value_of(columns, c, i)
        total += value - value
    return total == 0.0


@inner
def opacities_of(columns, i, first, last):
    """Return the opacities at the ends of the part that is seen."""
    head, tail = unit(value_of(columns, 14, i)), unit(value_of(columns, 15, i))
    return mixed(head, tail, first), mixed(head, tail, last)


@inner
def time_of(columns, i, first, last):
    """Return the part of the particle's time that the part of row i takes that is seen."""
    return unit(value_of(columns, 17, i)) * (last - first)


@inner
def screen_segment(columns, i, view, look):
    """Return (visible, first s, last s, (x, y, dx, dy, r0, r1, k0, k1), radii in focus, pixels out of it) of particle i."""
    head = seen_at(columns, i, 0, 6, value_of(columns, 19, i), view)
    tail = seen_at(columns, i, 3, 7, value_of(columns, 20, i), view)
    first, last = between_planes(head[2], tail[2], view.near, view.far)
    x0, x1 = mixed(head[0], tail[0], first), mixed(head[0], tail[0], last)
    y0, y1 = mixed(head[1], tail[1], first), mixed(head[1], tail[1], last)
    k0 = min(max(mixed(head[2], tail[2], first), view.near), view.far)  # rounding must not leave the planes
    k1 = min(max(mixed(head[2], tail[2], last), view.near), view.far)
    r0, r1 = mixed(head[3], tail[3], first), mixed(head[3], tail[3], last)
    c0, c1 = mixed(head[4], tail[4], first), mixed(head[4], tail[4], last)
    if view.perspective:
        i0, i1 = 1.0 / k0, 1.0 / k1
        x0, y0, r0, c0, k0 = x0 * i0, y0 * i0, r0 * i0, c0 * i0, -i0
        x1, y1, r1, c1, k1 = x1 * i1, y1 * i1, r1 * i1, c1 * i1, -i1
    sharp = min(r0, GREATEST_RADIUS), min(r1, GREATEST_RADIUS)
    confusion = 0.0, 0.0
    if view.blurred:
        confusion = _bounded(c0 * look.spread), _bounded(c1 * look.spread)
    r0, r1 = _drawn_radius(sharp[0], confusion[0]), _drawn_radius(sharp[1], confusion[1])
    visible = first <= last and max(sharp[0], sharp[1]) > 0.0 and (x0 + y0 + x1 + y1) * 0.0 == 0.0
    return visible, first, last, (x0, y0, x1 - x0, y1 - y0, r0, r1, k0, k1), sharp, confusion


@inner
def _drawn_radius(radius, confusion):
    """Return the radius of what is out of focus."""
    return radius if confusion == 0.0 else min(math.sqrt(radius * radius + confusion * confusion), GREATEST_RADIUS)


@inner
def _bounded(confusion):
    return min(max(confusion, -GREATEST_RADIUS), GREATEST_RADIUS)
