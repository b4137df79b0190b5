"""Chains: pieces of one path that go on in each other look as one streak, however it is cut.

A chain of pieces of lengths L and times p, parts of the shutter, has the length and the time

    sum L,  T = sum p

An exposed piece has the opacity of a streak of the time T at its own speed, L -> L T / p in the weight of layer.py, and a
solid one that of a streak of the length of all. In even motion that is the same all along, and the total is T times that of the
still particle. Else it is made so by a factor: with the pieces' speeds v, in radii a shutter times width / area, and e the
number of their free ends / 2,

    light = T / sum (p v + e) T / (1 + T v)

Evenness (see there) is that of the chain as it were if it went straight on from this piece.
"""

from __future__ import annotations

import math

from graphfx.lanes.inner import inner
from graphfx.render.joints import (
    ALONG_X,
    ALONG_Y,
    CONFUSION_HEAD,
    CONFUSION_TAIL,
    CUT_HEAD,
    CUT_TAIL,
    KEY_HEAD,
    KEY_TAIL,
    LENGTH,
    OPACITY_HEAD,
    OPACITY_TAIL,
    PACE,
    RADIUS_HEAD,
    RADIUS_TAIL,
    SHARP_HEAD,
    SHARP_TAIL,
    TIME,
    find_path,
    join_path,
)
from graphfx.render.sight import finite, opacities_of, screen_segment, time_of
from graphfx.render.weights import pace_of


@inner
def _trace_piece(columns, i, view, look, piece):
    """Write what the screen shows of row i; what is not seen is cut at both ends."""
    piece[:] = 0.0
    visible, first, last, segment, sharp, confusion = screen_segment(columns, i, view, look)
    visible = visible and finite(columns, i)
    piece[CUT_HEAD], piece[CUT_TAIL] = 0.0 if visible and first == 0.0 else 1.0, 0.0 if visible and last == 1.0 else 1.0
    if visible:
        _, _, dx, dy, r0, r1, k0, k1 = segment
        length = math.sqrt(dx * dx + dy * dy)
        if length > 0.0:
            piece[ALONG_X], piece[ALONG_Y] = dx / length, dy / length
        piece[LENGTH], piece[RADIUS_HEAD], piece[RADIUS_TAIL] = length, r0, r1
        piece[KEY_HEAD], piece[KEY_TAIL] = k0, k1
        piece[TIME], piece[PACE] = time_of(columns, i, first, last), pace_of(segment, look, view.perspective)
        piece[SHARP_HEAD], piece[SHARP_TAIL] = sharp
        piece[CONFUSION_HEAD], piece[CONFUSION_TAIL] = confusion
        piece[OPACITY_HEAD], piece[OPACITY_TAIL] = opacities_of(columns, i, first, last)


@inner
def trace_path(columns, i, count, view, look, path):
    """Find the path to which row i belongs, of `count` rows, unless it is known; return its place in it."""
    if not path.bounds[0] <= i < path.bounds[1]:
        find_path(columns, i, count, path)
        path.firsts[0] = path.lasts[0] = 0
        if path.bounds[1] - path.bounds[0] > 1:
            for k in range(path.bounds[1] - path.bounds[0]):
                _trace_piece(columns, path.bounds[0] + k, view, look, path.pieces[k])
            join_path(path, look, view.perspective)
    return i - path.bounds[0]


@inner
def chain_of(path, k, look):
    """Return (length, length ahead of it, time, light) of the chain of piece k."""
    pieces, first, last = path.pieces, path.firsts[k], path.lasts[k]
    length = time = pace = radius = ahead = 0.0
    for j in range(first, last + 1):
        ahead = length if j == k else ahead
        length += pieces[j, LENGTH]
        time += pieces[j, TIME]
        pace += pieces[j, PACE]
        radius += pieces[j, TIME] * (max(pieces[j, RADIUS_HEAD], 1.0) + max(pieces[j, RADIUS_TAIL], 1.0)) * 0.5
    if not look.exposed:
        return length, ahead, time, 1.0
    seen, light = look.width / look.area * length / pace * time / radius, 0.0
    for j in range(first, last + 1):
        passed = pieces[j, PACE] * seen
        light += (passed + (0.5 if j == first else 0.0) + (0.5 if j == last else 0.0)) / (1.0 + passed * time / pieces[j, TIME])
    return length, ahead, time, 1.0 / light


@inner
def laid_straight(segment, path, k, length, ahead):
    """Return (segment, radii in focus, pixels out of it, opacities of its ends) of a chain that goes straight on from piece k."""
    x, y, _, _, _, _, _, _ = segment
    piece, head, tail = path.pieces[k], path.pieces[path.firsts[k]], path.pieces[path.lasts[k]]
    across, down = piece[ALONG_X], piece[ALONG_Y]
    return (
        (
            x - across * ahead, y - down * ahead, across * length, down * length,
            head[RADIUS_HEAD], tail[RADIUS_TAIL], head[KEY_HEAD], tail[KEY_TAIL],
        ),
        (head[SHARP_HEAD], tail[SHARP_TAIL]), (head[CONFUSION_HEAD], tail[CONFUSION_TAIL]),
        (head[OPACITY_HEAD], tail[OPACITY_TAIL]),
    )
