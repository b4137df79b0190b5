"""Groups whose pending list overflowed: gather every pixel's fragments and sort them.

A buffer holds layers of sixteen lanes as they come. When it is full, every lane is sorted by (key, place in the buffer),
all sixteen at once: a network of compare-exchanges moves keys and places alone. What is final is composited, and the rest stays;
a buffer that would stay nearly full is doubled. So memory follows the number of fragments that are pending at one time,
not the number there are. [Knuth, The Art of Computer Programming 3, 5.2.2, algorithm M]
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphfx.lanes import any_lane, compiled, load, mask_bits, mask_from_bits, splat, store
from graphfx.lanes.bits import count_bits
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.cover import hides
from graphfx.render.layer import GROUP_HEIGHT, GROUPS, alpha_of, colored, fragments, groups_touched, localize
from graphfx.render.order import AHEAD, fetch
from graphfx.render.pending import EMPTY, LANES, LIGHT, SLOT, add_slot, clear_light, store_slot
from graphfx.render.segments import KEY0, KEY1
from graphfx.render.tiles import lanes_inside, tile_corner, write_pixels

FIRST_CAPACITY = 128


class Buffer(NamedTuple):
    """The fragments of sixteen pixels that are pending, and their light.

    `slots` are as in pending.py, but each lane is filled by itself: `filled` tells how far. `keys` and `places` are planes of
    sixteen lanes: what is sorted, and the slots that it is of. `spare` is room for as many slots.
    """

    slots: np.ndarray
    keys: np.ndarray
    places: np.ndarray
    spare: np.ndarray
    light: np.ndarray
    filled: np.ndarray


@compiled
def new_buffer(capacity):
    """Return room for `capacity` fragments in each of sixteen pixels."""
    light = np.zeros(LIGHT, np.float32)
    clear_light(light, 0)
    return Buffer(
        np.zeros(capacity * SLOT, np.float32), np.empty(capacity * LANES, np.float32), np.empty(capacity * LANES, np.float32),
        np.zeros(capacity * SLOT, np.float32), light, np.zeros(LANES, np.int64),
    )


@compiled
def clear_buffer(buffer):
    """Make a buffer ready for another group."""
    clear_light(buffer.light, 0)
    for lane in range(LANES):
        buffer.filled[lane] = 0


@compiled
def _enlarged(buffer):
    """Return a buffer of twice the capacity with the same content."""
    larger = new_buffer(2 * len(buffer.keys) // LANES)
    for i in range(LIGHT):
        larger.light[i] = buffer.light[i]
    for i in range(len(buffer.slots)):
        larger.slots[i] = buffer.slots[i]
    for lane in range(LANES):
        larger.filled[lane] = buffer.filled[lane]
    return larger


@inner
def _fullest(buffer):
    """Return the greatest number of fragments in a lane."""
    most = 0
    for lane in range(LANES):
        most = max(most, buffer.filled[lane])
    return most


@inner
def _final(buffer, limit):
    """Return how many fragments have a key of at most `limit`."""
    final = 0
    for lane in range(LANES):
        for row in range(buffer.filled[lane]):
            final += buffer.slots[row * SLOT + lane] <= limit
    return final


@inner
def _set_keys(buffer, count):
    """Write the keys and places of the first slots, to be sorted."""
    for row in range(count):
        key = load(buffer.slots, row * SLOT)
        bits = 0
        for lane in range(LANES):
            bits |= (row < buffer.filled[lane]) << lane
        store(buffer.keys, row * LANES, where(mask_from_bits(bits), key, EMPTY))
        store(buffer.places, row * LANES, splat(np.float32(row)))


@inner
def _exchange(keys, places, i, j):
    """Bring the lanes of rows i < j into order."""
    key, other = load(keys, i * LANES), load(keys, j * LANES)
    place, there = load(places, i * LANES), load(places, j * LANES)
    wrong = (other < key) | ((other == key) & (there < place))
    store(keys, i * LANES, where(wrong, other, key))
    store(keys, j * LANES, where(wrong, key, other))
    store(places, i * LANES, where(wrong, there, place))
    store(places, j * LANES, where(wrong, place, there))


@inner
def sort_lanes(keys, places, count):
    """Sort `count` rows of keys in each lane, and their places with them; equals by place."""
    top = 1
    while 2 * top < count:
        top *= 2
    p = top if count > 1 else 0
    while p > 0:
        q, r, d = top, 0, p
        while True:
            for i in range(count - d):
                if i & p == r:
                    _exchange(keys, places, i, i + d)
            if q == p:
                break
            d, q, r = q - p, q // 2, p
        p //= 2


@inner
def _fetch(buffer, row, lane, at):
    """Copy the fragment that is `row` in the order of a lane to the spare slot `at`."""
    source = int(buffer.places[row * LANES + lane]) * SLOT + lane
    for plane in range(0, SLOT, LANES):
        buffer.spare[at * SLOT + plane + lane] = buffer.slots[source + plane]


@inner
def _flush(buffer, limit, cover):
    """Sort, composite what has a key of at most `limit`, and keep the rest."""
    count = _fullest(buffer)
    _set_keys(buffer, count)
    sort_lanes(buffer.keys, buffer.places, count)
    done = 0
    while done < count:
        key = load(buffer.keys, done * LANES)
        final = (key <= limit) & (key < EMPTY)
        if not any_lane(final):
            break
        for lane in range(LANES):
            _fetch(buffer, done, lane, 0)
        add_slot(buffer.light, 0, buffer.spare, 0, final, cover)
        done += 1
    for lane in range(LANES):
        _keep(buffer, lane, limit)
    for i in range(_fullest(buffer) * SLOT):
        buffer.slots[i] = buffer.spare[i]


@inner
def _keep(buffer, lane, limit):
    """Move the fragments of a lane that are beyond the limit to its beginning, in order."""
    left = 0
    for row in range(buffer.filled[lane]):
        if buffer.keys[row * LANES + lane] > limit:
            _fetch(buffer, row, lane, left)
            left += 1
    buffer.filled[lane] = left


@inner
def _gather(segments, q, local, group, square, buffer):
    """Append one segment's fragments; return the bits of the pixels that have one."""
    key, shape, t, hit = fragments(local, group, square)
    bits = mask_bits(hit)
    if bits:
        opacity, red, green, blue = colored(segments, q, local, key, t, square)
        store_slot(buffer.spare, 0, key, alpha_of(opacity, shape), red, green, blue)
        for lane in range(LANES):
            if bits >> lane & 1:
                row = buffer.filled[lane]
                for plane in range(0, SLOT, LANES):
                    buffer.slots[row * SLOT + plane + lane] = buffer.spare[plane + lane]
                buffer.filled[lane] = row + 1
    return bits


@compiled
def _fill(segments, tiles, number, place, buffer, cover):
    """Append fragments from a place in the tile's list on until the buffer is full; return the next place, and their number."""
    k, group = number // GROUPS, number % GROUPS
    left, top = tile_corner(tiles, k)
    stop, capacity = tiles.starts[k + 1], len(buffer.keys) // LANES
    inside = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
    most, total = _fullest(buffer), 0
    while place < stop and most < capacity:
        fetch(segments, tiles.members[min(place + AHEAD, stop - 1)])
        q = tiles.members[place]
        place += 1
        local = localize(segments, q, left + 0.5, top + 0.5)
        first, last = groups_touched(local)
        if first <= group <= last:
            if cover is not None and hides(cover.layers, k, group, local.nearest):
                return stop, total
            total += count_bits(_gather(segments, q, local, group, tiles.perspective, buffer) & inside)
            most = _fullest(buffer)
    return place, total


@compiled
def _make_room(segments, q, buffer, cover):
    """Composite what is final as segment q comes, if that is much; return whether the buffer must grow."""
    capacity, limit = len(buffer.keys) // LANES, min(segments.values[q, KEY0], segments.values[q, KEY1])
    if 4 * _final(buffer, limit) > LANES * capacity:
        _flush(buffer, limit, cover)
    return 4 * _fullest(buffer) > 3 * capacity


@compiled
def _finish(tiles, number, buffer, pixels, cover):
    """Composite all that is left of a group and write the film."""
    k, group = number // GROUPS, number % GROUPS
    left, top = tile_corner(tiles, k)
    top += GROUP_HEIGHT * group
    _flush(buffer, EMPTY, cover)
    write_pixels(buffer.light, 0, pixels, left, top, lanes_inside(left, top, tiles.width, tiles.height), cover)


@compiled
def render_deep(segments, tiles, number, finish, buffer, pixels, cover):
    """Render one group of one tile, `number` = tile * GROUPS + group, sorting all its fragments.

    Of a tile whose segments come in slabs, `finish` says that these are the last. `cover` holds the layers of
    polygons, begun for this group, or is None. Return the number of fragments and the buffer that goes on.
    """
    place, stop, total = tiles.starts[number // GROUPS], tiles.starts[number // GROUPS + 1], 0
    while place < stop:
        place, more = _fill(segments, tiles, number, place, buffer, cover)
        total += more
        full = _fullest(buffer) == len(buffer.keys) // LANES
        if full and _make_room(segments, tiles.members[min(place, stop - 1)], buffer, cover):
            buffer = _enlarged(buffer)
    if finish:
        _finish(tiles, number, buffer, pixels, cover)
    return total, buffer
