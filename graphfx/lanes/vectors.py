"""`Vec3` on lanes: construction, operators, and the helpers of `graphfx.math.vec3`.

`dot` and `cross` are spelled out in the order of the plain-Python functions, so bits agree.
"""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import lower_builtin, lower_cast, type_callable

from graphfx.lanes.define import define_vector
from graphfx.lanes.types import Mask, Real, Vec3Type, convert, joined, literal_lanes
from graphfx.math import primitives, vec3


@type_callable(vec3.Vec3)
def _type_vec3(context: Any) -> Any:
    def typer(x: Any, y: Any, z: Any) -> Any:
        real = joined((x, y, z)) or literal_lanes((x, y, z), 1)
        return None if real is None else Vec3Type(real)

    return typer


@lower_builtin(vec3.Vec3, types.Any, types.Any, types.Any)
def _make_vec3(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    proxy = cgutils.create_struct_proxy(sig.return_type)(context, builder)
    for name, value, type_ in zip("xyz", values, sig.args, strict=True):
        setattr(proxy, name, convert(context, builder, value, type_, sig.return_type.element))
    return proxy._getvalue()


@lower_cast(Vec3Type, Vec3Type)
def _cast(context: Any, builder: ir.IRBuilder, source: Vec3Type, target: Vec3Type, value: ir.Value) -> ir.Value:
    given = cgutils.create_struct_proxy(source)(context, builder, value=value)
    made = cgutils.create_struct_proxy(target)(context, builder)
    for name in "xyz":
        setattr(made, name, convert(context, builder, getattr(given, name), source.element, target.element))
    return made._getvalue()


def _each(name: str) -> Any:
    return lambda builder, p, q: [getattr(builder, name)(x, y) for x, y in zip(p, q, strict=True)]


for _operator, _in_place, _name in ((operator.add, operator.iadd, "fadd"), (operator.sub, operator.isub, "fsub")):
    define_vector(_operator, (Vec3Type, Vec3Type), _each(_name), Vec3Type)
    define_vector(_in_place, (Vec3Type, Vec3Type), _each(_name), Vec3Type)
define_vector(operator.neg, (Vec3Type,), lambda builder, p: [builder.fneg(x) for x in p], Vec3Type)
for _scalar in (Real, types.Number):
    define_vector(operator.mul, (Vec3Type, _scalar), lambda builder, p, k: [builder.fmul(x, k) for x in p], Vec3Type)
    define_vector(operator.imul, (Vec3Type, _scalar), lambda builder, p, k: [builder.fmul(x, k) for x in p], Vec3Type)
    define_vector(operator.mul, (_scalar, Vec3Type), lambda builder, k, p: [builder.fmul(x, k) for x in p], Vec3Type)
    define_vector(operator.truediv, (Vec3Type, _scalar), lambda builder, p, k: [builder.fdiv(x, k) for x in p], Vec3Type)


def _select(builder: ir.IRBuilder, condition: ir.Value, p: Any, q: Any) -> list[ir.Value]:
    return [builder.select(condition, x, y) for x, y in zip(p, q, strict=True)]


for _condition in (Mask, types.Boolean):
    define_vector(primitives.where, (_condition, Vec3Type, Vec3Type), _select, Vec3Type)
