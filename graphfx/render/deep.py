"""Groups whose pending list overflowed: gather every pixel's fragments and sort them.

A tile's segments are gone through once for all such groups. A buffer holds the layers of sixteen lanes as they come, and beside
them for each lane the keys of its fragments and the slots that they are in. When it is full, every lane is sorted by (key, slot),
all sixteen at once: keys and slots alone move. What is final is composited, and the rest stays; a buffer that would stay nearly
full is doubled. So memory follows the number of fragments that are pending at one time, not the number there are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphfx.lanes import any_lane, compiled, load, mask_bits, splat, store
from graphfx.lanes.bits import count_bits
from graphfx.lanes.inner import inner
from graphfx.render.cover import begin_pixels, hides
from graphfx.render.layer import (
    GROUP_HEIGHT,
    GROUPS,
    TILE_HEIGHT,
    TILE_WIDTH,
    alpha_of,
    colored,
    fragments,
    groups_touched,
    localize,
    misses,
)
from graphfx.render.order import AHEAD, fetch, sort_lanes
from graphfx.render.pending import EMPTY, LANES, LIGHT, SLOT, add_slot, clear_light, store_slot
from graphfx.render.segments import lines
from graphfx.render.tiles import lanes_inside, tile_corner, write_pixels

FIRST_CAPACITY = 128
"""Slots of each group that a buffer begins with."""
BEGIN = -1
"""A place in a tile's list: before all, when its groups are to be cleared."""


class Buffer(NamedTuple):
    """The fragments of a tile's groups that are pending, and their light.

    Each group has `capacity` slots as in pending.py, `counts` of them in use. Row r of its `keys` and `places` is fragment r of
    each lane: its key, and the slot that it is in; `filled` says how many there are. `spare` is room for a group's slots.
    """

    slots: np.ndarray
    keys: np.ndarray
    places: np.ndarray
    filled: np.ndarray
    counts: np.ndarray
    inside: np.ndarray
    light: np.ndarray
    spare: np.ndarray
    capacity: int


def new_buffer(capacity: int) -> Buffer:
    """Return room for `capacity` layers in each group."""
    numbers = np.zeros(GROUPS, np.int64), np.zeros(GROUPS, np.int64)
    spare = lines(capacity * SLOT // LANES)
    spare[:] = 0.0
    return Buffer(
        lines(GROUPS * capacity * SLOT // LANES), lines(GROUPS * capacity), lines(GROUPS * capacity),
        np.zeros(GROUPS * LANES, np.int64), *numbers, lines(GROUPS * LIGHT // LANES), spare, capacity,
    )


def enlarged(buffer: Buffer) -> Buffer:
    """Return a buffer of twice the capacity with the same content."""
    larger = new_buffer(2 * buffer.capacity)
    for name in ("slots", "keys", "places"):
        before, after = (getattr(each, name).reshape(GROUPS, -1) for each in (buffer, larger))
        after[:, : before.shape[1]] = before
    return larger._replace(filled=buffer.filled, counts=buffer.counts, inside=buffer.inside, light=buffer.light)


@inner
def _begin_tile(tiles, k, buffer, cover):
    """Clear all groups of a tile."""
    left, top = tile_corner(tiles, k)
    for group in range(GROUPS):
        clear_light(buffer.light, group * LIGHT)
        buffer.counts[group] = 0
        buffer.inside[group] = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
    for i in range(GROUPS * LANES):
        buffer.filled[i] = 0
    if cover is not None:
        begin_pixels(cover, k, 0, TILE_WIDTH * TILE_HEIGHT)


@inner
def _fullest(buffer, group):
    """Return the greatest number of fragments in a lane of a group."""
    most = 0
    for lane in range(LANES):
        most = max(most, buffer.filled[group * LANES + lane])
    return most


@inner
def _held(buffer, group):
    """Return the number of fragments of a group."""
    total = 0
    for lane in range(LANES):
        total += buffer.filled[group * LANES + lane]
    return total


@inner
def _close_keys(buffer, group, count):
    """Give rows of keys, as many as the fullest lane has, the key EMPTY where a lane has no fragment."""
    base = group * buffer.capacity * LANES
    for lane in range(LANES):
        for row in range(buffer.filled[group * LANES + lane], count):
            buffer.keys[base + row * LANES + lane] = EMPTY
            buffer.places[base + row * LANES + lane] = 0.0


@inner
def _final(buffer, group, count, limit):
    """Return how many fragments have a key of at most `limit`."""
    base, final = group * buffer.capacity * LANES, 0
    for row in range(count):
        key = load(buffer.keys, base + row * LANES)
        final += count_bits(mask_bits((key <= limit) & (key < EMPTY)))
    return final


@inner
def _fetch(buffer, group, row, lane, at):
    """Copy the fragment that is `row` in the order of a lane to the spare slot `at`."""
    base = group * buffer.capacity
    source = (base + int(buffer.places[(base + row) * LANES + lane])) * SLOT + lane
    for plane in range(0, SLOT, LANES):
        buffer.spare[at * SLOT + plane + lane] = buffer.slots[source + plane]


@inner
def _flush(buffer, group, count, limit, cover):
    """Sort closed rows of keys, and composite what has a key of at most `limit`."""
    base, slots = group * buffer.capacity * LANES, group * buffer.capacity * SLOT
    sort_lanes(buffer.keys, buffer.places, base, count)
    for row in range(count):
        key = load(buffer.keys, base + row * LANES)
        final = (key <= limit) & (key < EMPTY)
        if not any_lane(final):
            break
        store(buffer.spare, 0, key)
        for lane in range(LANES):
            source = slots + int(buffer.places[base + row * LANES + lane]) * SLOT + lane
            for plane in range(LANES, SLOT, LANES):
                buffer.spare[plane + lane] = buffer.slots[source + plane]
        add_slot(buffer.light, group * LIGHT, buffer.spare, 0, final, cover)


@inner
def _keep(buffer, group, limit):
    """Move the sorted fragments beyond the limit to the beginning, in order, each lane by itself."""
    base, most = group * buffer.capacity, 0
    for lane in range(LANES):
        left = 0
        for row in range(buffer.filled[group * LANES + lane]):
            if buffer.keys[(base + row) * LANES + lane] > limit:
                _fetch(buffer, group, row, lane, left)
                left += 1
        buffer.filled[group * LANES + lane] = left
        most = max(most, left)
    for row in range(most):
        for plane in range(0, SLOT, LANES):
            store(buffer.slots, (base + row) * SLOT + plane, load(buffer.spare, row * SLOT + plane))
        store(buffer.keys, (base + row) * LANES, load(buffer.spare, row * SLOT))
        store(buffer.places, (base + row) * LANES, splat(np.float32(row)))
    buffer.counts[group] = most


@inner
def _has_room(buffer, group, limit, cover):
    """Return whether a group has room for a layer, having composited what is final if that makes much of it."""
    if buffer.counts[group] < buffer.capacity:
        return True
    count = _fullest(buffer, group)
    _close_keys(buffer, group, count)
    if 4 * _final(buffer, group, count, limit) < _held(buffer, group) and 2 * count > buffer.capacity:
        return False
    _flush(buffer, group, count, limit, cover)
    _keep(buffer, group, limit)
    return 4 * buffer.counts[group] <= 3 * buffer.capacity


@inner
def _gather(segments, q, local, group, square, buffer):
    """Append one segment's fragments; return the bits of the pixels that have one."""
    if misses(local, group):
        return 0
    key, shape, t, hit = fragments(local, group, square)
    bits = mask_bits(hit)
    if bits:
        opacity, red, green, blue = colored(segments, q, local, key, t, square)
        base, place = group * buffer.capacity, buffer.counts[group]
        slot = (base + place) * SLOT
        store_slot(buffer.slots, slot, key, alpha_of(opacity, shape), red, green, blue)
        for lane in range(LANES):
            row = buffer.filled[group * LANES + lane]
            buffer.keys[(base + row) * LANES + lane] = buffer.slots[slot + lane]
            buffer.places[(base + row) * LANES + lane] = place
            buffer.filled[group * LANES + lane] = row + (bits >> lane & 1)
        buffer.counts[group] = place + 1
    return bits


@inner
def _gather_tile(segments, tiles, k, place, overflowed, buffer, cover):
    """Gather from a place in the tile's list on; return the place where a group has no room, or the end, and the fragments."""
    left, top = tile_corner(tiles, k)
    stop, total = tiles.starts[k + 1], 0
    while place < stop:
        fetch(segments, tiles.members[min(place + AHEAD, stop - 1)])
        q = tiles.members[place]
        local = localize(segments, q, left + 0.5, top + 0.5)
        first, last = groups_touched(local)
        for group in range(first, last + 1):
            if not _has_room(buffer, group, local.nearest, cover):
                return place, total
        for group in range(first, last + 1):
            if overflowed[k * GROUPS + group] and not (cover is not None and hides(cover.layers, k, group, local.nearest)):
                total += count_bits(_gather(segments, q, local, group, tiles.perspective, buffer) & buffer.inside[group])
        place += 1
    return place, total


@inner
def _finish_tile(tiles, k, overflowed, buffer, pixels, cover):
    """Composite all that is left of a tile's groups and write the film."""
    left, top = tile_corner(tiles, k)
    for group in range(GROUPS):
        if overflowed[k * GROUPS + group]:
            count = _fullest(buffer, group)
            _close_keys(buffer, group, count)
            _flush(buffer, group, count, EMPTY, cover)
            write_pixels(buffer.light, group * LIGHT, pixels, left, top + GROUP_HEIGHT * group, buffer.inside[group], cover)


@compiled
def render_deep(segments, tiles, numbers, at, place, finish, overflowed, buffer, pixels, cover):
    """Render the overflowed groups of the tiles `numbers`, from its place `at` on, sorting all their fragments.

    The first is gone on with at a place in its list. Of a tile whose segments come in slabs, `finish` says that these are the
    last. `cover` holds the layers of polygons, or is None. Return where a larger buffer is needed to go on, as (at, place), and
    the number of fragments up to there.
    """
    total = 0
    while at < len(numbers):
        k = numbers[at]
        if place == BEGIN:
            _begin_tile(tiles, k, buffer, cover)
            place = tiles.starts[k]
        place, more = _gather_tile(segments, tiles, k, place, overflowed, buffer, cover)
        total += more
        if place < tiles.starts[k + 1]:
            return at, place, total
        if finish:
            _finish_tile(tiles, k, overflowed, buffer, pixels, cover)
        at, place = at + 1, BEGIN
    return at, place, total
