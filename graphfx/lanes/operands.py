"""What kernels do with memory: bare pointers, operands by place, masks as arrays of bits, words.

A kernel is handed `scratch`, `operands` and `masks`. `operands[place]` and the next hold (offset, lane
mask): an operand of n components is read at offset + (n lane & lane mask), its components one line of
lanes after another. So a column holds sixteen x, sixteen y, sixteen z (eight of float64), then those of
the next lanes, and a uniform one line of each. Results have an offset alone.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from graphfx.lanes.types import INT32, INT64, Real, Vec3Type, Word, constant
from graphfx.lanes.types import splat as _splat


def _bytes(real: Real) -> int:
    return 4 if real.single else 8


def _entry(builder: ir.IRBuilder, operands: ir.Value, place: int) -> ir.Value:
    return builder.load(builder.gep(operands, [ir.Constant(INT64, place)]))


LINE = {True: 16, False: 8}
"""Lanes in a line of scratch, by whether they are float32."""


def _scaled(builder: ir.IRBuilder, lane: ir.Value, real: Real, components: int) -> ir.Value:
    """Return where the lanes from `lane` on lie in a column of so many components; kernels of width 1 go lane by lane."""
    line = LINE[real.single]
    if components == 1:
        return lane
    if real.width == line:
        return builder.mul(lane, ir.Constant(INT64, components))
    within = builder.and_(lane, ir.Constant(INT64, line - 1))
    return builder.add(builder.mul(builder.sub(lane, within), ir.Constant(INT64, components)), within)


def _offset(builder: ir.IRBuilder, operands: ir.Value, place: int, lane: ir.Value) -> ir.Value:
    offset, lane_mask = _entry(builder, operands, place), _entry(builder, operands, place + 1)
    return builder.add(offset, builder.and_(lane, lane_mask))


def _component(builder: ir.IRBuilder, base: ir.Value, index: ir.Value, k: int, real: Real, type_: ir.Type) -> ir.Value:
    """Return the pointer to component k of what lies at base + index."""
    return _pointer(builder, builder.gep(base, [index]), ir.Constant(INT64, k * LINE[real.single]), type_)


def _pointer(builder: ir.IRBuilder, base: ir.Value, index: ir.Value, type_: ir.Type) -> ir.Value:
    return builder.bitcast(builder.gep(base, [index]), type_.as_pointer())


def _literal(type_: Any) -> int | None:
    return type_.literal_value if isinstance(type_, types.IntegerLiteral) else None


def _reader(components: int) -> Any:
    """Return an intrinsic that reads an operand of so many components: a real, a Vec3, or a tuple of four."""

    @intrinsic(prefer_literal=True)
    def read(typing: Any, model: Any, scratch: Any, operands: Any, place: Any, lane: Any) -> Any:
        real, first = model.instance_type, _literal(place)
        if first is None:
            return None
        result = {1: real, 3: Vec3Type(real), 4: types.UniTuple(real, 4)}[components]

        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            index = _offset(builder, values[2], first, _scaled(builder, values[4], real, components))
            parts = [builder.load(_component(builder, values[1], index, k, real, real.llvm), align=_bytes(real))
                     for k in range(components)]
            if components == 1:
                return parts[0]
            if components == 4:
                return cgutils.pack_array(builder, parts)
            proxy = cgutils.create_struct_proxy(result)(context, builder)
            proxy.x, proxy.y, proxy.z = parts
            return proxy._getvalue()

        return result(model, scratch, operands, place, types.int64), generate

    return read


read_float, read_vec3, read_draw = _reader(1), _reader(3), _reader(4)


def _writer(components: int) -> Any:
    """Return an intrinsic that writes a result; lanes outside `on` keep what they hold."""

    @intrinsic(prefer_literal=True)
    def write(typing: Any, model: Any, scratch: Any, operands: Any, place: Any, lane: Any, on: Any, value: Any) -> Any:
        real, first = model.instance_type, _literal(place)
        if first is None:
            return None
        expected = {1: real, 3: Vec3Type(real), 4: types.UniTuple(real, 4)}[components]

        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            if components == 1:
                parts = [values[6]]
            elif components == 4:
                parts = cgutils.unpack_tuple(builder, values[6], 4)
            else:
                proxy = cgutils.create_struct_proxy(expected)(context, builder, value=values[6])
                parts = [proxy.x, proxy.y, proxy.z]
            index = builder.add(_entry(builder, values[2], first), _scaled(builder, values[4], real, components))
            for k, part in enumerate(parts):
                pointer = _component(builder, values[1], index, k, real, real.llvm)
                old = builder.load(pointer, align=_bytes(real))
                builder.store(builder.select(values[5], part, old), pointer, align=_bytes(real))
            return context.get_dummy_value()

        return types.void(model, scratch, operands, place, types.int64, on, expected), generate

    return write


write_float, write_vec3, write_draw = _writer(1), _writer(3), _writer(4)


def _word_pointer(builder: ir.IRBuilder, masks: ir.Value, lane: ir.Value, width: int) -> ir.Value:
    """Return the pointer to the bits of lanes [lane, lane + width) in a bit array of 16-bit words."""
    if width == 8:
        bytes_ = builder.bitcast(masks, ir.IntType(8).as_pointer())
        return builder.gep(bytes_, [builder.ashr(lane, ir.Constant(INT64, 3))])
    return builder.gep(masks, [builder.ashr(lane, ir.Constant(INT64, 4))])


def _position(builder: ir.IRBuilder, lane: ir.Value) -> ir.Value:
    return builder.trunc(builder.and_(lane, ir.Constant(INT64, 15)), ir.IntType(16))


@intrinsic(prefer_literal=True)
def read_mask(typing: Any, model: Any, masks: Any, operands: Any, place: Any, lane: Any) -> Any:
    """Return the mask of the lanes from `lane` on: one bit for width 1."""
    real, first = model.instance_type, _literal(place)
    if first is None:
        return None

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        lanes = builder.add(_entry(builder, values[2], first), values[4])
        bits = builder.load(_word_pointer(builder, values[1], lanes, real.width))
        if real.width > 1:
            return builder.bitcast(bits, ir.VectorType(ir.IntType(1), real.width))
        return builder.trunc(builder.lshr(bits, _position(builder, lanes)), ir.IntType(1))

    return real.mask(model, masks, operands, place, types.int64), generate


@intrinsic(prefer_literal=True)
def write_mask(typing: Any, model: Any, masks: Any, operands: Any, place: Any, lane: Any, value: Any) -> Any:
    """Write the bits of the lanes from `lane` on."""
    real, first = model.instance_type, _literal(place)
    if first is None:
        return None

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        lanes = builder.add(_entry(builder, values[2], first), values[4])
        pointer = _word_pointer(builder, values[1], lanes, real.width)
        if real.width > 1:
            builder.store(builder.bitcast(values[5], ir.IntType(real.width)), pointer)
            return context.get_dummy_value()
        word, position = ir.IntType(16), _position(builder, lanes)
        kept = builder.and_(builder.load(pointer), builder.not_(builder.shl(ir.Constant(word, 1), position)))
        bit = builder.zext(builder.trunc(values[5], ir.IntType(1)), word)
        builder.store(builder.or_(kept, builder.shl(bit, position)), pointer)
        return context.get_dummy_value()

    return types.void(model, masks, operands, place, types.int64, value), generate


def _word_reader(components: int) -> Any:
    """Return an intrinsic that reads the bits of an operand as a tuple of words; of 64-bit lanes the low halves."""

    @intrinsic(prefer_literal=True)
    def read(typing: Any, model: Any, scratch: Any, operands: Any, place: Any, lane: Any) -> Any:
        real, first = model.instance_type, _literal(place)
        if first is None:
            return None
        word = Word(real.width)

        def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
            index = _offset(builder, values[2], first, _scaled(builder, values[4], real, components))
            parts = []
            for k in range(components):
                bits = builder.load(_component(builder, values[1], index, k, real, real.llvm_integer), align=_bytes(real))
                parts.append(bits if real.single else builder.trunc(bits, word.llvm))
            return cgutils.pack_array(builder, parts)

        return types.UniTuple(word, components)(model, scratch, operands, place, types.int64), generate

    return read


read_word, read_id = _word_reader(1), _word_reader(2)


@intrinsic(prefer_literal=True)
def write_word(typing: Any, model: Any, scratch: Any, operands: Any, place: Any, lane: Any, on: Any, value: Any) -> Any:
    """Write whole reals from 0 to 2**31 - 1 as words where `on`; lanes of 64 bits take them as their low halves."""
    real, first = model.instance_type, _literal(place)
    if first is None:
        return None
    word = Word(real.width).llvm

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        index = builder.add(_entry(builder, values[2], first), _scaled(builder, values[4], real, 1))
        pointer = _component(builder, values[1], index, 0, real, real.llvm_integer)
        whole = builder.fptosi(values[6], word)
        bits = whole if real.single else builder.zext(whole, real.llvm_integer)
        old = builder.load(pointer, align=_bytes(real))
        builder.store(builder.select(values[5], bits, old), pointer, align=_bytes(real))
        return context.get_dummy_value()

    return types.void(model, scratch, operands, place, types.int64, on, real), generate


@intrinsic(prefer_literal=True)
def read_number(typing: Any, operands: Any, place: Any) -> Any:
    """Return operands[place] itself."""
    first = _literal(place)
    if first is None:
        return None

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        return _entry(builder, values[0], first)

    return types.int64(operands, place), generate


def _halves_of_products(builder: ir.IRBuilder, word: ir.Value, factor: int, width: int) -> list[ir.Value]:
    """Return high and low words of word * factor: even and odd lanes apart, as the processor multiplies them."""
    wide = ir.VectorType(INT64, width // 2)
    pairs, factors = builder.bitcast(word, wide), constant(wide, factor)
    even = builder.mul(builder.and_(pairs, constant(wide, 0xFFFFFFFF)), factors)
    odd = builder.mul(builder.lshr(pairs, constant(wide, 32)), factors)
    words = [builder.bitcast(product, word.type) for product in (even, odd)]
    order = ir.VectorType(INT32, width)
    places = [[half + lane // 2 * 2 + lane % 2 * width for lane in range(width)] for half in (1, 0)]
    return [builder.shuffle_vector(*words, ir.Constant(order, place)) for place in places]


@intrinsic(prefer_literal=True)
def multiply_high_low(typing: Any, word: Any, factor: Any) -> Any:
    """Return the high and low 32 bits of word * factor, a constant of 32 bits."""
    number = _literal(factor)
    if number is None:
        return None

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        if word.width > 1:
            return cgutils.pack_array(builder, _halves_of_products(builder, values[0], number, word.width))
        product = builder.mul(builder.zext(values[0], INT64), ir.Constant(INT64, number))
        high = builder.trunc(builder.lshr(product, ir.Constant(INT64, 32)), word.llvm)
        return cgutils.pack_array(builder, [high, builder.trunc(product, word.llvm)])

    return types.UniTuple(word, 2)(word, factor), generate


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


