"""The pending fragments of a group of sixteen pixels: a short list of slots, each pixel's lane in order of depth.

A slot is five planes of sixteen lanes: key, opacity, red, green, blue. An empty lane has the key
infinity and stands behind all others; its other planes mean nothing. Segments come in the order of their nearest depth, so a
fragment whose key is not beyond the nearest key of the segment at hand is final: it can be composited,

    w = T |a|,   C += w c,   T -= T max(a, 0)        a < 0: the blend is `add`, which hides nothing

one pixel after the other from front to back, a left-to-right sum. Polygons come between, see cover.py: `cover` is None
where there are none, and costs nothing then.
"""

from __future__ import annotations

import numpy as np

from graphfx.lanes import any_lane, load, mask_bits, splat, store
from graphfx.lanes.inner import inner
from graphfx.math.primitives import absolute, maximum, where
from graphfx.render.cover import show_before

LANES = 16
PLANES = 5
SLOT = PLANES * LANES
CAPACITY = 48
"""Slots of a list; a group that needs more is sorted whole instead."""
DRIFT = 2
"""Slots at the head of a list that may be used up before the others are moved to its beginning."""
LIST = (CAPACITY + DRIFT + 1) * SLOT + 2 * LANES
"""Floats from one group's list to the next: one slot to append, and a shift in the cache."""
LIGHT = 4 * LANES
"""Floats of a group's transmittance, red, green and blue."""
PATIENCE = 3
"""Slots that may wait for their last lanes before single lanes are composited."""
UNASKED = 3
"""Slots that a fragment is compared with before it is asked whether it has found its place: a branch that cannot be foreseen
costs more."""
ALL = 0xFFFF
EMPTY = np.float32(np.inf)


@inner
def clear_light(light, at):
    """Set a group's light: nothing seen yet, all let through."""
    store(light, at, splat(np.float32(1.0)))
    for plane in range(1, 4):
        store(light, at + plane * LANES, splat(np.float32(0.0)))


@inner
def add_layer(light, at, opacity, red, green, blue, cover):
    """Composite one fragment a lane behind what is there."""
    through = load(light, at)
    seen = through * absolute(opacity)
    if cover is not None:
        seen = seen * load(cover.means, at // LIGHT * LANES)
    store(light, at + LANES, load(light, at + LANES) + seen * red)
    store(light, at + 2 * LANES, load(light, at + 2 * LANES) + seen * green)
    store(light, at + 3 * LANES, load(light, at + 3 * LANES) + seen * blue)
    store(light, at, through - through * maximum(opacity, 0.0))


@inner
def add_slot(light, at, slots, slot, chosen, cover):
    """Composite the chosen lanes of a slot."""
    if cover is not None:
        show_before(cover, at // LIGHT * LANES, light, at, slots, slot, chosen)
    opacity, red = where(chosen, load(slots, slot + LANES), 0.0), load(slots, slot + 2 * LANES)
    add_layer(light, at, opacity, red, load(slots, slot + 3 * LANES), load(slots, slot + 4 * LANES), cover)


@inner
def _drop_lanes(slots, base, first, count, gone):
    """Move the lanes `gone` of all slots up by one; return the new number of slots."""
    for k in range(first, first + count - 1):
        here, there = base + k * SLOT, base + (k + 1) * SLOT
        for plane in range(PLANES):
            at = plane * LANES
            store(slots, here + at, where(gone, load(slots, there + at), load(slots, here + at)))
    last = base + (first + count - 1) * SLOT
    key = where(gone, EMPTY, load(slots, last))
    store(slots, last, key)
    return count if any_lane(key < EMPTY) else count - 1


@inner
def release(light, at, slots, base, first, count, nearest, cover):
    """Composite what is final from the head of a list; return the first slot and the number of slots that are left."""
    while count > 0:
        key = load(slots, base + first * SLOT)
        final = key <= nearest
        if mask_bits(final | (key == EMPTY)) != ALL:
            if count >= PATIENCE and any_lane(final):
                add_slot(light, at, slots, base + first * SLOT, final, cover)
                return first, _drop_lanes(slots, base, first, count, final)
            return first, count
        add_slot(light, at, slots, base + first * SLOT, final, cover)
        first += 1
        count -= 1
    return 0, 0


@inner
def to_front(slots, base, first, count):
    """Move the slots of a list to its beginning."""
    for k in range(count):
        for plane in range(PLANES):
            store(slots, base + k * SLOT + plane * LANES, load(slots, base + (first + k) * SLOT + plane * LANES))


@inner
def store_slot(slots, place, key, opacity, red, green, blue):
    """Write a slot."""
    store(slots, place, key)
    store(slots, place + LANES, opacity)
    store(slots, place + 2 * LANES, red)
    store(slots, place + 3 * LANES, green)
    store(slots, place + 4 * LANES, blue)


@inner
def insert(slots, base, first, count, key, opacity, red, green, blue):
    """Insert one fragment a lane, from the back, by compare-exchange; return the new number of slots.

    Among equal keys the new fragment, the later in rank, goes behind.
    """
    place = base + (first + count) * SLOT
    back, begin = place, base + first * SLOT
    asked = back - UNASKED * SLOT
    while place > begin:
        before = place - SLOT
        key_there = load(slots, before)
        sooner = key < key_there
        if place <= asked and not any_lane(sooner):
            break
        store_slot(
            slots, place, where(sooner, key_there, key), where(sooner, load(slots, before + LANES), opacity),
            where(sooner, load(slots, before + 2 * LANES), red), where(sooner, load(slots, before + 3 * LANES), green),
            where(sooner, load(slots, before + 4 * LANES), blue),
        )
        key, opacity = where(sooner, key, key_there), where(sooner, opacity, load(slots, before + LANES))
        red = where(sooner, red, load(slots, before + 2 * LANES))
        green = where(sooner, green, load(slots, before + 3 * LANES))
        blue = where(sooner, blue, load(slots, before + 4 * LANES))
        place = before
    store_slot(slots, place, key, opacity, red, green, blue)
    return count + 1 if any_lane(load(slots, back) < EMPTY) else count
