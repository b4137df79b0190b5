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

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.chains import chain_of, laid_straight, trace_path
from graphfx.render.evenness import evenness
from graphfx.render.falloff import CURVE
from graphfx.render.joints import PACE, TIME, joints_of, write_joints
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
from graphfx.render.sight import finite, mixed, opacities_of, screen_segment, time_of, unit, value_of
from graphfx.render.weights import GREATEST_PACE, pace_of, true_total

GREATEST_OPACITY = 1e6
"""At the centre of a small particle, before its share of a pixel; far more than is ever needed."""
GREATEST_COLOR = 1e30
"""Colours are kept within this, so that differences and sums of them stay finite."""


@inner
def _color(value):
    return min(max(value, -GREATEST_COLOR), GREATEST_COLOR)


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
def _write_place(segment, sharp, confusion, pace, kind, look, segments, at):
    """Write where a segment is, and how far out of focus."""
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
    if kind & BLURRED:
        focus = segments.focus
        focus[at, SHARP0], focus[at, SHARP1] = sharp[0], sharp[1]
        focus[at, CONFUSION0], focus[at, CONFUSION1] = confusion[0], confusion[1]


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
def _kind_of(sharp, confusion, look):
    """Return the kind of a segment that goes on in no other."""
    kind = look.code | (0 if look.exposed else SOLID) | (THIN if min(sharp[0], sharp[1]) < 1.0 else 0)
    return kind | BLURRED | THIN if confusion[0] != 0.0 or confusion[1] != 0.0 else kind


@inner
def _chain_factor(segment, path, k, look, perspective, segments, at):
    """Return what weighs the opacity of a piece that is joined, and its factor."""
    length, ahead, time, light = chain_of(path, k, look)
    straight, sharp, confusion, opacities = laid_straight(segment, path, k, length, ahead)
    whole = pace_of(straight, look, perspective)
    _write_place(straight, sharp, confusion, whole, _kind_of(sharp, confusion, look), look, segments, at)
    factor = evenness(segments, at, perspective, opacities, true_total(sharp, opacities, straight, look))
    if look.exposed:
        return min(path.pieces[k, PACE] * time / path.pieces[k, TIME], GREATEST_PACE), factor * light * time
    return whole, factor


@inner
def _write_segment(columns, i, count, view, look, window, number, segments, at, path):
    """Write the segment of particle i, which is `number` of all; return whether it is seen in the window."""
    visible, first, last, segment, sharp, confusion = screen_segment(columns, i, view, look)
    if not visible or not touches(segment, look.reach, window):
        return False
    opacities, kind = opacities_of(columns, i, first, last), _kind_of(sharp, confusion, look)
    pace, factor = pace_of(segment, look, view.perspective), time_of(columns, i, first, last) if look.exposed else 1.0
    joints = k = 0
    if len(path.pieces) > 0:
        k = trace_path(columns, i, count, view, look, path)
        joints = joints_of(path, k)
    if joints != 0:
        pace, factor = _chain_factor(segment, path, k, look, view.perspective, segments, at)
        write_joints(path, k, joints, segments, at)
    _write_place(segment, sharp, confusion, pace, kind | joints, look, segments, at)
    if window.slab.sliced and not _in_slab(segments.nearest[at], number, window.slab):
        return False
    if joints == 0:
        factor *= evenness(segments, at, view.perspective, opacities, true_total(sharp, opacities, segment, look))
    if look.exposed:
        factor *= unit(value_of(columns, 16, i))
    return _write_look(columns, i, first, last, opacities, factor, look, segments, at)


@compiled
def project(columns, view, look, window, first, count, segments, at, path):
    """Write the segments of `count` particles from row `at` on; return how many, and how many particles were dropped.

    Particle i of the columns is number first + i of all streams. Only those that may touch the window are written.
    `path` is room for the longest path; for none where no streak goes on in another.
    """
    begin, dropped = at, 0
    filtered = len(window.top_rows) > 0
    for i in range(count):
        number = first + i
        if filtered and (window.top_rows[number] > window.last_row or window.bottom_rows[number] < window.first_row):
            continue
        if not finite(columns, i):
            dropped += 1
        elif _write_segment(columns, i, count, view, look, window, number, segments, at, path):
            if len(segments.particle):
                segments.particle[at] = number
            at += 1
    return at - begin, dropped
