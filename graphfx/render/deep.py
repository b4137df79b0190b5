"""Groups whose pending list overflowed: gather every pixel's fragments and sort them.

A pixel's fragments are kept as 64-bit words, the key's bits (so flipped that they order as
the floats do) above the place in the buffer, which follows rank. When a buffer is full, it is sorted, what
is final is composited, and the rest stays; a buffer that stays more than half full is doubled. So memory
follows the number of fragments that are pending at one time, not the number there are.
"""

from __future__ import annotations

import numpy as np

from graphfx.lanes import compiled, mask_bits, store
from graphfx.lanes.bits import count_bits
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.layer import (
    GROUP_HEIGHT,
    GROUPS,
    TILE_HEIGHT,
    TILE_WIDTH,
    colored,
    fragments,
    groups_touched,
    localize,
)
from graphfx.render.pending import LANES, clear_light
from graphfx.render.segments import KEY0, KEY1
from graphfx.render.tiles import lanes_inside, write_pixels

FIRST_CAPACITY = 64


@inner
def ordered_bits(bits):
    """Return a uint32 that orders as the float32 of these bits does."""
    wide = np.uint64(bits)
    return wide ^ np.uint64(0xFFFFFFFF) if wide >> np.uint64(31) else wide | np.uint64(0x80000000)


@inner
def merge_sort(words, spare, count):
    """Sort words[:count] upwards; runs that already follow each other are left alone."""
    width = 1
    while width < count:
        for start in range(0, count - width, 2 * width):
            middle, stop = start + width, min(start + 2 * width, count)
            if words[middle - 1] <= words[middle]:
                continue
            for i in range(start, middle):
                spare[i] = words[i]
            left, right, at = start, middle, start
            while left < middle:
                if right < stop and words[right] < spare[left]:
                    words[at] = words[right]
                    right += 1
                else:
                    words[at] = spare[left]
                    left += 1
                at += 1
        width *= 2


@inner
def _flush_lane(words, values, spare_words, spare_values, count, limit, light, at):
    """Composite one pixel's fragments whose ordered key is at most `limit`, nearest first; return how many are left."""
    merge_sort(words, spare_words, count)
    through, red, green, blue = light[at], light[at + LANES], light[at + 2 * LANES], light[at + 3 * LANES]
    done = 0
    while done < count and words[done] >> np.uint64(32) <= limit:
        place = np.int64(words[done] & np.uint64(0xFFFFFFFF))
        opacity = values[place, 0]
        seen = through * abs(opacity)
        red, green, blue = red + seen * values[place, 1], green + seen * values[place, 2], blue + seen * values[place, 3]
        through -= through * max(opacity, np.float32(0.0))
        done += 1
    light[at], light[at + LANES], light[at + 2 * LANES], light[at + 3 * LANES] = through, red, green, blue
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
def _flush(words, values, spare_words, spare_values, filled, limit, light):
    """Composite what is final in all sixteen pixels; return the most that is left in one."""
    most = 0
    for lane in range(LANES):
        filled[lane] = _flush_lane(
            words[lane], values[lane], spare_words, spare_values, filled[lane], limit, light, lane
        )
        most = max(most, filled[lane])
    return most


@inner
def _gather(segments, q, local, group, square, planes, words, values, filled):
    """Append one segment's fragments; return the bits of the pixels that have one."""
    key, shape, t, hit = fragments(local, group, square)
    opacity, red, green, blue = colored(segments, q, local, key, t, square)
    store(planes, 0, key)
    store(planes, LANES, where(hit, opacity * shape, 0.0))
    store(planes, 2 * LANES, red)
    store(planes, 3 * LANES, green)
    store(planes, 4 * LANES, blue)
    bits, key_bits = mask_bits(hit), planes.view(np.uint32)
    for lane in range(LANES):
        if bits >> lane & 1:
            place = filled[lane]
            words[lane, place] = ordered_bits(key_bits[lane]) << np.uint64(32) | np.uint64(place)
            for plane in range(4):
                values[lane, place, plane] = planes[(plane + 1) * LANES + lane]
            filled[lane] = place + 1
    return bits


@inner
def _nearest_word(segments, q, planes):
    planes[0] = min(segments.values[q, KEY0], segments.values[q, KEY1])
    return ordered_bits(planes.view(np.uint32)[0])


@inner
def _copy(words, values, filled, new_words, new_values):
    for lane in range(LANES):
        for i in range(filled[lane]):
            new_words[lane, i] = words[lane, i]
            for plane in range(4):
                new_values[lane, i, plane] = values[lane, i, plane]


@inner
def _fullest(filled):
    most = 0
    for lane in range(LANES):
        most = max(most, filled[lane])
    return most


@compiled
def render_deep(segments, tiles, number, planes, light, filled, pixels):
    """Render one group of one tile, `number` = tile * GROUPS + group, sorting all its fragments; return how many.

    `planes` holds a layer, `light` one group's light, `filled` a zero for each lane.
    """
    k, group = number // GROUPS, number % GROUPS
    left, top, stop = k % tiles.across * TILE_WIDTH, k // tiles.across * TILE_HEIGHT, tiles.starts[k + 1]
    inside = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
    capacity, total = FIRST_CAPACITY, 0
    words, values = np.empty((LANES, capacity), np.uint64), np.empty((LANES, capacity, 4), np.float32)
    spare_words, spare_values = np.empty(capacity, np.uint64), np.empty((capacity, 4), np.float32)
    clear_light(light, 0)
    for place in range(tiles.starts[k], stop):
        q = tiles.members[place]
        local = localize(segments, q, left + 0.5, top + 0.5)
        first, last = groups_touched(local)
        if group < first or group > last:
            continue
        bits = _gather(segments, q, local, group, tiles.perspective, planes, words, values, filled)
        total += count_bits(bits & inside)
        if _fullest(filled) < capacity or place + 1 == stop:
            continue
        limit = _nearest_word(segments, tiles.members[place + 1], planes)
        if 2 * _flush(words, values, spare_words, spare_values, filled, limit, light) > capacity:
            capacity *= 2
            old_words, old_values = words, values
            words, values = np.empty((LANES, capacity), np.uint64), np.empty((LANES, capacity, 4), np.float32)
            _copy(old_words, old_values, filled, words, values)
            spare_words, spare_values = np.empty(capacity, np.uint64), np.empty((capacity, 4), np.float32)
    _flush(words, values, spare_words, spare_values, filled, np.uint64(0xFFFFFFFF), light)
    write_pixels(light, 0, pixels, left, top + GROUP_HEIGHT * group, inside)
    return total
