"""Project particles to the screen: one segment for each streak that can touch the picture.

Head and tail are brought to (x w, y w, w) by the camera of their own time and joined there, where
the straight line is straight and every parameter is linear in s = 0 (head) ... 1 (tail). The part
between the near and the far plane is kept. On the screen, with t the share of the projected segment,

    radius r(t) = r0 + t (r1 - r0)        pixels: the linear world radius over the depth
    key    k(t) = k0 + t (k1 - k0)        -1 / w in perspective, w in orthographic: orders by depth
    s(t) = t k1 / k(t)                    for colour and opacity (orthographic: s = t)
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.bits import float_at
from graphfx.lanes.inner import inner
from graphfx.render.evenness import evenness
from graphfx.render.order import ordered_word
from graphfx.render.segments import (
    DX,
    DY,
    KEY0,
    KEY1,
    OPACITY,
    RADIUS0,
    RADIUS1,
    RED,
    SOLID,
    THIN,
    VARYING,
    X,
    Y,
)

GREATEST_RADIUS = 1e9
"""Pixels; more than this is as good as this, and its square is a float32."""
GREATEST_PACE = 1e28
"""Times the greatest radius still a float32."""
GREATEST_COLOR = np.float32(1e30)
"""Colours are kept within this, so that differences and sums of them stay finite."""


class View(NamedTuple):
    """The two cameras and the picture."""

    head: np.ndarray
    tail: np.ndarray
    head_scale: float
    tail_scale: float
    near: float
    far: float
    perspective: bool


class Slab(NamedTuple):
    """A slice of depth: of particles start ... stop - 1 those whose nearest key is, as ordered bits, from low to high."""

    sliced: bool
    low: int
    high: int
    start: int
    stop: int


class Window(NamedTuple):
    """What is rendered at one time: pixels left ... right - 1, top ... bottom - 1, of all depths or of a slab.

    Where `top_rows` and `bottom_rows` hold the first and last row of tiles that each particle reaches, those that do not
    reach the rows first_row ... last_row are passed over.
    """

    left: int
    top: int
    right: int
    bottom: int
    first_row: int
    last_row: int
    top_rows: np.ndarray
    bottom_rows: np.ndarray
    slab: Slab


class Look(NamedTuple):
    """How one stream looks: see Falloff; `sign` is -1 for `add`."""

    code: int
    width: float
    area: float
    reach: float
    sign: float
    exposed: bool
    varies: bool


@inner
def _value(columns, c, i):
    """Return particle i's value of column c: row 0 of `columns` holds the addresses, row 1 the masks of the index."""
    return float_at(columns[0, c], i & columns[1, c])


@inner
def _transformed(matrix, x, y, z):
    return (
        matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z + matrix[0, 3],
        matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z + matrix[1, 3],
        matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z + matrix[2, 3],
    )


@inner
def _between_planes(head, tail, near, far):
    """Return the part of s = 0 ... 1 that lies between the planes; its end is below its start where there is none."""
    start, stop = 0.0, 1.0
    way = tail - head
    if way == 0.0:
        return (0.0, 1.0) if near <= head <= far else (1.0, 0.0)
    at_near, at_far = (near - head) / way, (far - head) / way
    return max(start, min(at_near, at_far)), min(stop, max(at_near, at_far))


@inner
def _mixed(a, b, s):
    """Return a + s (b - a), exactly a at 0 and b at 1."""
    return b if s == 1.0 else a + s * (b - a)


@inner
def finite(columns, i):
    """Return whether all numbers of particle i are finite."""
    total = 0.0
    for c in range(17):
        value = _value(columns, c, i)
        total += value - value
    return total == 0.0


@inner
def _unit(value):
    return min(max(value, 0.0), 1.0)


@inner
def _color(value):
    return np.float64(min(max(value, -GREATEST_COLOR), GREATEST_COLOR))


@inner
def screen_segment(columns, i, view):
    """Return (visible, first s, last s, (x, y, dx, dy, r0, r1, k0, k1)) of particle i."""
    head = _transformed(view.head, _value(columns, 0, i), _value(columns, 1, i), _value(columns, 2, i))
    tail = _transformed(view.tail, _value(columns, 3, i), _value(columns, 4, i), _value(columns, 5, i))
    first, last = _between_planes(head[2], tail[2], view.near, view.far)
    r_head = max(np.float64(_value(columns, 6, i)), 0.0) * view.head_scale
    r_tail = max(np.float64(_value(columns, 7, i)), 0.0) * view.tail_scale
    x0, x1 = _mixed(head[0], tail[0], first), _mixed(head[0], tail[0], last)
    y0, y1 = _mixed(head[1], tail[1], first), _mixed(head[1], tail[1], last)
    k0 = min(max(_mixed(head[2], tail[2], first), view.near), view.far)  # rounding must not leave the planes
    k1 = min(max(_mixed(head[2], tail[2], last), view.near), view.far)
    r0, r1 = _mixed(r_head, r_tail, first), _mixed(r_head, r_tail, last)
    if view.perspective:
        i0, i1 = 1.0 / k0, 1.0 / k1
        x0, y0, r0, k0 = x0 * i0, y0 * i0, r0 * i0, -i0
        x1, y1, r1, k1 = x1 * i1, y1 * i1, r1 * i1, -i1
    r0, r1 = min(r0, GREATEST_RADIUS), min(r1, GREATEST_RADIUS)
    visible = first <= last and max(r0, r1) > 0.0 and (x0 + y0 + x1 + y1) * 0.0 == 0.0
    return visible, first, last, (x0, y0, x1 - x0, y1 - y0, r0, r1, k0, k1)


@inner
def touches(segment, reach, window):
    """Return whether a segment's bounding box holds the centre of a pixel of the window."""
    x, y, dx, dy, r0, r1, _, _ = segment
    margin = max(r0, r1, 1.0) + reach
    return (
        max(x, x + dx) + margin > window.left + 0.5 and min(x, x + dx) - margin < window.right - 0.5
        and max(y, y + dy) + margin > window.top + 0.5 and min(y, y + dy) - margin < window.bottom - 0.5
    )


@inner
def _pace(segment, look, perspective):
    """Return what weighs the segment's opacity (see layer.py): solid (width / area) L, exposed (width / area) of its speed.

    In perspective the speed on the screen, pixels a shutter, of motion that is even in s is pace k(t)^2.
    """
    _, _, dx, dy, _, _, k0, k1 = segment
    pace = look.width / look.area * math.sqrt(dx * dx + dy * dy)
    return min(pace / (k0 * k1) if look.exposed and perspective else pace, GREATEST_PACE)


@inner
def _true_total(segment, look):
    """Return the total of opacity 1: of the capsule if solid, of the still particle if exposed."""
    _, _, dx, dy, r0, r1, _, _ = segment
    still = look.area * (r0 * r0 + r1 * r1) * 0.5
    return still if look.exposed else still + look.width * math.sqrt(dx * dx + dy * dy) * (r0 + r1) * 0.5


@inner
def _write_place(segment, pace, look, segments, at):
    """Write where a segment is."""
    x, y, dx, dy, r0, r1, k0, k1 = segment
    places, values = segments.places, segments.values
    places[at, X], places[at, Y], places[at, DX], places[at, DY] = x, y, dx, dy
    values[at, RADIUS0], values[at, RADIUS1] = r0, r1
    values[at, KEY0], values[at, KEY1] = k0 + 0.0, k1 + 0.0
    segments.pace[at] = pace
    segments.kind[at] = look.code | (THIN if min(r0, r1) < 1.0 else 0) | (0 if look.exposed else SOLID)
    segments.nearest[at] = min(values[at, KEY0], values[at, KEY1])


@inner
def _write_look(columns, i, first, last, factor, look, segments, at):
    """Write colour and opacity of both ends; return whether any opacity is left."""
    values, tails = segments.values, segments.tails
    head, tail = _unit(np.float64(_value(columns, 14, i))), _unit(np.float64(_value(columns, 15, i)))
    opacity0 = np.float32(look.sign * min(_mixed(head, tail, first) * factor, 1.0))
    opacity1 = np.float32(look.sign * min(_mixed(head, tail, last) * factor, 1.0))
    values[at, OPACITY] = opacity0
    varying = opacity0 != opacity1
    for c in range(3):
        head, tail = _color(_value(columns, 8 + c, i)), _color(_value(columns, 11 + c, i))
        values[at, RED + c] = _mixed(head, tail, first)
        if look.varies:
            tails[at, c] = _mixed(head, tail, last)
            varying = varying or head != tail
    if look.varies:
        tails[at, 3] = opacity1
    if varying:
        segments.kind[at] |= VARYING
    return opacity0 != 0.0 or opacity1 != 0.0


@inner
def _in_slab(nearest, number, slab):
    """Return whether a particle is among those of a slab of depth."""
    word = np.int64(ordered_word(nearest))
    return slab.low <= word <= slab.high and slab.start <= number < slab.stop


@compiled
def project(columns, view, look, window, first, count, segments, at):
    """Write the segments of `count` particles from row `at` on; return how many, and how many particles were dropped.

    Particle i of the columns is number first + i of all streams. Only those that may touch the window are written.
    """
    begin, dropped = at, 0
    filtered = len(window.top_rows) > 0
    for i in range(count):
        number = first + i
        if filtered and (window.top_rows[number] > window.last_row or window.bottom_rows[number] < window.first_row):
            continue
        if not finite(columns, i):
            dropped += 1
            continue
        visible, start, stop, segment = screen_segment(columns, i, view)
        if not visible or not touches(segment, look.reach, window):
            continue
        _write_place(segment, _pace(segment, look, view.perspective), look, segments, at)
        if window.slab.sliced and not _in_slab(segments.nearest[at], number, window.slab):
            continue
        factor = evenness(segments, at, view.perspective, _true_total(segment, look))
        if look.exposed:
            factor *= _unit(np.float64(_value(columns, 16, i))) * (stop - start)
        if _write_look(columns, i, start, stop, factor, look, segments, at):
            if len(segments.particle):
                segments.particle[at] = number
            at += 1
    return at - begin, dropped
