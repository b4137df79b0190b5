"""Project particles to the screen: one segment for each streak that can touch the picture.

Head and tail are brought to (x w, y w, w) by the camera of their own time and joined there, where
the straight line is straight and every parameter is linear in s = 0 (head) ... 1 (tail). The part
between the near and the far plane is kept. On the screen, with t the share of the projected segment,

    radius r(t) = r0 + t (r1 - r0)        pixels: the linear world radius over the depth
    focus  c(t) = c0 + t (c1 - c0)        pixels that it is out of focus: C (1 - focus / w), see camera.py and falloff.py
    key    k(t) = k0 + t (k1 - k0)        -1 / w in perspective, w in orthographic: orders by depth
    s(t) = t k1 / k(t)                    for colour and opacity (orthographic: s = t)

Between the shutter's ends the camera stands so that what is still goes straight on the screen:
a point at moment m (0: head camera, 1: tail camera) is (1 - m) of what one sees and m of what the other does.
"""

from __future__ import annotations

import math

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.evenness import evenness
from graphfx.render.falloff import CURVE
from graphfx.render.joints import joints_of, write_joints
from graphfx.render.order import ordered_word
from graphfx.render.segments import (
    BLURRED,
    CONFUSION0,
    CONFUSION1,
    DX,
    DY,
    KEY0,
    KEY1,
    OPACITY,
    RADIUS0,
    RADIUS1,
    RED,
    SHARP0,
    SHARP1,
    SOLID,
    THIN,
    VARYING,
    X,
    Y,
)
from graphfx.render.sight import between_planes, mixed, seen_at, value_of
from graphfx.render.weights import GREATEST_PACE, joined_total, pace_of, true_total

GREATEST_RADIUS = 1e9
"""Pixels; more than this is as good as this, and its square is a float32."""
GREATEST_OPACITY = 1e6
"""At the centre of a small particle, before its share of a pixel; far more than is ever needed."""
GREATEST_COLOR = 1e30
"""Colours are kept within this, so that differences and sums of them stay finite."""


@inner
def finite(columns, i):
    """Return whether all numbers of particle i are finite."""
    total = 0.0
    for c in range(17):
        value = value_of(columns, c, i)
        total += value - value
    return total == 0.0


@inner
def _unit(value):
    return min(max(value, 0.0), 1.0)


@inner
def _color(value):
    return min(max(value, -GREATEST_COLOR), GREATEST_COLOR)


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
def _write_place(segment, pace, kind, look, segments, at):
    """Write where a segment is."""
    x, y, dx, dy, r0, r1, k0, k1 = segment
    places, values = segments.places, segments.values
    places[at, X], places[at, Y], places[at, DX], places[at, DY] = x, y, dx, dy
    values[at, RADIUS0], values[at, RADIUS1] = r0, r1
    values[at, KEY0], values[at, KEY1] = k0 + 0.0, k1 + 0.0
    segments.pace[at] = pace
    if kind & 3 == CURVE:
        segments.curve[at] = look.curve
    segments.kind[at] = kind
    segments.nearest[at] = min(values[at, KEY0], values[at, KEY1])


@inner
def _write_focus(sharp, confusion, segments, at):
    """Write what a segment that is out of focus would be in focus, and how far it is out."""
    focus = segments.focus
    focus[at, SHARP0], focus[at, SHARP1] = sharp[0], sharp[1]
    focus[at, CONFUSION0], focus[at, CONFUSION1] = confusion[0], confusion[1]


@inner
def _opacities(columns, i, first, last):
    """Return the opacities at the ends of the part that is seen."""
    head, tail = _unit(value_of(columns, 14, i)), _unit(value_of(columns, 15, i))
    return mixed(head, tail, first), mixed(head, tail, last)


@inner
def _write_look(columns, i, first, last, opacities, factor, look, segments, at):
    """Write colour and opacity of both ends; return whether any opacity is left.

    The opacity of a small particle may pass 1, where its light lies between pixels; no fragment's does.
    """
    values, tails = segments.values, segments.tails
    opacity0 = np.float32(look.sign * min(opacities[0] * factor, GREATEST_OPACITY))
    opacity1 = np.float32(look.sign * min(opacities[1] * factor, GREATEST_OPACITY))
    values[at, OPACITY] = opacity0
    varying = opacity0 != opacity1
    for c in range(3):
        head, tail = _color(value_of(columns, 8 + c, i)), _color(value_of(columns, 11 + c, i))
        values[at, RED + c] = mixed(head, tail, first)
        if look.varies:
            tails[at, c] = mixed(head, tail, last)
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


@inner
def _write_segment(columns, i, view, look, window, number, segments, at):
    """Write the segment of particle i, which is `number` of all; return whether it is seen in the window."""
    visible, first, last, segment, sharp, confusion = screen_segment(columns, i, view, look)
    if not visible or not touches(segment, look.reach, window):
        return False
    kind = look.code | (0 if look.exposed else SOLID) | (THIN if min(sharp[0], sharp[1]) < 1.0 else 0)
    if confusion[0] != 0.0 or confusion[1] != 0.0:
        kind |= BLURRED | THIN
        _write_focus(sharp, confusion, segments, at)
    pace, portion = pace_of(segment, look, view.perspective), _unit(value_of(columns, 17, i)) * (last - first)
    joints = joints_of(np.int64(value_of(columns, 18, i)), segment, first, last)
    opacities = _opacities(columns, i, first, last)
    total, factor = true_total(sharp, opacities, segment, look), 1.0
    if joints != 0 and portion > 0.0:
        kind |= joints
        write_joints(columns, i, view, segment, segments, at)
        pace = min(pace / portion, GREATEST_PACE)
        total = joined_total(sharp, opacities, segment, look, joints, portion)
    elif look.exposed:
        factor = portion
    _write_place(segment, pace, kind, look, segments, at)
    if window.slab.sliced and not _in_slab(segments.nearest[at], number, window.slab):
        return False
    factor *= evenness(segments, at, view.perspective, opacities, total)
    if look.exposed:
        factor *= _unit(value_of(columns, 16, i))
    return _write_look(columns, i, first, last, opacities, factor, look, segments, at)


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
        elif _write_segment(columns, i, view, look, window, number, segments, at):
            if len(segments.particle):
                segments.particle[at] = number
            at += 1
    return at - begin, dropped
