"""Groups whose pending list overflowed: gather every pixel's fragments and sort them.

A pixel's fragments are kept as 64-bit words, the key's bits (so flipped that they order as
the floats do) above the place in the buffer, which follows rank. When a buffer is full, it is sorted, what
is final is composited, and the rest stays; a buffer that stays more than half full is doubled. So memory
follows the number of fragments that are pending at one time, not the number there are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled, mask_bits, store
from graphfx.lanes.bits import count_bits
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.cover import hides, show_next
from graphfx.render.layer import (
    GROUP_HEIGHT,
    GROUPS,
    alpha_of,
    colored,
    fragments,
    groups_touched,
    localize,
)
from graphfx.render.order import merge_sort, ordered_bits, ordered_word
from graphfx.render.pending import LANES, LIGHT, PLANES, clear_light
from graphfx.render.segments import KEY0, KEY1
from graphfx.render.tiles import lanes_inside, tile_corner, write_pixels

FIRST_CAPACITY = 64


class Buffer(NamedTuple):
    """The pending fragments of sixteen pixels: words to sort (16, capacity), values (16, capacity, 4), room, numbers, light."""

    words: np.ndarray
    values: np.ndarray
    spare_words: np.ndarray
    spare_values: np.ndarray
    filled: np.ndarray
    light: np.ndarray
    planes: np.ndarray


@inner
def _flush_lane(words, values, spare_words, spare_values, count, limit, light, at, cover):
    """Composite one pixel's fragments whose ordered key is at most `limit`, nearest first; return how many are left."""
    merge_sort(words, spare_words, count)
    done = 0
    while done < count and words[done] >> np.uint64(32) <= limit:
        place = np.int64(words[done] & np.uint64(0xFFFFFFFF))
        through, opacity = light[at], values[place, 0]
        seen = through * abs(opacity)
        if cover is not None:
            while ordered_bits(cover.due_bits[at]) <= words[done] >> np.uint64(32):
                show_next(cover, at, through, light, at + LANES)
            seen *= cover.means[at]
        for plane in range(3):
            light[at + (plane + 1) * LANES] += seen * values[place, plane + 1]
        light[at] = through - through * max(opacity, np.float32(0.0))
        done += 1
    left = count - done
    for i in range(left):
        place = np.int64(words[done + i] & np.uint64(0xFFFFFFFF))
        spare_words[i] = words[done + i] >> np.uint64(32) << np.uint64(32) | np.uint64(i)
        for plane in range(4):
            spare_values[i, plane] = values[place, plane]
    for i in range(left):
        words[i] = spare_words[i]
        for plane in range(4):
            values[i, plane] = spare_values[i, plane]
    return left


@inner
def _flush(buffer, limit, cover):
    """Composite what is final in all sixteen pixels; return the most that is left in one."""
    most = 0
    for lane in range(LANES):
        buffer.filled[lane] = _flush_lane(
            buffer.words[lane], buffer.values[lane], buffer.spare_words, buffer.spare_values, buffer.filled[lane], limit,
            buffer.light, lane, cover,
        )
        most = max(most, buffer.filled[lane])
    return most


@inner
def _gather(segments, q, local, group, square, buffer):
    """Append one segment's fragments; return the bits of the pixels that have one."""
    planes = buffer.planes
    key, shape, t, hit = fragments(local, group, square)
    opacity, red, green, blue = colored(segments, q, local, key, t, square)
    store(planes, 0, key)
    store(planes, LANES, where(hit, alpha_of(opacity, shape), 0.0))
    store(planes, 2 * LANES, red)
    store(planes, 3 * LANES, green)
    store(planes, 4 * LANES, blue)
    bits, key_bits = mask_bits(hit), planes.view(np.uint32)
    for lane in range(LANES):
        if bits >> lane & 1:
            place = buffer.filled[lane]
            buffer.words[lane, place] = ordered_bits(key_bits[lane]) << np.uint64(32) | np.uint64(place)
            for plane in range(4):
                buffer.values[lane, place, plane] = planes[(plane + 1) * LANES + lane]
            buffer.filled[lane] = place + 1
    return bits


@inner
def _nearest_word(segments, q):
    return ordered_word(min(segments.values[q, KEY0], segments.values[q, KEY1]))


@inner
def _fullest(filled):
    most = 0
    for lane in range(LANES):
        most = max(most, filled[lane])
    return most


@compiled
def new_buffer(capacity):
    """Return room for `capacity` fragments in each of sixteen pixels."""
    light = np.zeros(LIGHT, np.float32)
    clear_light(light, 0)
    return Buffer(
        np.empty((LANES, capacity), np.uint64), np.empty((LANES, capacity, 4), np.float32), np.empty(capacity, np.uint64),
        np.empty((capacity, 4), np.float32), np.zeros(LANES, np.int64), light, np.zeros(PLANES * LANES, np.float32),
    )


@compiled
def _enlarged(buffer):
    """Return a buffer of twice the capacity with the same content."""
    larger = new_buffer(2 * len(buffer.spare_words))
    for i in range(LIGHT):
        larger.light[i] = buffer.light[i]
    for lane in range(LANES):
        larger.filled[lane] = buffer.filled[lane]
        for i in range(buffer.filled[lane]):
            larger.words[lane, i] = buffer.words[lane, i]
            for plane in range(4):
                larger.values[lane, i, plane] = buffer.values[lane, i, plane]
    return larger


@compiled
def render_deep(segments, tiles, number, finish, buffer, pixels, cover):
    """Render one group of one tile, `number` = tile * GROUPS + group, sorting all its fragments.

    Of a tile whose segments come in slabs, `finish` says that these are the last. `cover` holds the layers of
    polygons, begun for this group, or is None. Return the number of fragments and the buffer that goes on.
    """
    k, group = number // GROUPS, number % GROUPS
    left, top = tile_corner(tiles, k)
    stop = tiles.starts[k + 1]
    inside = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
    total = 0
    for place in range(tiles.starts[k], stop):
        q = tiles.members[place]
        local = localize(segments, q, left + 0.5, top + 0.5)
        first, last = groups_touched(local)
        if group < first or group > last:
            continue
        if cover is not None and hides(cover, k, group, local.nearest):
            break
        total += count_bits(_gather(segments, q, local, group, tiles.perspective, buffer) & inside)
        capacity = len(buffer.spare_words)
        if _fullest(buffer.filled) == capacity:
            limit = _nearest_word(segments, tiles.members[min(place + 1, stop - 1)])
            if 2 * _flush(buffer, limit, cover) > capacity:
                buffer = _enlarged(buffer)
    if finish:
        _flush(buffer, np.uint64(0xFFFFFFFF), cover)
        write_pixels(buffer.light, 0, pixels, left, top + GROUP_HEIGHT * group, inside, cover)
    return total, buffer
