"""The program of births: what an emitter's `set` gives a new particle."""

from __future__ import annotations

from graphfx.graph.flat import FlatNode
from graphfx.motion import basic
from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES
from graphfx.plan.frame_program import FrameProgram, LazyClock
from graphfx.plan.liveness import Attributes, birth_order, set_value
from graphfx.plan.rates import Scope, lane_type
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Column, Operand, Uniform


def write_birth(emitter: FlatNode, attributes: Attributes, seed: int, precision: int) -> FrameProgram:
    """Return the program that fills the columns of new rows. It loads `birth_time` [s] and `birth_id`, by place."""
    builder = Builder.begin(f"{emitter.path}: birth")
    made = FrameProgram(builder.program, [])
    stored = [name for name in attributes.columns if name in ATTRIBUTES]
    found: dict[str, Operand] = {name: Uniform("0", "float", 0.0) for name in DERIVED_ATTRIBUTES}
    scope = Scope(seed, emitter.path, found.__getitem__, lambda: builder.load("birth_id", "id"), lambda name: name in found)
    clock = LazyClock(
        {
            "time": lambda: builder.load("birth_time", "float"),
            "frame": lambda: made.time(builder, "frame"),
            "frame word": lambda: made.time(builder, "frame word"),
        },
        lambda path: made.mesh(builder, path),
    )
    writer = ValueWriter(builder, scope, clock, None, precision)
    for name in birth_order(emitter, stored):
        builder.note = f"{emitter.path}.{name}"
        found[name] = writer.argument(set_value(emitter, name))
        if name in stored:
            builder.store(name, as_column(builder, found[name], lane_type(ATTRIBUTES[name].type), name))
    return made


def as_column(builder: Builder, operand: Operand, type_: str, name: str) -> Column:
    """Return an operand as a column that can be stored."""
    if isinstance(operand, Column):
        return operand
    function = basic.copy_vector if type_ == "vec3" else basic.copy_number
    made = Column(name, type_)
    builder.call(function, operand, into=made)
    return made
