"""Move lanes between memory and registers, and questions across lanes.

`load(array, index)` and `store(array, index, value)` are for NumPy arrays in engine code;
`load_at` and `store_at` work on bare pointers, as kernels do. Alignment is an element's.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from graphfx.lanes.types import INT64, Mask, Real, convert
from graphfx.lanes.types import splat as _splat

FLOAT_LANES = {types.float32: 16, types.float64: 8}


def _real_of(dtype: types.Float) -> Real:
    return Real(dtype, FLOAT_LANES[dtype])


def _bytes(real: Real) -> int:
    return 4 if real.single else 8


def _lane_pointer(builder: ir.IRBuilder, base: ir.Value, index: ir.Value, type_: ir.Type) -> ir.Value:
    return builder.bitcast(builder.gep(base, [index]), type_.as_pointer())


def _array_data(context: Any, builder: ir.IRBuilder, type_: types.Array, value: ir.Value) -> ir.Value:
    return context.make_array(type_)(context, builder, value).data


def _index(context: Any, builder: ir.IRBuilder, value: ir.Value, type_: types.Type) -> ir.Value:
    return context.cast(builder, value, type_, types.int64)


@intrinsic
def load(typing: Any, array: Any, index: Any) -> Any:
    """Return lanes array[index : index + width] of a contiguous float array."""
    real = _real_of(array.dtype)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        base = _array_data(context, builder, sig.args[0], values[0])
        index = _index(context, builder, values[1], sig.args[1])
        return builder.load(_lane_pointer(builder, base, index, real.llvm), align=_bytes(real))

    return real(array, index), generate


@intrinsic
def store(typing: Any, array: Any, index: Any, value: Any) -> Any:
    """Write lanes to array[index : index + width]."""
    real = _real_of(array.dtype)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        base = _array_data(context, builder, sig.args[0], values[0])
        pointer = _lane_pointer(builder, base, _index(context, builder, values[1], sig.args[1]), real.llvm)
        builder.store(convert(context, builder, values[2], sig.args[2], real), pointer, align=_bytes(real))
        return context.get_dummy_value()

    return types.void(array, index, value), generate


@intrinsic
def splat(typing: Any, scalar: Any) -> Any:
    """Return one float32 or float64 in every lane."""
    real = _real_of(scalar)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return _splat(builder, values[0], real.llvm)

    return real(scalar), generate


@intrinsic
def iota(typing: Any) -> Any:
    """Return the lane numbers 0 to 15 as float32."""
    real = Real(types.float32, 16)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return ir.Constant(real.llvm, [float(lane) for lane in range(real.width)])

    return real(), generate


@intrinsic
def mask_bits(typing: Any, mask: Any) -> Any:
    """Return the mask as an integer: bit l is lane l."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return builder.zext(builder.bitcast(values[0], ir.IntType(mask.width)), INT64)

    return types.int64(mask), generate


@intrinsic
def mask_from_bits(typing: Any, bits: Any) -> Any:
    """Return a mask of sixteen lanes from the low bits of an integer."""
    mask = Mask(16)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return builder.bitcast(builder.trunc(_index(context, builder, values[0], sig.args[0]), ir.IntType(16)), mask.llvm)

    return mask(bits), generate


@intrinsic
def any_lane(typing: Any, mask: Any) -> Any:
    """Return whether any lane is true."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        bits = builder.bitcast(values[0], ir.IntType(mask.width))
        return builder.icmp_unsigned("!=", bits, ir.Constant(bits.type, 0))

    return types.boolean(mask), generate


def _extreme(name: str) -> Any:
    @intrinsic
    def extreme(typing: Any, value: Any) -> Any:
        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            element = value.llvm.element
            suffix = f"v{value.width}f{32 if value.single else 64}"
            kind = ir.FunctionType(element, [value.llvm])
            function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.vector.reduce.{name}.{suffix}")
            return builder.call(function, [values[0]])

        return value.dtype(value), generate

    return extreme


highest = _extreme("fmax")
"""Return the greatest lane of a `Real` without NaN."""
lowest = _extreme("fmin")
"""Return the least lane of a `Real` without NaN."""
