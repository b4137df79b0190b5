"""Joints: where a piece of a path goes on in the next, what lies on this side of a plane through the joint is left to it.

    n = u(-rho ... rho)        its normal: the way on the screen from a radius before the joint to a radius after it

along the path, from head to tail, rho being the radius that is drawn. Between pieces longer than that, any point of the plane
is as far from one as from the other; so what is drawn is one body along a bent path, with neither gaps nor beads.

A piece goes on in the next if both are seen up to the joint and the cosine of the turn is enough; and further,

- solid, if at neither are the planes of its ends far across each other: with L its length along u, c the angle between them
  and m the unit vector of their sum,

      2 rho tan(c / 2) - L u . m <= CROSSED rho

- exposed, if at neither the turns a and b at its ends, signed, would let light be seen twice; and if the two are alike in
  brightness: with their speeds v at the joint, (width / area) v / rho being in radii a shutter, and the time T that both take,

      | tan(a / 2) + tan(b / 2) | rho <= L,    | 1 / (1 + T v) - 1 / (1 + T v') | <= UNEVEN

What is not joined keeps its caps, and so its light. All this is told of the joint, not of either piece: both do the same.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes.inner import inner
from graphfx.render.layer import SHORTEST
from graphfx.render.segments import HEAD_X, HEAD_Y, JOINED_HEAD, JOINED_TAIL, TAIL_X, TAIL_Y
from graphfx.render.sight import value_of

STRAIGHT_EXPOSED, STRAIGHT_SOLID = 0.7, -0.9
"""Cosine of the turn up to which a piece goes on in the next: where a path turns back, its light is seen twice, but a solid
streak is one body."""
UNEVEN = 0.2
"""How different the brightness of joined pieces may be; a streak and a ball that is nearly still are seen one over the other."""
CROSSED = 0.5
"""Radii by which the planes at the ends of a solid piece may be across each other at its edge."""
(
    ALONG_X, ALONG_Y, LENGTH, RADIUS_HEAD, RADIUS_TAIL, KEY_HEAD, KEY_TAIL, TIME, PACE, CUT_HEAD, CUT_TAIL,
    SHARP_HEAD, SHARP_TAIL, CONFUSION_HEAD, CONFUSION_TAIL, OPACITY_HEAD, OPACITY_TAIL,
) = range(17)
"""Places in the row of a piece: its unit vector and length on the screen, the radii that are drawn, the keys, its part of
the time, what pace_of gives, 1 where a plane cuts it, and what it has at its ends."""
PLACES = 17


class Path(NamedTuple):
    """One path at a time: rows bounds[0] ... bounds[1] - 1 of the stream, and of each piece what the screen shows.

    `joined` says whether a piece goes on in the next at its tail, `held` whether it may, `normals` are those there. The first
    and the last piece of the chain of each, pieces joined in a row, are `firsts` and `lasts`, from the path's beginning on.
    """

    bounds: np.ndarray
    pieces: np.ndarray
    normals: np.ndarray
    joined: np.ndarray
    held: np.ndarray
    firsts: np.ndarray
    lasts: np.ndarray


@inner
def follows(columns, i):
    """Return whether row i's particle goes on in row i + 1."""
    return np.int64(value_of(columns, 18, i)) & 2 != 0 and np.int64(value_of(columns, 18, i + 1)) & 1 != 0


def new_path(longest: int) -> Path:
    """Return room for a path of so many pieces."""
    flags, numbers = np.zeros((2, longest), np.bool_), np.zeros((2, longest), np.int64)
    return Path(np.zeros(2, np.int64), np.zeros((longest, PLACES)), np.zeros((longest, 2)), *flags, *numbers)


@inner
def find_path(columns, i, count, path):
    """Set the bounds to those of the path to which row i belongs."""
    start, stop = i, i + 1
    while start > 0 and follows(columns, start - 1):
        start -= 1
    while stop < count and follows(columns, stop - 1):
        stop += 1
    path.bounds[0], path.bounds[1] = start, stop


@inner
def _brightness(piece, key, radius, time, look, perspective):
    """Return 1 / (1 + T v) of a piece."""
    speed = piece[PACE] / piece[TIME] * (key * key if perspective else 1.0)
    return radius / (radius + time * speed)


@inner
def _goes_on(one, other, look, perspective):
    """Return whether a piece may go on in the next."""
    if one[CUT_TAIL] != 0.0 or other[CUT_HEAD] != 0.0 or not min(one[LENGTH], other[LENGTH]) ** 2 > SHORTEST:
        return False
    turn = one[ALONG_X] * other[ALONG_X] + one[ALONG_Y] * other[ALONG_Y]
    if not turn > (STRAIGHT_EXPOSED if look.exposed else STRAIGHT_SOLID):
        return False
    if not look.exposed:
        return True
    if not min(one[TIME], other[TIME]) > 0.0:
        return False
    key, radius, time = one[KEY_TAIL], max(one[RADIUS_TAIL], 1.0), one[TIME] + other[TIME]
    before = _brightness(one, key, radius, time, look, perspective)
    return abs(before - _brightness(other, key, radius, time, look, perspective)) <= UNEVEN


@inner
def _write_normal(path, k, count):
    """Write the normal of the plane between pieces k and k + 1, a unit vector if there is any way."""
    pieces, radius = path.pieces, max(path.pieces[k, RADIUS_TAIL], 1.0)
    x = y = 0.0
    for step in (-1, 1):
        left, j = radius, k if step < 0 else k + 1
        while left > 0.0 and 0 <= j < count:
            way = min(left, pieces[j, LENGTH])
            x, y, left = x + way * pieces[j, ALONG_X], y + way * pieces[j, ALONG_Y], left - way
            if not path.held[max(j - 1, 0) if step < 0 else j]:
                break
            j += step
    length = math.sqrt(x * x + y * y)
    path.normals[k, 0], path.normals[k, 1] = (x / length, y / length) if length > 0.0 else (0.0, 0.0)


@inner
def _is_crossed(path, k, look):
    """Return whether piece k is too short for the turns at both its ends."""
    piece, normals = path.pieces[k], path.normals
    radius = max(piece[RADIUS_HEAD], piece[RADIUS_TAIL], 1.0)
    if look.exposed:
        turn = abs(_half_turn(path.pieces[k - 1], piece) + _half_turn(piece, path.pieces[k + 1]))
        return not turn * radius <= piece[LENGTH]
    x0, y0, x1, y1 = normals[k - 1, 0], normals[k - 1, 1], normals[k, 0], normals[k, 1]
    cosine, forward = 1.0 + x0 * x1 + y0 * y1, piece[ALONG_X] * (x0 + x1) + piece[ALONG_Y] * (y0 + y1)
    turn, way = 2.0 * abs(x0 * y1 - y0 * x1) / cosine, piece[LENGTH] * forward / math.sqrt(2.0 * cosine)
    return not turn * radius <= way + CROSSED * radius


@inner
def _half_turn(one, other):
    """Return tan(a / 2) of the turn a from one piece to the next."""
    cosine = one[ALONG_X] * other[ALONG_X] + one[ALONG_Y] * other[ALONG_Y]
    return (one[ALONG_X] * other[ALONG_Y] - one[ALONG_Y] * other[ALONG_X]) / (1.0 + cosine)


@inner
def join_path(path, look, perspective):
    """Find the joints of a path whose pieces are known, and its chains."""
    count, pieces = path.bounds[1] - path.bounds[0], path.pieces
    for k in range(count):
        path.held[k] = path.joined[k] = k + 1 < count and _goes_on(pieces[k], pieces[min(k + 1, count - 1)], look, perspective)
    for k in range(count - 1):
        if path.held[k]:
            _write_normal(path, k, count)
    for k in range(1, count - 1):
        if path.held[k - 1] and path.held[k] and _is_crossed(path, k, look):
            path.joined[k - 1] = path.joined[k] = False
    for k in range(count):
        path.firsts[k] = path.firsts[k - 1] if k > 0 and path.joined[k - 1] else k
    for k in range(count - 1, -1, -1):
        path.lasts[k] = path.lasts[k + 1] if path.joined[k] else k


@inner
def joints_of(path, k):
    """Return the bits of the ends at which piece k goes on in another."""
    return (JOINED_HEAD if path.firsts[k] < k else 0) | (JOINED_TAIL if path.lasts[k] > k else 0)


@inner
def write_joints(path, k, joints, segments, at):
    """Write the planes in which piece k ends where it goes on in others."""
    if joints & JOINED_HEAD:
        segments.joints[at, HEAD_X], segments.joints[at, HEAD_Y] = path.normals[k - 1, 0], path.normals[k - 1, 1]
    if joints & JOINED_TAIL:
        segments.joints[at, TAIL_X], segments.joints[at, TAIL_Y] = path.normals[k, 0], path.normals[k, 1]
