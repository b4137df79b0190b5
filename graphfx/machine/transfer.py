"""Copy columns between a processor set and the scratch of a block, whole or gathered by a list of rows.

A table has one line a column: (address, kind, offset in the scratch, by place). A column `by place`
runs along with the list of rows, the others are indexed by row.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.numpy_support import from_dtype

from graphfx.lanes import inlined

BLOCK = 256
REAL, ID, MASK, AGE, WORD = 0, 1, 2, 3, 4
"""Kinds of columns: reals as they are; uint64 as two words; uint8 as bits of a mask; the float64 time of
birth, read as now minus it; int32 as one word."""


def _element(dtype: Any) -> tuple[types.Type, ir.Type]:
    number = from_dtype(np.dtype(dtype))
    bits = number.bitwidth
    plain = {types.float32: ir.FloatType(), types.float64: ir.DoubleType()}
    return number, plain.get(number, ir.IntType(bits))


def _reader(dtype: Any) -> Any:
    number, llvm = _element(dtype)

    @intrinsic
    def read(typing: Any, address: Any, index: Any) -> Any:
        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            pointer = builder.inttoptr(values[0], llvm.as_pointer())
            return builder.load(builder.gep(pointer, [values[1]]))

        return number(types.int64, types.int64), generate

    return read


def _writer(dtype: Any) -> Any:
    number, llvm = _element(dtype)

    @intrinsic
    def write(typing: Any, address: Any, index: Any, value: Any) -> Any:
        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            pointer = builder.inttoptr(values[0], llvm.as_pointer())
            builder.store(context.cast(builder, values[2], sig.args[2], number), builder.gep(pointer, [values[1]]))
            return context.get_dummy_value()

        return types.void(types.int64, types.int64, value), generate

    return write


read_float32, read_float64 = _reader(np.float32), _reader(np.float64)
read_byte, read_uint64, read_int32 = _reader(np.uint8), _reader(np.uint64), _reader(np.int32)
write_float32, write_float64, write_byte = _writer(np.float32), _writer(np.float64), _writer(np.uint8)


@intrinsic
def copy_bytes(typing: Any, target: Any, source: Any, count: Any) -> Any:
    """Copy bytes between two addresses that do not overlap."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        byte = ir.IntType(8).as_pointer()
        cgutils.raw_memcpy(builder, builder.inttoptr(values[0], byte), builder.inttoptr(values[1], byte), values[2], 1)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, types.int64), generate


@intrinsic
def address_of(typing: Any, array: Any, index: Any) -> Any:
    """Return the address of array[index]."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        data = context.make_array(array)(context, builder, values[0]).data
        return builder.ptrtoint(builder.gep(data, [values[1]]), ir.IntType(64))

    return types.int64(array, types.int64), generate


@inlined
def _read_real(scratch, address, index):
    if scratch.itemsize == 4:
        return np.float64(read_float32(address, index))
    return read_float64(address, index)


@inlined
def load_block(table, scratch, words, masks, rows, first, count, now):
    """Fill the scratch with `count` rows from `first` on; `rows` lists them, or is empty for rows in order."""
    size = scratch.itemsize
    for line in range(table.shape[0]):
        address, kind, offset, by_place = table[line, 0], table[line, 1], table[line, 2], table[line, 3]
        gathered = rows.size > 0 and by_place == 0
        if kind == REAL and not gathered:
            copy_bytes(address_of(scratch, offset), address + first * size, np.int64(BLOCK * size))
            continue
        if kind == MASK:
            for word in range(BLOCK // 16):
                masks[(offset >> 4) + word] = 0
        for lane in range(count):
            row = rows[first + lane] if gathered else first + lane
            if kind == REAL:
                scratch[offset + lane] = _read_real(scratch, address, row)
            elif kind == ID:
                identity = read_uint64(address, row)
                words[offset + lane] = identity & np.uint64(0xFFFFFFFF)
                words[offset + BLOCK + lane] = identity >> np.uint64(32)
            elif kind == MASK:
                if read_byte(address, row) != 0:
                    masks[(offset + lane) >> 4] |= np.uint16(1) << np.uint16(lane & 15)
            elif kind == AGE:
                scratch[offset + lane] = now - read_float64(address, row)
            else:
                words[offset + lane] = read_int32(address, row)


@inlined
def store_block(table, scratch, masks, rows, first, keep):
    """Write back the lanes whose bits are on in masks[keep:]."""
    size = scratch.itemsize
    full = True
    for word in range(BLOCK // 16):
        full = full and masks[keep + word] == np.uint16(0xFFFF)
    for line in range(table.shape[0]):
        address, kind, offset, by_place = table[line, 0], table[line, 1], table[line, 2], table[line, 3]
        gathered = rows.size > 0 and by_place == 0
        if kind == REAL and full and not gathered:
            copy_bytes(address + first * size, address_of(scratch, offset), np.int64(BLOCK * size))
            continue
        for lane in range(BLOCK):
            if (masks[keep + (lane >> 4)] >> np.uint16(lane & 15)) & 1 == 0:
                continue
            row = rows[first + lane] if gathered else first + lane
            if kind == MASK:
                write_byte(address, row, (masks[(offset + lane) >> 4] >> np.uint16(lane & 15)) & 1)
            elif size == 4:
                write_float32(address, row, scratch[offset + lane])
            else:
                write_float64(address, row, scratch[offset + lane])
