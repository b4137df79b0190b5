"""The tables of a mesh on lanes: `graphfx.math.tables` as loads from addresses.

A mesh is the address of a list of int64, two for each table: where it lies, its rows. Entries are reals of the lanes'
own precision, or whole numbers of as many bits.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.datamodel import models
from numba.core.datamodel.registry import register_default as register_model
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin

from graphfx.lanes.operands import LINE
from graphfx.lanes.types import INT32, INT64, Real, constant, convert
from graphfx.lanes.types import splat as _splat
from graphfx.math import tables

FIELDS = 2
"""Numbers that the list holds for each table: address, rows."""


class Tables(types.Type):
    """The tables of a mesh for lanes of one kind."""

    def __init__(self, real: Real):
        self.real = real
        super().__init__(f"Tables({real})")


@register_model(Tables)
class _TablesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, type_: Any):
        super().__init__(manager, type_, INT64)


@intrinsic(prefer_literal=True)
def read_mesh(typing: Any, model: Any, scratch: Any, operands: Any, place: Any, lane: Any) -> Any:
    """Return a mesh: its address lies in the scratch as two words, each splatted over a line."""
    real = model.instance_type
    if not isinstance(place, types.IntegerLiteral):
        return None
    first = place.literal_value

    def generate(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
        offset = builder.load(builder.gep(values[2], [ir.Constant(INT64, first)]))
        integer = INT32 if real.single else INT64
        halves = []
        for k in (0, 1):
            index = builder.add(offset, ir.Constant(INT64, k * LINE[real.single]))
            word = builder.load(builder.bitcast(builder.gep(values[1], [index]), integer.as_pointer()))
            halves.append(builder.zext(word, INT64) if real.single else word)
        return builder.or_(halves[0], builder.shl(halves[1], ir.Constant(INT64, 32)))

    return Tables(real)(model, scratch, operands, place, types.int64), generate


def _field(builder: ir.IRBuilder, mesh: ir.Value, table: int, field: int) -> ir.Value:
    pointer = builder.inttoptr(mesh, INT64.as_pointer())
    return builder.load(builder.gep(pointer, [ir.Constant(INT64, (table >> 6) * FIELDS + field)]))


def _define(function: Any, kinds: tuple[Any, ...], result: Callable[..., types.Type], generate: Callable[..., Any]) -> None:
    """Define a function of tables: `generate(context, builder, sig, values)` gives LLVM code."""

    @infer_global(function)
    class _Rule(AbstractTemplate):
        prefer_literal = True

        def generic(self, args: Any, kws: Any) -> Any:
            if len(args) == len(kinds) and all(isinstance(a, k) for a, k in zip(args, kinds, strict=True)):
                return signature(result(*args), *args)

    lower_builtin(function, *kinds)(generate)


def _element(builder: ir.IRBuilder, mesh: ir.Value, sig: Any, index: ir.Value, type_: ir.Type) -> ir.Value:
    """Load entry (index, column) of a table; table and column are the second and fourth arguments, both literals."""
    table, column = sig.args[1].literal_value, sig.args[3].literal_value
    place = builder.add(builder.mul(index, ir.Constant(INT64, table & 63)), ir.Constant(INT64, column))
    base = builder.inttoptr(_field(builder, mesh, table, 0), type_.as_pointer())
    return builder.load(builder.gep(base, [place]))


def _gather(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    real = sig.return_type
    row = convert(context, builder, values[2], sig.args[2], real)
    count = builder.sitofp(_field(builder, values[0], sig.args[1].literal_value, 1), real.dtype_llvm)
    nought = constant(real.llvm, 0.0)
    there = builder.and_(builder.fcmp_ordered(">=", row, nought),
                         builder.fcmp_ordered("<", row, _splat(builder, count, real.llvm)))
    index = builder.fptosi(builder.select(there, row, nought), real.llvm_integer)
    if real.width == 1:
        return _element(builder, values[0], sig, builder.sext(index, INT64) if real.single else index, real.dtype_llvm)
    made: Any = ir.Constant(real.llvm, ir.Undefined)
    for lane in range(real.width):
        place = builder.extract_element(index, ir.Constant(INT32, lane))
        found = _element(builder, values[0], sig, builder.sext(place, INT64) if real.single else place, real.dtype_llvm)
        made = builder.insert_element(made, found, ir.Constant(INT32, lane))
    return made


def _rows(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    real = sig.return_type
    return _splat(builder, builder.sitofp(_field(builder, values[0], sig.args[1].literal_value, 1), real.dtype_llvm), real.llvm)


def _turn(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    real = sig.return_type
    low, high = cgutils.unpack_tuple(builder, values[0], 2)
    count = _field(builder, values[1], sig.args[2].literal_value, 1)
    count = builder.select(builder.icmp_signed(">", count, ir.Constant(INT64, 0)), count, ir.Constant(INT64, 1))
    made: Any = ir.Constant(real.llvm, ir.Undefined)
    for lane in range(real.width):
        halves = [part if real.width == 1 else builder.extract_element(part, ir.Constant(INT32, lane)) for part in (low, high)]
        wide = [builder.zext(half, INT64) for half in halves]
        identity = builder.or_(wide[0], builder.shl(wide[1], ir.Constant(INT64, 32)))
        place = builder.uitofp(builder.urem(identity, count), real.dtype_llvm)
        made = place if real.width == 1 else builder.insert_element(made, place, ir.Constant(INT32, lane))
    return made


def _entry(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    index = context.cast(builder, values[2], sig.args[2], types.int64)
    return _element(builder, values[0], sig, index, sig.return_type.dtype_llvm)


def _link(context: Any, builder: ir.IRBuilder, sig: Any, values: Any) -> ir.Value:
    index = context.cast(builder, values[2], sig.args[2], types.int64)
    single = sig.args[0].real.single
    found = _element(builder, values[0], sig, index, INT32 if single else INT64)
    return builder.sext(found, INT64) if single else found


_LITERAL = types.IntegerLiteral
_define(tables.gather, (Tables, _LITERAL, Real, _LITERAL),
        lambda mesh, table, row, column: Real(mesh.real.dtype, row.width), _gather)
_define(tables.rows, (Tables, _LITERAL), lambda mesh, table: mesh.real, _rows)
_define(tables.turn, (types.UniTuple, Tables, _LITERAL), lambda identity, mesh, table: mesh.real, _turn)
_define(tables.entry, (Tables, _LITERAL, types.Integer, _LITERAL),
        lambda mesh, table, row, column: Real(mesh.real.dtype, 1), _entry)
_define(tables.link, (Tables, _LITERAL, types.Integer, _LITERAL), lambda mesh, table, row, column: types.int64, _link)
