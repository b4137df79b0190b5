"""One layer: the fragments of one segment at the sixteen pixels of a group, 8 wide and 2 high.

    t = clamp((p - p0) . (p1 - p0) / |p1 - p0|^2)      the closest point of the segment, on the screen
    r = r0 + t (r1 - r0),  rho = max(r, 1)             radius there, pixels
    opacity = o(s) shape(distance / rho) weight(r, rho)            shape: see falloff.py
    weight = r (r + rest) / (rho (rho + rest + speed))             what clamping, focus and exposure leave
    key = k0 + t (k1 - k0), between k0 and k1          so that rounding never puts it before the whole segment

Solid streaks have rest = (width / area) L and speed 0, exposed ones rest 0 and speed = (width / area) v, v being
the speed on the screen there, pixels a shutter. So a capsule of even radius has the total (width r L + area r^2)
if it is solid, and the total area r^2 of the still particle if it is exposed, also with its radius clamped. Out of focus
by c pixels, rho = max(sqrt(r^2 + c^2), 1). Of a segment that goes on in another, what lies beyond the joint is left to that.

float32, relative to the centre of the tile's first pixel; long segments are clipped to the tile's
neighbourhood first, and those of great radii to the closest points, in float64, so that they are as exact as short ones.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes import any_lane, iota, register
from graphfx.lanes.bits import float_at
from graphfx.lanes.inner import inner
from graphfx.math import exp2
from graphfx.math.primitives import floor, maximum, minimum, sqrt, where
from graphfx.render.falloff import CURVE, DISC, DISC_RAMP, EDGE, GAUSSIAN, SHARPNESS
from graphfx.render.segments import (
    BLUE,
    BLURRED,
    CONFUSION0,
    CONFUSION1,
    DX,
    DY,
    GREEN,
    HEAD_X,
    JOINED_HEAD,
    JOINED_TAIL,
    KEY0,
    KEY1,
    OPACITY,
    RADIUS0,
    RADIUS1,
    RED,
    SHARP0,
    SHARP1,
    SOLID,
    TAIL_X,
    THIN,
    VARYING,
    X,
    Y,
)

TILE_WIDTH, TILE_HEIGHT = 8, 16
GROUP_HEIGHT = 2
GROUPS = TILE_HEIGHT // GROUP_HEIGHT
LONG = 64.0
"""Pixels across or down beyond which a segment is clipped."""
SHORTEST = np.float32(1e-12)
"""Squared length, pixels^2, up to which a segment is a point."""
SLACK = np.float32(1.001)
"""So much greater is the square of the reach taken, that rounding never loses a fragment."""
NOWHERE = np.float32(-np.inf)
FALL = -SHARPNESS * math.log2(math.e)
F = np.float32

register(exp2)


class Local(NamedTuple):
    """A segment in a tile: float32, relative to the centre of the tile's first pixel."""

    x: np.float32
    y: np.float32
    dx: np.float32
    dy: np.float32
    inverse: np.float32
    radius: np.float32
    radius_way: np.float32
    confusion: np.float32
    confusion_way: np.float32
    head_plane: tuple[np.float32, np.float32, np.float32]
    tail_plane: tuple[np.float32, np.float32, np.float32]
    key: np.float32
    key_way: np.float32
    nearest: np.float32
    farthest: np.float32
    first: np.float32
    share: np.float32
    reach: np.float32
    rest: np.float32
    pace: np.float32
    kind: np.int64
    curve: np.int64


@inner
def clipped(start, way, low, high, first, last):
    """Return first ... last narrowed to where start + t way lies within low ... high."""
    if way != 0.0:
        a, b = (low - start) / way, (high - start) / way
        first, last = max(first, min(a, b)), min(last, max(a, b))
    return first, last


@inner
def _bounded(value, most):
    """Return a value as float32; beyond 10^12 pixels, where float64 ends, it may be wrong, but never more than `most`."""
    return F(min(max(value, -most), most))


@inner
def _plane(joints, q, at, x, y):
    """Return the normal of the plane through (x, y) in which a segment ends, and its product with the points of it."""
    across, down = joints[q, at], joints[q, at + 1]
    return across, down, F(across * x + down * y)


@inner
def _beside_tile(x, y, dx, dy, first, last):
    """Return first ... last narrowed to where the closest points to pixels of the tile are, and a pixel more."""
    squared = dx * dx + dy * dy
    start, across, down = -(x * dx + y * dy) / squared, (TILE_WIDTH - 1) * dx / squared, (TILE_HEIGHT - 1) * dy / squared
    more = 1.0 / math.sqrt(squared)
    first = min(max(first, start + min(across, 0.0) + min(down, 0.0) - more), last)
    return first, max(min(last, start + max(across, 0.0) + max(down, 0.0) + more), first)


@inner
def localize(segments, q, left, top):
    """Return segment q relative to the pixel centre (left, top); its `inverse` is negative if it misses the tile."""
    places, values, kind = segments.places, segments.values, np.int64(segments.kind[q])
    x, y = places[q, X] - left, places[q, Y] - top
    dx, dy = places[q, DX], places[q, DY]
    r0, r1, k0, k1 = values[q, RADIUS0], values[q, RADIUS1], values[q, KEY0], values[q, KEY1]
    reach = max(max(r0, r1), F(1.0))
    if kind & 3 == DISC:
        reach += F(DISC_RAMP)
    first, last = 0.0, 1.0
    margin = np.float64(reach) + 1.0
    if max(abs(dx), abs(dy)) > LONG:
        first, last = clipped(x, dx, -margin, TILE_WIDTH - 1 + margin, first, last)
        first, last = clipped(y, dy, -margin, TILE_HEIGHT - 1 + margin, first, last)
        if margin > LONG and first < last:
            first, last = _beside_tile(x, y, dx, dy, first, last)
    share = last - first
    confusion, confusion_way = np.float64(0.0), np.float64(0.0)
    if kind & BLURRED:
        r0, r1 = segments.focus[q, SHARP0], segments.focus[q, SHARP1]
        confusion = np.float64(segments.focus[q, CONFUSION0])
        confusion_way = np.float64(segments.focus[q, CONFUSION1]) - confusion
    head_plane = tail_plane = (F(0.0), F(0.0), F(0.0))
    if kind & JOINED_HEAD:
        head_plane = _plane(segments.joints, q, HEAD_X, x, y)
    if kind & JOINED_TAIL:
        tail_plane = _plane(segments.joints, q, TAIL_X, x + dx, y + dy)
    radius_way, key_way = np.float64(r1) - np.float64(r0), np.float64(k1) - np.float64(k0)
    most = margin + LONG + TILE_HEIGHT
    start_x, start_y = _bounded(x + first * dx, most), _bounded(y + first * dy, most)
    way_x, way_y = _bounded(dx * share, 2.0 * most), _bounded(dy * share, 2.0 * most)
    squared = way_x * way_x + way_y * way_y
    inverse = F(1.0) / squared if squared > SHORTEST else F(0.0)
    pace = segments.pace[q]
    return Local(
        start_x, start_y, way_x, way_y, inverse if share >= 0.0 else F(-1.0),
        F(r0 + first * radius_way), F(share * radius_way),
        F(confusion + first * confusion_way), F(share * confusion_way), head_plane, tail_plane,
        F(k0 + first * key_way), F(share * key_way),
        min(k0, k1), max(k0, k1), F(first), F(share), reach,
        pace if kind & SOLID else F(0.0), F(0.0) if kind & SOLID else pace, kind,
        segments.curve[q] if kind & 3 == CURVE else np.int64(0),
    )


@inner
def groups_touched(local):
    """Return the first and last group of rows that the segment may touch; the first is beyond the last if none."""
    first, last = clipped(local.x, local.dx, -local.reach, F(TILE_WIDTH - 1) + local.reach, F(0.0), F(1.0))
    a, b = local.y + first * local.dy, local.y + last * local.dy
    top, bottom = min(a, b) - local.reach - F(0.01), max(a, b) + local.reach + F(0.01)
    if local.inverse < F(0.0) or not (first <= last and top < F(TILE_HEIGHT) and bottom > F(-1.0)):
        return 0, -1
    return int(max(top * F(0.5) + F(0.5), F(0.0))), int(min(bottom * F(0.5), F(GROUPS - 1)))


@inner
def pixel_columns():
    """Return the column of each lane, 0 to 7."""
    return iota() - floor(iota() * 0.125) * 8.0


@inner
def pixel_rows(group):
    """Return the row of each lane in the tile."""
    return floor(iota() * 0.125) + F(GROUP_HEIGHT * group)


@inner
def nearest_point(local, group):
    """Return t of the closest point of the segment, and the squared distance to it in pixels."""
    across, down = pixel_columns() - local.x, pixel_rows(group) - local.y
    t = minimum(maximum((across * local.dx + down * local.dy) * local.inverse, 0.0), 1.0)
    across, down = across - t * local.dx, down - t * local.dy
    return t, across * across + down * down


@inner
def misses(local, group):
    """Return whether all pixels are too far away, without what takes long: the square root and the quotients."""
    return not any_lane(nearest_point(local, group)[1] < local.reach * local.reach * SLACK)


@inner
def beyond_joint(local, group):
    """Return which pixels lie beyond the plane between the segment and another in which it goes on."""
    across, down = pixel_columns(), pixel_rows(group)
    beyond = across < NOWHERE
    if local.kind & JOINED_HEAD:
        x, y, least = local.head_plane
        beyond = beyond | (across * x + down * y < least)
    if local.kind & JOINED_TAIL:
        x, y, least = local.tail_plane
        beyond = beyond | (across * x + down * y >= least)
    return beyond


@inner
def on_curve(table, q):
    """Return a curve's value at q; its lines lie at an address, see falloff.py."""
    value = q * 0.0
    for line in range(int(float_at(table, 0))):
        start, first, slope = float_at(table, 3 * line + 1), float_at(table, 3 * line + 2), float_at(table, 3 * line + 3)
        value = where(q >= start, first + (q - start) * slope, value)
    return value


@inner
def fragments(local, group, square):
    """Return (key, opacity at the full opacity of 1, t, which lanes are touched); `square` says perspective."""
    t, squared = nearest_point(local, group)
    distance = sqrt(squared)
    if local.kind & (JOINED_HEAD | JOINED_TAIL):
        distance = where(beyond_joint(local, group), -NOWHERE, distance)
    key = minimum(maximum(local.key + t * local.key_way, local.nearest), local.farthest)
    radius = local.radius + t * local.radius_way
    clamped = maximum(radius, 1.0)
    if local.kind & BLURRED:
        confusion = local.confusion + t * local.confusion_way
        clamped = maximum(sqrt(radius * radius + confusion * confusion), 1.0)
    speed = key * key * local.pace if square else key * 0.0 + local.pace
    code = local.kind & 3
    if code == DISC:
        shape = minimum(clamped + DISC_RAMP - distance, 1.0)
    elif code == GAUSSIAN:
        q = minimum(distance / clamped, 1.0)
        shape = (exp2(q * q * FALL) - EDGE) * (1.0 / (1.0 - EDGE))
        shape = where(distance < clamped, shape, 0.0)
    elif code == CURVE:
        shape = where(distance < clamped, on_curve(local.curve, distance / clamped), 0.0)
    else:
        shape = (clamped - distance) / clamped
    if local.kind & THIN:
        share = radius * (radius + local.rest) / (clamped * (clamped + local.rest + speed))
    else:
        share = (radius + local.rest) / (radius + local.rest + speed)
    return key, shape * share, t, shape > 0.0


@inner
def alpha_of(opacity, shape):
    """Return the alpha of fragments, negative where they add: opacity times shape, never beyond 1."""
    return minimum(maximum(opacity * shape, -1.0), 1.0)


@inner
def along(values, local, key, t, square):
    """Return s, the share of the way from head to tail in space: t k1 / k(t) in perspective, t in orthographic."""
    s = local.first + t * local.share
    return minimum(s * values[KEY1] / key, 1.0) if square else s


@inner
def colored(segments, q, local, key, t, square):
    """Return (opacity, red, green, blue) where s = t k1 / k(t) in perspective, s = t in orthographic."""
    values, tails = segments.values, segments.tails
    none = t * 0.0
    opacity, red = none + values[q, OPACITY], none + values[q, RED]
    green, blue = none + values[q, GREEN], none + values[q, BLUE]
    if local.kind & VARYING:
        s = along(values[q], local, key, t, square)
        opacity = opacity + s * (tails[q, 3] - values[q, OPACITY])
        red = red + s * (tails[q, 0] - values[q, RED])
        green = green + s * (tails[q, 1] - values[q, GREEN])
        blue = blue + s * (tails[q, 2] - values[q, BLUE])
    return opacity, red, green, blue
