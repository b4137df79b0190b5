"""Copy columns between a processor set and the scratch of a block, whole or gathered by a list of rows.

In the scratch the components of a column lie line by line: sixteen float32 (or eight float64) x, as many
y, as many z, then those of the next lanes. A table has one line a component array: (address, kind, offset
in the scratch, by place, components of the column). A column `by place` runs along with the list of
rows, the others are indexed by row. All arrays are whole blocks long.
"""

from __future__ import annotations

import numpy as np

from graphfx.lanes.addresses import (
    address_of,
    blend_line,
    copy_line,
    pack_truths,
    read_byte,
    read_float32,
    read_float64,
    read_int32,
    read_uint64,
    split_ids,
    subtract_times,
    unpack_truths,
    widen_words,
    write_byte,
    write_float32,
    write_float64,
)
from graphfx.lanes.inner import inner
from graphfx.store.processors import BLOCK

LINE_BYTES = 64
REAL, ID, MASK, AGE, WORD = 0, 1, 2, 3, 4
"""Kinds of columns: reals as they are; uint64 as two words; uint8 as bits of a mask; the float64 time of
birth, read as now minus it; int32 as one word."""

blend_single, blend_double = blend_line[32], blend_line[64]
split_single, split_double = split_ids[32], split_ids[64]
ages_single, ages_double = subtract_times[32], subtract_times[64]


@inner
def _lane_index(lane, components, size):
    """Return where a lane's element lies, from the component's first: `size` is the bytes of an element."""
    width = LINE_BYTES // size
    return lane // width * width * components + lane % width


@inner
def _load_lines(kind, target, source, step, size, now):
    """Fill a column from consecutive rows: `target` is its first line, the next `step` bytes on."""
    width = LINE_BYTES // size
    for line in range(BLOCK // width):
        to, row = target + line * step, line * width
        if kind == REAL:
            copy_line(to, source + row * size)
        elif kind == ID:
            if size == 4:
                split_single(to, source + row * 8)
            else:
                split_double(to, source + row * 8)
        elif kind == AGE:
            if size == 4:
                ages_single(to, source + row * 8, now)
            else:
                ages_double(to, source + row * 8, now)
        elif size == 4:
            copy_line(to, source + row * 4)
        else:
            widen_words(to, source + row * 4)


@inner
def _element_bytes(kind, size):
    if kind == REAL:
        return size
    return 1 if kind == MASK else 4 if kind == WORD else 8


@inner
def _load_lane(kind, scratch, words, masks, offset, index, lane, address, row, now):
    """Fill one lane of a column from a row."""
    if kind == REAL:
        scratch[offset + index] = read_float32(address, row) if scratch.itemsize == 4 else read_float64(address, row)
    elif kind == ID:
        identity = read_uint64(address, row)
        words[offset + index] = identity & np.uint64(0xFFFFFFFF)
        words[offset + index + LINE_BYTES // scratch.itemsize] = identity >> np.uint64(32)
    elif kind == MASK:
        if read_byte(address, row) != 0:
            masks[(offset + lane) >> 4] |= np.uint16(1) << np.uint16(lane & 15)
    elif kind == AGE:
        scratch[offset + index] = now - read_float64(address, row)
    else:
        words[offset + index] = read_int32(address, row)


@inner
def load_block(table, scratch, words, masks, rows, first, count, now):
    """Fill the scratch with `count` rows from `first` on; `rows` lists them, or is empty for rows in order."""
    size = scratch.itemsize
    for line in range(table.shape[0]):
        address, kind, offset, components = table[line, 0], table[line, 1], table[line, 2], table[line, 4]
        if rows.size == 0 or table[line, 3] != 0:
            source = address + first * _element_bytes(kind, size)
            if kind == MASK:
                for word in range(BLOCK // 16):
                    pack_truths(address_of(masks, (offset >> 4) + word), source + word * 16)
            else:
                _load_lines(kind, address_of(scratch, offset), source, components * LINE_BYTES, size, now)
            continue
        if kind == MASK:
            for word in range(BLOCK // 16):
                masks[(offset >> 4) + word] = 0
        for lane in range(count):
            index = _lane_index(lane, components, size)
            _load_lane(kind, scratch, words, masks, offset, index, lane, address, rows[first + lane], now)


@inner
def _store_lines(kind, target, scratch, masks, offset, step, keep):
    """Write a column to consecutive rows: the lanes whose bits are on in masks[keep:]."""
    size = scratch.itemsize
    for word in range(BLOCK // 16):
        on = np.int64(masks[keep + word])
        if kind == MASK:
            unpack_truths(target + word * 16, address_of(masks, (offset >> 4) + word), on)
        elif size == 4:
            blend_single(target + word * 64, address_of(scratch, offset) + word * step, on)
        else:
            source = address_of(scratch, offset) + 2 * word * step
            blend_double(target + word * 128, source, on & 255)
            blend_double(target + word * 128 + 64, source + step, on >> 8)


@inner
def store_block(table, scratch, masks, rows, first, keep):
    """Write back the lanes whose bits are on in masks[keep:]."""
    size = scratch.itemsize
    for line in range(table.shape[0]):
        address, kind, offset, components = table[line, 0], table[line, 1], table[line, 2], table[line, 4]
        if rows.size == 0 or table[line, 3] != 0:
            target = address + first * _element_bytes(kind, size)
            _store_lines(kind, target, scratch, masks, offset, components * LINE_BYTES, keep)
            continue
        for lane in range(BLOCK):
            if (masks[keep + (lane >> 4)] >> np.uint16(lane & 15)) & 1 == 0:
                continue
            row, index = rows[first + lane], _lane_index(lane, components, size)
            if kind == MASK:
                write_byte(address, row, (masks[(offset + lane) >> 4] >> np.uint16(lane & 15)) & 1)
            elif size == 4:
                write_float32(address, row, scratch[offset + index])
            else:
                write_float64(address, row, scratch[offset + index])
