"""The pending fragments of a group of sixteen pixels: a short list of slots, each pixel's lane in order of depth.

A slot is five planes of sixteen lanes: key, opacity, red, green, blue. An empty lane has the key
infinity and stands behind all others; its other planes mean nothing. Segments come in the order of their nearest depth, so a
fragment whose key is not beyond the nearest key of the segment at hand is final: it can be composited,

    w = T |a|,   C += w c,   T -= T max(a, 0)        a < 0: the blend is `add`, which hides nothing

one pixel after the other from front to back, a left-to-right sum.
"""

from __future__ import annotations

import numpy as np

from graphfx.lanes import any_lane, load, mask_bits, mask_from_bits, splat, store
from graphfx.lanes.inner import inner
from graphfx.math.primitives import absolute, maximum, where

LANES = 16
PLANES = 5
SLOT = PLANES * LANES
CAPACITY = 48
"""Slots of a list; a group that needs more is sorted whole instead."""
LIST = (CAPACITY + 2) * SLOT + 2 * LANES
"""Floats from one group's list to the next: one slot to append, one for the empty end, and a shift in the cache."""
LIGHT = 4 * LANES
"""Floats of a group's transmittance, red, green and blue."""
PATIENCE = 3
"""Slots that may wait for their last lanes before single lanes are composited."""
ALL = 0xFFFF
EMPTY = np.float32(np.inf)


@inner
def clear_light(light, at):
    """Set a group's light: nothing seen yet, all let through."""
    store(light, at, splat(np.float32(1.0)))
    for plane in range(1, 4):
        store(light, at + plane * LANES, splat(np.float32(0.0)))


@inner
def add_layer(light, at, opacity, red, green, blue):
    """Composite one fragment a lane behind what is there."""
    through = load(light, at)
    seen = through * absolute(opacity)
    store(light, at + LANES, load(light, at + LANES) + seen * red)
    store(light, at + 2 * LANES, load(light, at + 2 * LANES) + seen * green)
    store(light, at + 3 * LANES, load(light, at + 3 * LANES) + seen * blue)
    store(light, at, through - through * maximum(opacity, 0.0))


@inner
def add_slot(light, at, slots, slot, chosen):
    """Composite the chosen lanes of a slot."""
    opacity = where(chosen, load(slots, slot + LANES), 0.0)
    add_layer(light, at, opacity, load(slots, slot + 2 * LANES), load(slots, slot + 3 * LANES), load(slots, slot + 4 * LANES))


@inner
def release(light, at, slots, base, count, nearest):
    """Composite what is final from the head of a list; return the slots used up and the bits of lanes used up in the next."""
    first = 0
    while first < count:
        key = load(slots, base + first * SLOT)
        final = key <= nearest
        bits = mask_bits(final)
        if mask_bits(final | (key == EMPTY)) != ALL:
            if bits != 0 and count - first >= PATIENCE:
                add_slot(light, at, slots, base + first * SLOT, final)
                return first, bits
            return first, 0
        add_slot(light, at, slots, base + first * SLOT, final)
        first += 1
    return first, 0


@inner
def insert(slots, base, first, count, used, key, opacity, red, green, blue):
    """Insert one fragment a lane by compare-exchange; return the new number of slots.

    Slots before `first` are gone, and so are the lanes `used` of slot `first`: the rest moves up as the
    insertion passes over it. Among equal keys the new fragment, the later in rank, goes behind.
    """
    gone = mask_from_bits(used)
    moved = mask_from_bits(0)
    source, place = base + first * SLOT, base
    key_here, opacity_here = load(slots, source), load(slots, source + LANES)
    red_here, green_here = load(slots, source + 2 * LANES), load(slots, source + 3 * LANES)
    blue_here = load(slots, source + 4 * LANES)
    for _ in range(first, count):
        source += SLOT
        key_next, opacity_next = load(slots, source), load(slots, source + LANES)
        red_next, green_next = load(slots, source + 2 * LANES), load(slots, source + 3 * LANES)
        blue_next = load(slots, source + 4 * LANES)
        key_old, opacity_old = where(gone, key_next, key_here), where(gone, opacity_next, opacity_here)
        red_old, green_old = where(gone, red_next, red_here), where(gone, green_next, green_here)
        blue_old = where(gone, blue_next, blue_here)
        moved = moved | (key < key_old)
        store(slots, place, where(moved, key, key_old))
        store(slots, place + LANES, where(moved, opacity, opacity_old))
        store(slots, place + 2 * LANES, where(moved, red, red_old))
        store(slots, place + 3 * LANES, where(moved, green, green_old))
        store(slots, place + 4 * LANES, where(moved, blue, blue_old))
        key, opacity = where(moved, key_old, key), where(moved, opacity_old, opacity)
        red, green, blue = where(moved, red_old, red), where(moved, green_old, green), where(moved, blue_old, blue)
        key_here, opacity_here, red_here, green_here, blue_here = key_next, opacity_next, red_next, green_next, blue_next
        place += SLOT
    left = count - first
    if any_lane(key < EMPTY):
        store(slots, place, key)
        store(slots, place + LANES, opacity)
        store(slots, place + 2 * LANES, red)
        store(slots, place + 3 * LANES, green)
        store(slots, place + 4 * LANES, blue)
        store(slots, place + SLOT, splat(EMPTY))
        return left + 1
    store(slots, place, splat(EMPTY))
    if left > 0 and not any_lane(load(slots, place - SLOT) < EMPTY):
        left -= 1
    return left
