"""Run an assembled program over the rows of a processor set, on several threads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.machine.assemble import Assembled
from graphfx.machine.loop import DEPTH, MASK_WORDS, run_blocks
from graphfx.machine.transfer import AGE, BLOCK, ID, LINE_BYTES, MASK, REAL, WORD
from graphfx.program import COMPONENTS, Column
from graphfx.store.threads import parallel

NO_ROWS = np.zeros(0, np.int64)
NO_BITS = np.zeros(0, np.uint16)
_KINDS = {np.dtype(np.uint64): ID, np.dtype(np.uint8): MASK, np.dtype(np.int32): WORD}
PIECE = 64
"""Blocks that a thread takes at a time, at most; fewer where there are not enough for all threads."""


@dataclass
class Rows:
    """Which rows run: all `count` in order, or those of `listed`; `excluded` has a bit for each row that does not."""

    count: int
    listed: np.ndarray = field(default_factory=lambda: NO_ROWS)
    excluded: np.ndarray = field(default_factory=lambda: NO_BITS)


def _table(columns: Mapping[str, Column], arrays: Mapping[str, Any], by_place: frozenset[str], made: Assembled) -> np.ndarray:
    lines = []
    for name, column in columns.items():
        parts = arrays[name]
        place = made.place(column)
        for k, part in enumerate(parts):
            kind = _KINDS.get(part.dtype, REAL)
            if name == "age":
                kind = AGE
            lines.append((part.ctypes.data, kind, place + k * made.lanes, int(name in by_place), COMPONENTS[column.type]))
    return np.array(lines, np.int64).reshape(-1, 5)


def _aligned(values: np.ndarray) -> np.ndarray:
    """Return a copy that begins at a line of the cache, so that no vector of lanes lies across two."""
    room = np.empty(values.nbytes + LINE_BYTES, np.uint8)
    begin = -room.ctypes.data % LINE_BYTES
    copy = room[begin : begin + values.nbytes].view(values.dtype)
    copy[:] = values
    return copy


def run(
    made: Assembled,
    rows: Rows,
    arrays: Mapping[str, tuple[np.ndarray, ...]],
    uniforms: Mapping[int, Any] | None = None,
    by_place: Mapping[str, tuple[np.ndarray, ...]] | None = None,
    now: float = 0.0,
    threads: int = 1,
) -> np.ndarray:
    """Run over rows; return the rows whose lanes were rejected, in order.

    `arrays` gives the component arrays of every column that the program loads or stores, whole blocks
    long; `age` is given by the float64 times of birth, and `now` is the time from which they count.
    `by_place` gives arrays that run along with `rows.listed`. `uniforms` maps id(uniform) to its value.
    """
    program = made.program
    if rows.count == 0:
        return NO_ROWS
    template, masks = made.template.copy(), made.masks.copy()
    for uniform in made.vectors:
        made.set_uniform(template, masks, uniform, (uniforms or {})[id(uniform)])
    arrays = {**arrays, **(by_place or {})}
    along = frozenset(by_place or ())
    loads = _table(program.loads, arrays, along, made)
    stores = _table(program.stores, arrays, along, made)
    blocks = (rows.count + BLOCK - 1) // BLOCK
    rejected = np.zeros(blocks * MASK_WORDS if program.rejects else 0, np.uint16)
    rejects = made.place(program.rejects) if program.rejects else -1
    unsigned = np.uint32 if made.precision == 32 else np.uint64
    size = PIECE if threads == 1 else min(PIECE, (blocks + 4 * threads - 1) // (4 * threads))

    def piece(number: int) -> None:
        scratch, own = _aligned(template), masks.copy()
        counts = np.array([number * size, min((number + 1) * size, blocks), rows.count], np.int64)
        stack = np.zeros(2 * DEPTH, np.int64)
        run_blocks(made.code, loads, stores, scratch, scratch.view(unsigned), own, stack, rows.listed, rows.excluded, rejected,
                   rejects, counts, now)

    parallel(piece, (blocks + size - 1) // size, threads)
    return rows_of(rejected, rows)


def rows_of(bits: np.ndarray, rows: Rows) -> np.ndarray:
    """Return the rows whose bits are on."""
    if not bits.any():
        return NO_ROWS
    places = np.flatnonzero(np.unpackbits(bits.view(np.uint8), bitorder="little"))
    return rows.listed[places] if rows.listed.size else places


def bits_of(listed: np.ndarray, count: int) -> np.ndarray:
    """Return a bit array of whole blocks with the listed rows on."""
    blocks = (count + BLOCK - 1) // BLOCK
    flags = np.zeros(blocks * BLOCK, np.uint8)
    flags[listed] = 1
    return np.packbits(flags, bitorder="little").view(np.uint16)
