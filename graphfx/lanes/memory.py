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

from graphfx.lanes.types import INT32, INT64, Mask, Real, Vec3Type, Word, constant, convert, splat as _splat

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
        return builder.load(_lane_pointer(builder, base, _index(context, builder, values[1], sig.args[1]), real.llvm), align=_bytes(real))

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


@intrinsic
def load_at(typing: Any, model: Any, pointer: Any, index: Any) -> Any:
    """Return lanes at pointer + index; `model` is a `Real` type."""
    real = model.instance_type

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return builder.load(_lane_pointer(builder, values[1], values[2], real.llvm), align=_bytes(real))

    return real(model, pointer, types.int64), generate


@intrinsic
def word_at(typing: Any, model: Any, pointer: Any, index: Any) -> Any:
    """Return the bits at pointer + index as words; of 64-bit lanes the low half."""
    real = model.instance_type
    word = Word(real.width)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        bits = builder.load(_lane_pointer(builder, values[1], values[2], real.llvm_integer), align=_bytes(real))
        return bits if real.single else builder.trunc(bits, word.llvm)

    return word(model, pointer, types.int64), generate


def _mask_word(builder: ir.IRBuilder, pointer: ir.Value, lane: ir.Value, width: int) -> ir.Value:
    """Return the pointer to the mask bits of lanes [lane, lane + width) in a bit array of 16-bit words."""
    if width == 8:
        bytes_ = builder.bitcast(pointer, ir.IntType(8).as_pointer())
        return builder.gep(bytes_, [builder.ashr(lane, ir.Constant(INT64, 3))])
    return builder.gep(pointer, [builder.ashr(lane, ir.Constant(INT64, 4))])


def load_mask_bits(builder: ir.IRBuilder, pointer: ir.Value, lane: ir.Value, width: int) -> ir.Value:
    """Return the mask of lanes [lane, lane + width): a vector of bits, or one bit for width 1."""
    bits = builder.load(_mask_word(builder, pointer, lane, width))
    if width > 1:
        return builder.bitcast(bits, ir.VectorType(ir.IntType(1), width))
    position = builder.trunc(builder.and_(lane, ir.Constant(INT64, 15)), ir.IntType(16))
    return builder.trunc(builder.lshr(bits, position), ir.IntType(1))


@intrinsic
def mask_at(typing: Any, model: Any, pointer: Any, lane: Any) -> Any:
    """Return the mask of the lanes from `lane` on, out of a bit array."""
    real = model.instance_type

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return load_mask_bits(builder, values[1], values[2], real.width)

    return real.mask(model, pointer, types.int64), generate


@intrinsic
def store_at(typing: Any, model: Any, pointer: Any, index: Any, mask: Any, value: Any) -> Any:
    """Write the lanes for which `mask` is true; the others keep what they hold."""
    real = model.instance_type

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        place = _lane_pointer(builder, values[1], values[2], real.llvm)
        new = convert(context, builder, values[4], sig.args[4], real)
        old = builder.load(place, align=_bytes(real))
        builder.store(builder.select(values[3], new, old), place, align=_bytes(real))
        return context.get_dummy_value()

    return types.void(model, pointer, types.int64, mask, value), generate


@intrinsic
def store_mask_at(typing: Any, model: Any, pointer: Any, lane: Any, value: Any) -> Any:
    """Write the bits of the lanes from `lane` on into a bit array."""
    real = model.instance_type

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        place = _mask_word(builder, values[1], values[2], real.width)
        if real.width > 1:
            builder.store(builder.bitcast(values[3], ir.IntType(real.width)), place)
            return context.get_dummy_value()
        one = ir.IntType(16)
        position = builder.trunc(builder.and_(values[2], ir.Constant(INT64, 15)), one)
        kept = builder.and_(builder.load(place), builder.not_(builder.shl(ir.Constant(one, 1), position)))
        bit = builder.zext(builder.trunc(values[3], ir.IntType(1)), one)
        builder.store(builder.or_(kept, builder.shl(bit, position)), place)
        return context.get_dummy_value()

    return types.void(model, pointer, types.int64, value), generate


@intrinsic
def multiply_high_low(typing: Any, word: Any, factor: Any) -> Any:
    """Return the high and low 32 bits of word * factor."""

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        wide = ir.VectorType(INT64, word.width) if word.width > 1 else INT64
        product = builder.mul(builder.zext(values[0], wide), _splat(builder, values[1], wide))
        high = builder.trunc(builder.lshr(product, constant(wide, 32)), word.llvm)
        return cgutils.pack_array(builder, [high, builder.trunc(product, word.llvm)])

    return types.UniTuple(word, 2)(word, types.int64), generate


@intrinsic
def word_constant(typing: Any, model: Any, value: Any) -> Any:
    """Return the low 32 bits of an integer in every lane."""
    word = Word(model.instance_type.width)

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return _splat(builder, builder.trunc(values[1], INT32), word.llvm)

    return word(model, types.int64), generate


@intrinsic
def uniform_of(typing: Any, model: Any, word: Any) -> Any:
    """Return words as reals in [0, 1): (bits >> 8) * 2**-24 in float32, bits * 2**-32 in float64."""
    real = model.instance_type

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        bits = builder.lshr(values[1], constant(word.llvm, 8)) if real.single else values[1]
        scale = 2.0**-24 if real.single else 2.0**-32
        return builder.fmul(builder.uitofp(bits, real.llvm), constant(real.llvm, scale))

    return real(model, word), generate


