"""Operators on lanes, the primitives of `graphfx.math`, masks and `where`.

No fast-math flag is set anywhere: each lane does what IEEE arithmetic says, so the plain-Python
functions on NumPy scalars give the same bits.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils, errors
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin

from graphfx.lanes.define import define
from graphfx.lanes.types import Mask, Real, Word, constant, convert, joined, literal_lanes
from graphfx.math import primitives

BRANCH = (
    "a branch on a value that differs from lane to lane; write where(condition, a, b) instead of "
    "'if', 'and', 'or', 'not' and 'a < b < c'; masks combine with & | ~"
)


class LaneBranchError(errors.TypingError):
    """A Python branch on a mask."""


def _arithmetic(name: str) -> Callable[..., ir.Value]:
    return lambda builder, real, x, y: getattr(builder, name)(x, y)


for _operator, _in_place, _name in (
    (operator.add, operator.iadd, "fadd"),
    (operator.sub, operator.isub, "fsub"),
    (operator.mul, operator.imul, "fmul"),
    (operator.truediv, operator.itruediv, "fdiv"),
):
    define(_operator, 2, _arithmetic(_name))
    define(_in_place, 2, _arithmetic(_name))
define(operator.neg, 1, lambda builder, real, x: builder.fneg(x))
define(operator.pos, 1, lambda builder, real, x: x)


def _comparison(symbol: str) -> Callable[..., ir.Value]:
    def generate(builder: ir.IRBuilder, real: Real, x: ir.Value, y: ir.Value) -> ir.Value:
        compare = builder.fcmp_unordered if symbol == "!=" else builder.fcmp_ordered
        return compare(symbol, x, y)

    return generate


for _operator, _symbol in (
    (operator.lt, "<"), (operator.le, "<="), (operator.gt, ">"), (operator.ge, ">="), (operator.eq, "=="), (operator.ne, "!="),
):
    define(_operator, 2, _comparison(_symbol), lambda real: real.mask)


def intrinsic_call(name: str) -> Callable[..., ir.Value]:
    """Return a generator that calls the LLVM intrinsic `llvm.<name>` on the lanes."""

    def generate(builder: ir.IRBuilder, real: Real, *values: ir.Value) -> ir.Value:
        suffix = ("f32" if real.single else "f64") if real.width == 1 else f"v{real.width}f{32 if real.single else 64}"
        kind = ir.FunctionType(real.llvm, [real.llvm] * len(values))
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.{suffix}"), values)

    return generate


def _lesser(symbol: str) -> Callable[..., ir.Value]:
    return lambda builder, real, x, y: builder.select(builder.fcmp_ordered(symbol, x, y), x, y)


for _function, _count, _intrinsic in (
    (primitives.floor, 1, "floor"), (primitives.sqrt, 1, "sqrt"), (primitives.fma, 3, "fma"),
    (primitives.absolute, 1, "fabs"), (primitives.copysign, 2, "copysign"),
    (math.floor, 1, "floor"), (math.sqrt, 1, "sqrt"), (abs, 1, "fabs"),
):
    define(_function, _count, intrinsic_call(_intrinsic))
for _lesser_of, _symbol in ((primitives.minimum, "<"), (primitives.maximum, ">"), (min, "<"), (max, ">")):
    define(_lesser_of, 2, _lesser(_symbol))


def _scale2(builder: ir.IRBuilder, real: Real, x: ir.Value, k: ir.Value) -> ir.Value:
    bias, shift = (127, 23) if real.single else (1023, 52)
    integer = real.llvm_integer
    exponent = builder.shl(builder.add(builder.fptosi(k, integer), constant(integer, bias)), constant(integer, shift))
    return builder.fmul(x, builder.bitcast(exponent, real.llvm))


def _split2(builder: ir.IRBuilder, real: Real, x: ir.Value) -> ir.Value:
    half, shift = (0x3F3504F3, 23) if real.single else (0x3FE6A09E667F3BCD, 52)
    integer = real.llvm_integer
    bits = builder.bitcast(x, integer)
    exponent = builder.ashr(builder.sub(bits, constant(integer, half)), constant(integer, shift))
    fraction = builder.bitcast(builder.sub(bits, builder.shl(exponent, constant(integer, shift))), real.llvm)
    return cgutils.pack_array(builder, [fraction, builder.sitofp(exponent, real.llvm)])


define(primitives.scale2, 2, _scale2)
define(primitives.split2, 1, _split2, lambda real: types.UniTuple(real, 2))


@infer_global(bool)
@infer_global(operator.not_)
class _NoBranch(AbstractTemplate):
    def generic(self, args: Any, kws: Any) -> Any:
        if args and isinstance(args[0], Mask):
            raise LaneBranchError(BRANCH)


def _define_mask_operator(function: Any, name: str) -> None:
    @infer_global(function)
    class _Rule(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            if len(args) == 2 and all(isinstance(a, Mask) for a in args):
                return signature(args[0], *args)

    lower_builtin(function, Mask, Mask)(lambda context, builder, sig, values: getattr(builder, name)(*values))


for _operator, _name in ((operator.and_, "and_"), (operator.or_, "or_"), (operator.xor, "xor")):
    _define_mask_operator(_operator, _name)


@infer_global(operator.invert)
class _InvertRule(AbstractTemplate):
    def generic(self, args: Any, kws: Any) -> Any:
        if isinstance(args[0], Mask):
            return signature(args[0], *args)


lower_builtin(operator.invert, Mask)(lambda context, builder, sig, values: builder.not_(values[0]))


@infer_global(primitives.where)
class _WhereRule(AbstractTemplate):
    def generic(self, args: Any, kws: Any) -> Any:
        if len(args) != 3 or not isinstance(args[0], (Mask, types.Boolean)):
            return None
        if isinstance(args[1], (Mask, types.Boolean)) and args[1] == args[2] == args[0]:
            return signature(args[1], *args)
        width = args[0].width if isinstance(args[0], Mask) else 1
        real = joined(args[1:]) or literal_lanes(args[1:], width)
        if real is None:
            return None
        if real.width == 1:
            real = Real(real.dtype, width)
        return signature(real, args[0], *(a if isinstance(a, Real) else real for a in args[1:]))


def _where(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    real = sig.return_type
    chosen = [convert(context, builder, v, t, real) for v, t in zip(values[1:], sig.args[1:], strict=True)]
    return builder.select(values[0], *chosen)


def _where_mask(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    return builder.select(*values)


for _condition in (Mask, types.Boolean):
    lower_builtin(primitives.where, _condition, _condition, _condition)(_where_mask)
    lower_builtin(primitives.where, _condition, Real, Real)(_where)


def _define_word_operator(function: Any, name: str) -> None:
    @infer_global(function)
    class _Rule(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            if len(args) == 2 and all(isinstance(a, Word) for a in args):
                return signature(args[0], *args)

    lower_builtin(function, Word, Word)(lambda context, builder, sig, values: getattr(builder, name)(*values))


for _operator, _name in ((operator.xor, "xor"), (operator.add, "add")):
    _define_word_operator(_operator, _name)
