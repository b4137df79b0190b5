"""The program of births: what an emitter's `set` gives a new particle."""

from __future__ import annotations

from graphfx.graph.flat import FlatNode
from graphfx.motion import basic
from graphfx.node import ATTRIBUTES
from graphfx.plan.liveness import Attributes, birth_order, set_value
from graphfx.plan.rates import Rate, Scope, lane_type, rate_of
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Column, Operand, Program


def write_birth(emitter: FlatNode, attributes: Attributes, seed: int, precision: int) -> Program:
    """Return the program that fills the columns of new rows. It loads `birth_time` [s] and `birth_id`, by place."""
    builder = Builder.begin(f"{emitter.path}: birth")
    stored = [name for name in attributes.columns if name in ATTRIBUTES]
    found: dict[str, Operand] = {}
    scope = Scope(seed, emitter.path, found.__getitem__, lambda: builder.load("birth_id", "id"), lambda name: name in found)
    clock: dict[str, Operand] = {}
    writer = ValueWriter(builder, scope, clock, None, precision)
    for name in birth_order(emitter, stored):
        value = set_value(emitter, name)
        builder.note = f"{emitter.path}.{name}"
        if rate_of(value, scope) >= Rate.STEP:
            clock["time"] = builder.load("birth_time", "float")
        found[name] = writer.argument(value)
        if name in stored:
            builder.store(name, as_column(builder, found[name], lane_type(ATTRIBUTES[name].type), name))
    return builder.program


def as_column(builder: Builder, operand: Operand, type_: str, name: str) -> Column:
    """Return an operand as a column that can be stored."""
    if isinstance(operand, Column):
        return operand
    function = basic.copy_vector if type_ == "vec3" else basic.copy_number
    made = Column(name, type_)
    builder.call(function, operand, into=made)
    return made
