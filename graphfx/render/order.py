"""Orders of fragments and segments: by key, equals as they come."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.lanes import compiled, load, store
from graphfx.lanes.bits import prefetch
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.falloff import CURVE
from graphfx.render.pending import LANES
from graphfx.render.segments import BLURRED, JOINED_HEAD, JOINED_TAIL, Segments, empty_segments
from graphfx.store.primitives import GRAIN
from graphfx.store.sorting import stable_argsort
from graphfx.store.threads import parallel_ranges, ranges

AHEAD = 6
"""Segments whose memory is fetched ahead."""


@inner
def ordered_bits(bits):
    """Return a uint32 that orders as the float32 of these bits does."""
    wide = np.uint64(bits)
    return wide ^ np.uint64(0xFFFFFFFF) if wide >> np.uint64(31) else wide | np.uint64(0x80000000)


@inner
def ordered_word(key):
    """Return a uint32 that orders as this float32 does."""
    return ordered_bits(np.float32(key).view(np.uint32))


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
def _exchange(keys, places, i, j):
    """Bring the lanes at i and j, i the first, into order."""
    key, other = load(keys, i), load(keys, j)
    place, there = load(places, i), load(places, j)
    wrong = (other < key) | ((other == key) & (there < place))
    store(keys, i, where(wrong, other, key))
    store(keys, j, where(wrong, key, other))
    store(places, i, where(wrong, there, place))
    store(places, j, where(wrong, place, there))


@inner
def sort_lanes(keys, places, base, count):
    """Sort `count` rows of keys, from `base` on, in each lane, and their places with them; equals by place.

    A network of compare-exchanges. [Knuth, The Art of Computer Programming 3, 5.2.2, algorithm M]
    """
    top = 1
    while 2 * top < count:
        top *= 2
    p = top if count > 1 else 0
    while p > 0:
        q, r, d = top, 0, p
        while True:
            for start in range(r, count - d, 2 * p):
                for i in range(start, min(start + p, count - d)):
                    _exchange(keys, places, base + i * LANES, base + (i + d) * LANES)
            if q == p:
                break
            d, q, r = q - p, q // 2, p
        p //= 2


@inner
def fetch(segments, q):
    """Fetch what a tile needs of segment q into the cache, without waiting for it."""
    prefetch(segments.values, q * 16)
    prefetch(segments.kind, q)
    prefetch(segments.pace, q)
    if len(segments.tails):
        prefetch(segments.tails, q * 4)


@compiled
def _pack(source: Any, order: Any, start: int, stop: int, target: Any) -> None:
    """Copy the segments order[start : stop] to rows start ... stop."""
    for i in range(start, stop):
        row = order[i]
        fetch(source, order[min(i + AHEAD, stop - 1)])
        for c in range(8):
            target.places[i, c] = source.places[row, c]
        target.pace[i] = source.pace[row]
        target.kind[i] = source.kind[row]
        if len(source.particle):
            target.particle[i] = source.particle[row]
        if len(source.tails):
            for c in range(4):
                target.tails[i, c] = source.tails[row, c]
        if source.kind[row] & 3 == CURVE:
            target.curve[i] = source.curve[row]
        if source.kind[row] & BLURRED:
            for c in range(4):
                target.focus[i, c] = source.focus[row, c]
        if source.kind[row] & (JOINED_HEAD | JOINED_TAIL):
            for c in range(4):
                target.joints[i, c] = source.joints[row, c]


def ordered(segments: Segments, rows: np.ndarray, threads: int) -> Segments:
    """Return the segments of `rows`, nearest first; equals stay in the order of stream and particle."""
    order = rows[stable_argsort(segments.nearest[rows], threads)]
    packed = empty_segments(len(rows), segments.extras)
    bounds = ranges(len(rows), threads, GRAIN)
    parallel_ranges(lambda _, start, stop: _pack(segments, order, start, stop, packed), bounds, threads)
    return packed
