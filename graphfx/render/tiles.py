"""Render tiles of 8 x 16 pixels: each segment makes layers in the groups that it touches, layers become light.

A group whose pending list overflows is put aside and sorted whole afterwards (deep.py). The order is
the same by either way: (key, place in the tile's list).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled, highest, load, mask_bits
from graphfx.lanes.bits import count_bits
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.cover import begin_pixels, hides, show_rest
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
from graphfx.render.order import AHEAD, fetch
from graphfx.render.pending import (
    CAPACITY,
    DRIFT,
    EMPTY,
    LANES,
    LIGHT,
    LIST,
    SLOT,
    add_slot,
    clear_light,
    insert,
    release,
    to_front,
)
from graphfx.render.segments import lines

OVERFLOWED = -1
"""Slots of a group that is to be sorted whole."""
FORETOLD = 8
"""One of so many tiles in a row is tried; where most of its groups overflow, those of the others are put aside untried."""


class Tiles(NamedTuple):
    """The tiles of a patch, row by row: the segments of tile k are members[starts[k] : starts[k + 1]], nearest first.

    `column` and `row` are those of the patch's first tile in the picture of width x height pixels, `across` its tiles in a row.
    Where all pixels of a group let less than `cutoff` through, what comes further back is left out; at 0 nothing is.
    """

    starts: np.ndarray
    members: np.ndarray
    column: int
    row: int
    across: int
    width: int
    height: int
    perspective: bool
    cutoff: float = 0.0


class Scratch(NamedTuple):
    """One thread's memory: pending slots and light of a tile's groups, and for each group where its list begins, and numbers."""

    slots: np.ndarray
    light: np.ndarray
    firsts: np.ndarray
    counts: np.ndarray
    hits: np.ndarray
    inside: np.ndarray
    closed: np.ndarray


def new_scratch() -> Scratch:
    """Return scratch for one thread."""
    numbers = np.zeros((5, GROUPS), np.int64)
    slots, light = lines(GROUPS * LIST // LANES), lines(GROUPS * LIGHT // LANES)
    slots[:] = 0.0
    return Scratch(slots, light, *numbers)


@inner
def tile_corner(tiles, k):
    """Return the column and row of tile k's first pixel."""
    return (tiles.column + k % tiles.across) * TILE_WIDTH, (tiles.row + k // tiles.across) * TILE_HEIGHT


@inner
def lanes_inside(left, top, width, height):
    """Return the bits of the lanes of a group, its first pixel at (left, top), that lie in the picture."""
    bits = 0
    for lane in range(LANES):
        if left + lane % TILE_WIDTH < width and top + lane // TILE_WIDTH < height:
            bits |= 1 << lane
    return bits


@inner
def _draw(segments, tiles, q, local, group, scratch, cover):
    """Draw one segment in one group, and count its fragments in the picture."""
    if misses(local, group):
        return
    key, shape, t, hit = fragments(local, group, tiles.perspective)
    bits = mask_bits(hit)
    if bits == 0:
        return
    opacity, red, green, blue = colored(segments, q, local, key, t, tiles.perspective)
    base = group * LIST
    first, count = release(
        scratch.light, group * LIGHT, scratch.slots, base, scratch.firsts[group], scratch.counts[group], local.nearest,
        cover,
    )
    if first >= DRIFT:
        to_front(scratch.slots, base, first, count)
        first = 0
    scratch.firsts[group] = first
    if count >= CAPACITY:
        scratch.counts[group] = OVERFLOWED
    else:
        scratch.counts[group] = insert(
            scratch.slots, base, first, count, where(hit, key, EMPTY), where(hit, alpha_of(opacity, shape), 0.0), red, green, blue
        )
    scratch.hits[group] += count_bits(bits & scratch.inside[group])
    if tiles.cutoff > 0.0 and highest(load(scratch.light, group * LIGHT)) < tiles.cutoff:
        scratch.closed[group] = 1


@inner
def write_pixels(light, at, pixels, left, top, inside, cover):
    """Write a group's light to the film, with what polygons are left behind it."""
    if cover is not None:
        show_rest(cover, at // LIGHT * LANES, light, at)
    for lane in range(LANES):
        if inside >> lane & 1:
            y, x = top + lane // TILE_WIDTH, left + lane % TILE_WIDTH
            for plane in range(3):
                pixels[y, x, plane] = light[at + (plane + 1) * LANES + lane]
            through = light[at + lane]
            if cover is not None:
                through *= cover.means[at // LIGHT * LANES + lane]
            pixels[y, x, 3] = np.float32(1.0) - through


@inner
def _finish_tile(tiles, k, scratch, overflowed, pixels, cover):
    """Composite what is pending and write the film; return the fragments of the groups that are done."""
    left, top = tile_corner(tiles, k)
    total = 0
    for group in range(GROUPS):
        if scratch.counts[group] == OVERFLOWED:
            overflowed[k * GROUPS + group] = True
            continue
        for slot in range(scratch.counts[group]):
            at = group * LIST + (scratch.firsts[group] + slot) * SLOT
            add_slot(scratch.light, group * LIGHT, scratch.slots, at, load(scratch.slots, at) < EMPTY, cover)
        write_pixels(scratch.light, group * LIGHT, pixels, left, top + GROUP_HEIGHT * group, scratch.inside[group], cover)
        total += scratch.hits[group]
    return total


@inner
def _begin_tile(tiles, k, scratch, cover):
    """Empty the lists of a tile's groups."""
    left, top = tile_corner(tiles, k)
    for group in range(GROUPS):
        scratch.firsts[group] = scratch.counts[group] = scratch.hits[group] = scratch.closed[group] = 0
        scratch.inside[group] = lanes_inside(left, top + GROUP_HEIGHT * group, tiles.width, tiles.height)
        clear_light(scratch.light, group * LIGHT)
    if cover is not None:
        begin_pixels(cover, k, 0, TILE_WIDTH * TILE_HEIGHT)


@inner
def _all_closed(scratch):
    """Return whether nothing further back is drawn in any group."""
    for group in range(GROUPS):
        if not scratch.closed[group]:
            return False
    return True


@inner
def _most_overflowed(scratch):
    """Return whether most groups of a tile overflowed."""
    count = 0
    for group in range(GROUPS):
        count += scratch.counts[group] == OVERFLOWED
    return 2 * count > GROUPS


@compiled
def render_tiles(segments, tiles, start, stop, begin, finish, scratch, overflowed, pixels, cover):
    """Render tiles start ... stop - 1 into the film and mark groups that overflowed; return the number of fragments.

    Of a tile whose segments come in slabs, `begin` says that these are the first, `finish` that they are the last.
    `cover` holds the layers of polygons; None is compiled to what knows of none.
    """
    total, crowded = 0, False
    for k in range(start, stop):
        if crowded and k % FORETOLD:
            overflowed[k * GROUPS : (k + 1) * GROUPS] = True
            continue
        left, top = tile_corner(tiles, k)
        if begin:
            _begin_tile(tiles, k, scratch, cover)
        last_place = tiles.starts[k + 1] - 1
        for place in range(tiles.starts[k], last_place + 1):
            if tiles.cutoff > 0.0 and _all_closed(scratch):
                break
            fetch(segments, tiles.members[min(place + AHEAD, last_place)])
            q = tiles.members[place]
            local = localize(segments, q, left + 0.5, top + 0.5)
            first, last = groups_touched(local)
            for group in range(first, last + 1):
                if cover is not None and hides(cover.layers, k, group, local.nearest):
                    continue
                if scratch.counts[group] != OVERFLOWED and not scratch.closed[group]:
                    _draw(segments, tiles, q, local, group, scratch, cover)
        if finish:
            total += _finish_tile(tiles, k, scratch, overflowed, pixels, cover)
            crowded = tiles.cutoff == 0.0 and _most_overflowed(scratch)
    return total
