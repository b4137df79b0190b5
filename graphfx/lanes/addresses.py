"""What the transfer between columns and scratch does with bare addresses: single elements, and lines of lanes.

A line is 64 bytes of scratch: sixteen float32 or eight float64. Addresses are int64 and count bytes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numba.np.numpy_support import from_dtype

from graphfx.lanes.types import INT32, INT64, constant, splat

BYTE, SHORT = ir.IntType(8), ir.IntType(16)
LINE = {32: 16, 64: 8}
"""Lanes of a line by the bits of a lane."""


def _load(builder: ir.IRBuilder, address: ir.Value, type_: ir.Type) -> ir.Value:
    return builder.load(builder.inttoptr(address, type_.as_pointer()), align=1)


def _store(builder: ir.IRBuilder, value: ir.Value, address: ir.Value) -> None:
    builder.store(value, builder.inttoptr(address, value.type.as_pointer()), align=1)


def _element(dtype: Any) -> tuple[types.Type, ir.Type]:
    number = from_dtype(np.dtype(dtype))
    plain = {types.float32: ir.FloatType(), types.float64: ir.DoubleType()}
    return number, plain.get(number, ir.IntType(number.bitwidth))


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
def address_of(typing: Any, array: Any, index: Any) -> Any:
    """Return the address of array[index]."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        data = context.make_array(array)(context, builder, values[0]).data
        return builder.ptrtoint(builder.gep(data, [values[1]]), INT64)

    return types.int64(array, types.int64), generate


def _transfer(build: Any) -> Any:
    """Return an intrinsic f(target, source) for `build(builder, target, source)`, which moves one line."""

    @intrinsic
    def move(typing: Any, target: Any, source: Any) -> Any:
        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            build(builder, *values)
            return context.get_dummy_value()

        return types.void(types.int64, types.int64), generate

    return move


def _transfer_with(build: Any, third: types.Type) -> Any:
    """Return an intrinsic f(target, source, third)."""

    @intrinsic
    def move(typing: Any, target: Any, source: Any, given: Any) -> Any:
        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            build(builder, *values)
            return context.get_dummy_value()

        return types.void(types.int64, types.int64, third), generate

    return move


def _copy(builder: ir.IRBuilder, target: ir.Value, source: ir.Value) -> None:
    _store(builder, _load(builder, source, ir.VectorType(INT32, 16)), target)


def _blend(bits: int) -> Any:
    def build(builder: ir.IRBuilder, target: ir.Value, source: ir.Value, on: ir.Value) -> None:
        line = ir.VectorType(ir.IntType(bits), LINE[bits])
        truths = builder.bitcast(builder.trunc(on, ir.IntType(LINE[bits])), ir.VectorType(ir.IntType(1), LINE[bits]))
        _store(builder, builder.select(truths, _load(builder, source, line), _load(builder, target, line)), target)

    return build


def _split(bits: int) -> Any:
    def build(builder: ir.IRBuilder, target: ir.Value, source: ir.Value) -> None:
        wide, line = ir.VectorType(INT64, LINE[bits]), ir.VectorType(ir.IntType(bits), LINE[bits])
        ids = _load(builder, source, wide)
        low, high = builder.and_(ids, constant(wide, 0xFFFFFFFF)), builder.lshr(ids, constant(wide, 32))
        for part, value in enumerate((low, high)):
            place = builder.add(target, ir.Constant(INT64, 64 * part))
            _store(builder, builder.trunc(value, line) if bits == 32 else value, place)

    return build


def _widen(builder: ir.IRBuilder, target: ir.Value, source: ir.Value) -> None:
    _store(builder, builder.zext(_load(builder, source, ir.VectorType(INT32, 8)), ir.VectorType(INT64, 8)), target)


def _ages(bits: int) -> Any:
    def build(builder: ir.IRBuilder, target: ir.Value, source: ir.Value, now: ir.Value) -> None:
        wide = ir.VectorType(ir.DoubleType(), LINE[bits])
        ages = builder.fsub(splat(builder, now, wide), _load(builder, source, wide))
        _store(builder, builder.fptrunc(ages, ir.VectorType(ir.FloatType(), 16)) if bits == 32 else ages, target)

    return build


def _truths(builder: ir.IRBuilder, target: ir.Value, source: ir.Value) -> None:
    bytes_ = ir.VectorType(BYTE, 16)
    on = builder.icmp_unsigned("!=", _load(builder, source, bytes_), constant(bytes_, 0))
    _store(builder, builder.bitcast(on, SHORT), target)


def _truth_bytes(builder: ir.IRBuilder, target: ir.Value, source: ir.Value, on: ir.Value) -> None:
    bytes_, truths = ir.VectorType(BYTE, 16), ir.VectorType(ir.IntType(1), 16)
    new = builder.zext(builder.bitcast(_load(builder, source, SHORT), truths), bytes_)
    kept = builder.bitcast(builder.trunc(on, SHORT), truths)
    _store(builder, builder.select(kept, new, _load(builder, target, bytes_)), target)


copy_line = _transfer(_copy)
"""Copy a line."""
blend_line = {32: _transfer_with(_blend(32), types.int64), 64: _transfer_with(_blend(64), types.int64)}
"""Copy the lanes of a line whose bits are on."""
split_ids = {32: _transfer(_split(32)), 64: _transfer(_split(64))}
"""Put the low and high halves of uint64 into two lines, one after the other."""
widen_words = _transfer(_widen)
"""Put eight int32 into a line of eight words of 64 bits."""
subtract_times = {32: _transfer_with(_ages(32), types.float64), 64: _transfer_with(_ages(64), types.float64)}
"""Put now minus float64 times into a line."""
pack_truths = _transfer(_truths)
"""Put sixteen bytes, 0 or not, into sixteen bits."""
unpack_truths = _transfer_with(_truth_bytes, types.int64)
"""Put sixteen bits into bytes 0 or 1, for the lanes whose bits are on."""
