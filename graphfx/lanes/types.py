"""Numba types for explicit lanes: `Real(dtype, width)`, `Mask(width)`, `Word(width)`, `Vec3Type(real)`.

A lane type is one LLVM vector, so what is written with it is vector code whatever the optimiser
thinks: sixteen float32 or eight float64 fill one 512-bit register, and LLVM splits them on
narrower machines without changing a bit. Width 1 is one plain float, for tests and for code that
goes lane by lane.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core.datamodel import models
from numba.core.datamodel.registry import register_default as register_model
from numba.core.typeconv import Conversion
from numba.extending import lower_cast, make_attribute_wrapper

INT32 = ir.IntType(32)
INT64 = ir.IntType(64)


def _vector(element: ir.Type, width: int) -> ir.Type:
    return element if width == 1 else ir.VectorType(element, width)


class Real(types.Type):
    """`width` lanes of float32 or float64. Plain numbers that meet it take its precision.

    Where literals alone meet, as in where(condition, 0.0, 1.0), the result is float64 lanes that are a literal
    themselves: meeting float32 lanes they are rounded to float32, as a Python float is.
    """

    def __init__(self, dtype: types.Float, width: int):
        self.dtype = dtype
        self.width = width
        super().__init__(f"Real({dtype}, {width})")

    @property
    def single(self) -> bool:
        """Return whether lanes are float32."""
        return self.dtype == types.float32

    @property
    def llvm(self) -> ir.Type:
        """Return the LLVM type."""
        return _vector(self.dtype_llvm, self.width)

    @property
    def dtype_llvm(self) -> ir.Type:
        """Return the LLVM type of one lane."""
        return ir.FloatType() if self.single else ir.DoubleType()

    @property
    def llvm_integer(self) -> ir.Type:
        """Return the LLVM type of the same bits as integers."""
        return _vector(INT32 if self.single else INT64, self.width)

    @property
    def mask(self) -> types.Type:
        """Return the type of a comparison's result."""
        return types.boolean if self.width == 1 else Mask(self.width)

    def unify(self, context: Any, other: types.Type) -> types.Type | None:
        """Return this type where a plain number meets it on another path."""
        return self if isinstance(other, types.Number) else None

    def can_convert_from(self, context: Any, other: types.Type) -> Conversion | None:
        """Accept any plain number, and float64 lanes, which are literals where this is float32."""
        literal = isinstance(other, Real) and not other.single and other.width in (1, self.width)
        return Conversion.safe if literal or isinstance(other, types.Number) else None


class Mask(types.Type):
    """`width` lanes of true or false. It cannot be branched on: that is `where`'s work."""

    def __init__(self, width: int):
        self.width = width
        super().__init__(f"Mask({width})")

    @property
    def llvm(self) -> ir.Type:
        """Return the LLVM type."""
        return ir.VectorType(ir.IntType(1), self.width)


class Word(types.Type):
    """`width` lanes of unsigned 32-bit integers, for random numbers."""

    def __init__(self, width: int):
        self.width = width
        super().__init__(f"Word({width})")

    @property
    def llvm(self) -> ir.Type:
        """Return the LLVM type."""
        return _vector(INT32, self.width)


class Vec3Type(types.Type):
    """Three `Real`s."""

    def __init__(self, element: Real):
        self.element = element
        super().__init__(f"Vec3({element})")

    def can_convert_from(self, context: Any, other: types.Type) -> Conversion | None:
        """Accept a vector whose elements convert."""
        return self.element.can_convert_from(context, other.element) if isinstance(other, Vec3Type) else None


@register_model(Real)
@register_model(Mask)
@register_model(Word)
class _LaneModel(models.PrimitiveModel):
    def __init__(self, manager: Any, type_: Any):
        super().__init__(manager, type_, type_.llvm)


@register_model(Vec3Type)
class _Vec3Model(models.StructModel):
    def __init__(self, manager: Any, type_: Vec3Type):
        super().__init__(manager, type_, [(name, type_.element) for name in "xyz"])


for _name in "xyz":
    make_attribute_wrapper(Vec3Type, _name, _name)


def constant(type_: ir.Type, value: float) -> ir.Constant:
    """Return the same constant in every lane."""
    return ir.Constant(type_, [value] * type_.count if isinstance(type_, ir.VectorType) else value)


def splat(builder: ir.IRBuilder, scalar: ir.Value, type_: ir.Type) -> ir.Value:
    """Return a scalar in every lane of `type_`."""
    if not isinstance(type_, ir.VectorType):
        return scalar
    first = builder.insert_element(ir.Constant(type_, ir.Undefined), scalar, ir.Constant(INT32, 0))
    zeros = ir.Constant(ir.VectorType(INT32, type_.count), [0] * type_.count)
    return builder.shuffle_vector(first, ir.Constant(type_, ir.Undefined), zeros)


def convert(context: Any, builder: ir.IRBuilder, value: ir.Value, source: types.Type, target: Real) -> ir.Value:
    """Bring a number, a `Real` of width 1, or float64 lanes that are literals, to `target`."""
    if source == target:
        return value
    if isinstance(source, Real):
        if target.single and not source.single:
            value = builder.fptrunc(value, _vector(ir.FloatType(), source.width))
        return value if source.width == target.width else splat(builder, value, target.llvm)
    return splat(builder, context.cast(builder, value, source, target.dtype), target.llvm)


@lower_cast(types.Number, Real)
@lower_cast(Real, Real)
def _cast(context: Any, builder: ir.IRBuilder, source: types.Type, target: Real, value: ir.Value) -> ir.Value:
    return convert(context, builder, value, source, target)


def joined(arguments: Any) -> Real | None:
    """Return the `Real` at which these meet: float32 if any is; None if there is none or one is no number."""
    reals = [argument for argument in arguments if isinstance(argument, Real)]
    if not reals or not all(isinstance(argument, (Real, types.Number)) for argument in arguments):
        return None
    dtype = types.float32 if any(real.single for real in reals) else types.float64
    return Real(dtype, max(real.width for real in reals))


def literal_lanes(arguments: Any, width: int) -> Real | None:
    """Return the type of lanes chosen or made from plain numbers alone, or None if one is something else."""
    return Real(types.float64, width) if all(isinstance(argument, types.Number) for argument in arguments) else None
