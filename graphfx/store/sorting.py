"""Stable sorting by radix, least digit first.

Each pass counts the digits of a range of elements per thread, sums the counts in the order
(digit, range), and moves every element to its place. A stable order is unique, so any number of
threads gives the same bytes. Bits in which no two keys differ cost nothing.
[Knuth, The Art of Computer Programming 3, 5.2.5; Zagha and Blelloch 1991 for the parallel passes]
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from graphfx.lanes.compile import compiled
from graphfx.store.primitives import UNSIGNED, exclusive_scan
from graphfx.store.threads import parallel_ranges, ranges

DIGIT_BITS = 8
"""Bits of a digit. Four passes that write to 256 places are faster than three that write to 2048."""
GRAIN = 131072
"""Fewest keys worth a thread of their own: a sort brings the threads together some ten times."""
SMALL = 2048
"""Up to this many keys NumPy's merge sort is faster; the stable order is the same."""
HALF = np.uint64(32)
LOW_HALF = np.uint64(0xFFFFFFFF)


@compiled
def _order_words(bits: Any, start: int, stop: int, result: Any) -> None:
    """Turn the bits of floats into words that sort as the floats do.

    Negative: all bits flipped; positive: the sign bit set. -0 becomes +0, and every NaN the
    greatest word. Denormal numbers are bits like any others.
    """
    word = bits.dtype.type
    size = word(8 * bits.itemsize - 1)
    sign = word(1) << size
    infinity = word(0x7F800000) if bits.itemsize == 4 else word(0x7FF0000000000000)
    for i in range(start, stop):
        magnitude = bits[i] & ~sign
        negative = bits[i] >> size != word(0) and magnitude != word(0)
        ordered = ~bits[i] if negative else magnitude | sign
        result[i] = ~word(0) if magnitude > infinity else ordered


@compiled
def _varying_bits(words: Any, start: int, stop: int) -> Any:
    varying = words.dtype.type(0)
    for i in range(start, stop):
        varying |= words[i] ^ words[0]
    return varying


@compiled
def _load_halves(words: Any, half: Any, first: bool, start: int, stop: int, pairs: Any) -> None:
    """Set pairs to (32 bits of the key, row); `first` numbers the rows, later calls keep their order."""
    for i in range(start, stop):
        row = np.uint64(i) if first else pairs[i] & LOW_HALF
        pairs[i] = ((np.uint64(words[row]) >> half) & LOW_HALF) << HALF | row


@compiled
def _count_digits(pairs: Any, shift: Any, mask: Any, start: int, stop: int, counts: Any) -> None:
    for i in range(start, stop):
        counts[(pairs[i] >> shift) & mask] += 1


@compiled
def _scatter(pairs: Any, shift: Any, mask: Any, start: int, stop: int, places: Any, target: Any) -> None:
    """Move each pair to its digit's next place; a target of uint32 keeps only the rows."""
    for i in range(start, stop):
        digit = (pairs[i] >> shift) & mask
        place = places[digit]
        target[np.uint64(place)] = pairs[i]
        places[digit] = place + 1


def stable_argsort(keys: np.ndarray, threads: int = 1) -> np.ndarray:
    """Return the rows of float32 or float64 keys in ascending order, as uint32.

    Equal keys stay in the order of their rows; -0 equals +0; NaN of any kind come last.
    """
    if keys.dtype not in (np.float32, np.float64):
        raise TypeError(f"keys are float32 or float64, not {keys.dtype}")
    bits = np.ascontiguousarray(keys).view(UNSIGNED[keys.dtype.itemsize])
    words = np.empty_like(bits)
    bounds = ranges(len(keys), threads, GRAIN)
    parallel_ranges(lambda _piece, start, stop: _order_words(bits, start, stop, words), bounds, threads)
    return stable_argsort_words(words, threads)


def stable_argsort_words(words: np.ndarray, threads: int = 1) -> np.ndarray:
    """Return the rows of uint32 or uint64 keys in ascending order, as uint32; equal keys keep their order."""
    if words.dtype not in (np.uint32, np.uint64):
        raise TypeError(f"words are uint32 or uint64, not {words.dtype}")
    if len(words) > LOW_HALF:
        raise ValueError(f"{len(words)} rows are more than uint32 can number")
    if len(words) <= SMALL:
        return np.argsort(words, kind="stable").astype(np.uint32)
    return _Sort(np.ascontiguousarray(words), threads).rows()


class _Sort:
    """One sort: the keys' words, and ranges of them for the threads."""

    def __init__(self, words: np.ndarray, threads: int) -> None:
        self.words = words
        self.threads = threads
        self.bounds = ranges(len(words), threads, GRAIN)

    def rows(self) -> np.ndarray:
        steps = list(_steps(self._varying(), DIGIT_BITS))
        if not steps:
            return np.arange(len(self.words), dtype=np.uint32)
        pairs, spare = np.empty(len(self.words), np.uint64), np.empty(len(self.words), np.uint64)
        rows = np.empty(len(self.words), np.uint32)
        for number, (half, load, shift, bits) in enumerate(steps):
            if load:
                self._load(half, number == 0, pairs)
            target = rows if number == len(steps) - 1 else spare
            self._move(pairs, np.uint64(shift), bits, target)
            pairs, spare = spare, pairs
        return rows

    def _varying(self) -> int:
        found = [0] * len(self.bounds)

        def find(piece: int, start: int, stop: int) -> None:
            found[piece] = int(_varying_bits(self.words, start, stop))

        parallel_ranges(find, self.bounds, self.threads)
        return int(np.bitwise_or.reduce(np.array(found, np.uint64)))

    def _load(self, half: int, first: bool, pairs: np.ndarray) -> None:
        def load(_piece: int, start: int, stop: int) -> None:
            _load_halves(self.words, np.uint64(half), first, start, stop, pairs)

        parallel_ranges(load, self.bounds, self.threads)

    def _move(self, pairs: np.ndarray, shift: np.uint64, bits: int, target: np.ndarray) -> None:
        counts = np.zeros((len(self.bounds), 1 << bits), np.int64)
        mask = np.uint64((1 << bits) - 1)

        def count(piece: int, start: int, stop: int) -> None:
            _count_digits(pairs, shift, mask, start, stop, counts[piece])

        def scatter(piece: int, start: int, stop: int) -> None:
            _scatter(pairs, shift, mask, start, stop, places[piece], target)

        parallel_ranges(count, self.bounds, self.threads)
        places = np.ascontiguousarray(exclusive_scan(counts.T.ravel()).reshape(counts.T.shape).T)
        parallel_ranges(scatter, self.bounds, self.threads)


def _steps(varying: int, digit_bits: int) -> Iterator[tuple[int, bool, int, int]]:
    """Yield the passes that bits `varying` between the keys need: (half of the key, load it, shift, bits)."""
    for half in (0, 32):
        left = varying >> half & 0xFFFFFFFF
        load = True
        while left:
            shift = (left & -left).bit_length() - 1
            window = left >> shift & ((1 << digit_bits) - 1)
            yield half, load, 32 + shift, window.bit_length()
            left &= ~(window << shift)
            load = False
