"""Data-parallel primitives over columns: scan, segmented scan, gather, partition.

Any number of threads gives the same bytes: no result is summed across a border between threads.
[Hillis and Steele 1986; Sims 1990, section 4]
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from graphfx.lanes.compile import compiled
from graphfx.store.threads import parallel_ranges, ranges

GRAIN = 32768
"""Fewest elements worth a thread of their own: about 20 microseconds of work."""
UNSIGNED: dict[int, Any] = {1: np.uint8, 2: np.uint16, 4: np.uint32, 8: np.uint64}
"""Moving elements needs only their size, so kernels are compiled for these."""


@compiled
def _sum_before(values: Any, result: Any) -> Any:
    total = np.int64(0)
    for i in range(len(values)):
        result[i] = total
        total += np.int64(values[i])
    return total


def exclusive_scan(values: np.ndarray) -> np.ndarray:
    """Return, as int64, for each element the sum of all before it: [a, b, c] gives [0, a, a + b]."""
    return offsets(values)[:-1]


def offsets(counts: np.ndarray) -> np.ndarray:
    """Return where each group starts and the last ends, as int64: [a, b] gives [0, a, a + b]."""
    counts = np.ascontiguousarray(counts)
    if counts.dtype.kind not in "biu":
        raise TypeError(f"a scan sums integers, not {counts.dtype}: the order of a float sum would matter")
    result = np.empty(len(counts) + 1, np.int64)
    result[-1] = _sum_before(counts, result[:-1])
    return result


@compiled
def _scan_segments(
    values: Any, starts: Any, bounds: tuple[int, int], multiply: bool, exclusive: bool, result: Any
) -> None:
    identity = values.dtype.type(1) if multiply else values.dtype.type(0)
    for segment in range(bounds[0], bounds[1]):
        start = starts[segment]
        stop = starts[segment + 1] if segment + 1 < len(starts) else len(values)
        total = identity
        for i in range(start, stop):
            if exclusive:
                result[i] = total
            if i == start:
                total = values[i]
            elif multiply:
                total = total * values[i]
            else:
                total = total + values[i]
            if not exclusive:
                result[i] = total


def segmented_scan(
    values: np.ndarray, starts: np.ndarray, operation: str = "add", exclusive: bool = False, threads: int = 1
) -> np.ndarray:
    """Return running sums or products that begin anew at each segment.

        inclusive: r[i] = v[start] op ... op v[i]        exclusive: r[i] = v[start] op ... op v[i - 1]

    folded from left to right, exactly in that order, in the precision of `values` (integers as
    int64). The first of a segment is v[start], or the identity 0 or 1 when exclusive. `starts` are
    the segments' first rows, ascending, the first 0; equal ones are empty segments, so the result
    of `offsets` will do, and so will `partition(flags)`. `operation` is "add" or "multiply".
    """
    if operation not in ("add", "multiply"):
        raise ValueError(f"operation is '{operation}'; it can be 'add' or 'multiply'")
    values = np.ascontiguousarray(values)
    if values.dtype not in (np.float32, np.float64):
        values = values.astype(np.int64, casting="same_kind")
    starts = np.ascontiguousarray(starts, np.int64)
    _check_starts(starts, len(values))
    cuts = [stop for _, stop in ranges(len(values), threads, GRAIN)[:-1]]
    borders = [0, *np.searchsorted(starts, cuts).tolist(), len(starts)]
    bounds = list(pairwise(borders))
    result = np.empty_like(values)

    def scan(_piece: int, first: int, last: int) -> None:
        _scan_segments(values, starts, (first, last), operation == "multiply", exclusive, result)

    parallel_ranges(scan, bounds, threads)
    return result


def _check_starts(starts: np.ndarray, count: int) -> None:
    if count and (not len(starts) or starts[0] != 0):
        raise ValueError("the first segment must start at 0")
    if len(starts) and (starts[0] < 0 or starts[-1] > count or (starts[1:] < starts[:-1]).any()):
        raise ValueError(f"segment starts must ascend from 0 to at most {count}")


@compiled
def _gather(values: Any, rows: Any, start: int, stop: int, result: Any) -> bool:
    """Copy values[rows[i]]; skip rows that do not exist, and return whether all do."""
    sound = True
    count = np.uint64(len(values))
    for i in range(start, stop):
        row = np.uint64(rows[i])  # a negative row becomes a huge one
        if row >= count:
            sound = False
        else:
            result[i] = values[row]
    return sound


def gather(
    values: np.ndarray, rows: np.ndarray, out: np.ndarray | None = None, threads: int = 1
) -> np.ndarray:
    """Return values[rows], in `out` if given (it must not overlap `values`); elements of 1, 2, 4 or 8 bytes.

    A row that does not exist, a negative one too, raises IndexError.
    """
    rows = np.ascontiguousarray(rows)
    if rows.dtype not in (np.int64, np.uint32):
        rows = rows.astype(np.int64, casting="same_kind") if len(rows) else np.empty(0, np.int64)
    result = np.empty(len(rows), values.dtype) if out is None else out
    if result.shape != rows.shape or result.dtype != values.dtype:
        raise ValueError(f"out must hold {len(rows)} elements of {values.dtype}")
    unsigned = UNSIGNED[values.dtype.itemsize]
    source, target = np.ascontiguousarray(values).view(unsigned), result.view(unsigned)
    bounds = ranges(len(rows), threads, GRAIN)
    sound = [True] * len(bounds)

    def copy(piece: int, start: int, stop: int) -> None:
        sound[piece] = _gather(source, rows, start, stop, target)

    parallel_ranges(copy, bounds, threads)
    if not all(sound):
        raise IndexError(f"a row is not in 0 to {len(values) - 1}")
    return result


def partition(mask: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows whose mask (bool or uint8) is not 0, ascending, as int64."""
    if mask.dtype not in (np.bool_, np.uint8):
        raise TypeError(f"a mask is bool or uint8, not {mask.dtype}")
    return np.flatnonzero(mask if mask.dtype == np.bool_ else mask != 0)
