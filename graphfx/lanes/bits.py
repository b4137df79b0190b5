"""What else the processor can do: count bits, sum lanes in order, read at an address, fetch ahead."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from graphfx.lanes.types import INT32


@intrinsic
def count_bits(typing: Any, bits: Any) -> Any:
    """Return the number of bits set in an integer."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return builder.ctpop(context.cast(builder, values[0], sig.args[0], types.int64))

    return types.int64(bits), generate


@intrinsic
def sum_lanes(typing: Any, value: Any) -> Any:
    """Return 0 + lane 0 + lane 1 + ..., added from left to right."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        element = value.llvm.element
        kind = ir.FunctionType(element, [element, value.llvm])
        name = f"llvm.vector.reduce.fadd.v{value.width}f{32 if value.single else 64}"
        function = cgutils.get_or_insert_function(builder.module, kind, name)
        return builder.call(function, [ir.Constant(element, 0.0), values[0]])

    return value.dtype(value), generate


@intrinsic
def float_at(typing: Any, address: Any, index: Any) -> Any:
    """Return the float32 at an address, an integer, plus `index` floats. Who calls keeps the array alive.

    Many columns go to a kernel as one array of addresses: as arrays each would take seven arguments
    and time to compile them.
    """

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        base = builder.inttoptr(values[0], ir.FloatType().as_pointer())
        return builder.load(builder.gep(base, [context.cast(builder, values[1], sig.args[1], types.int64)]), align=4)

    return types.float32(types.int64, index), generate


@intrinsic
def prefetch(typing: Any, array: Any, index: Any) -> Any:
    """Fetch the cache line of array[index], a contiguous array seen as flat, without waiting for it."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        base = context.make_array(sig.args[0])(context, builder, values[0]).data
        place = builder.gep(base, [context.cast(builder, values[1], sig.args[1], types.int64)])
        byte = ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [byte, INT32, INT32, INT32])
        function = cgutils.get_or_insert_function(builder.module, kind, "llvm.prefetch.p0")
        read, keep, data = (ir.Constant(INT32, number) for number in (0, 3, 1))
        builder.call(function, [builder.bitcast(place, byte), read, keep, data])
        return context.get_dummy_value()

    return types.void(array, index), generate
