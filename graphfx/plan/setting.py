"""Write the operators that give attributes new values: `set`, `fade` and those that assign."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Any

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Literal, Name
from graphfx.motion import basic, events
from graphfx.plan.rounding import LEAST
from graphfx.plan.values import ValueWriter, node_function
from graphfx.program import Builder, Column, Operand, Uniform

MOVED = ("position", "velocity")


def as_column(builder: Builder, operand: Operand, type_: str, name: str, always: bool = False) -> Column:
    """Return an operand as a column that can be stored; with `always` as one of its own."""
    if isinstance(operand, Column) and not always:
        return operand
    made = Column(name, type_)
    builder.call(basic.copy_of(type_), operand, into=made)
    return made


@dataclass
class Setting:
    """One such operator at one moment.

    `column` finds the column of an attribute; `writer` makes what finds values as they are now, so that each
    attribute of a `set` may read those that it set before. A particle at rest that it moves is at rest no more:
    `resting` says who is.
    """

    node: FlatNode
    writer: Callable[[], ValueWriter]
    builder: Builder
    column: Callable[[str], Any]
    dt: Operand | None = None
    resting: Column | None = None

    def targets(self, live: Collection[str]) -> list[str]:
        """Return the attributes that it gives and that are stored."""
        return [name for name in self.node.gives if name in live]

    def write(self, live: Collection[str]) -> Builder | None:
        """Write new values into the columns; return the builder under the operator's conditions, None if it gives nothing."""
        names = self.targets(live)
        if not names:
            return None
        self.builder.note = self.node.path
        inside = under_conditions(self.node, self.writer(), self.builder)
        moved = [name for name in MOVED if name in names] if self.resting is not None else []
        before = {name: inside.call(basic.copy_vector, self.column(name), name=f"{name} before") for name in moved}
        self._give(inside, names, live)
        for name, old in before.items():
            assert self.resting is not None
            differs = inside.call(events.differs, old, self.column(name), name="moved")
            context = self.builder.under(self.builder.program.context)
            context.call(basic.but_not, self.resting, differs, into=self.resting)
        return inside

    def _give(self, inside: Builder, names: list[str], live: Collection[str]) -> None:
        if self.node.node_type.role == "assign":
            self._assign(inside, live)
            return
        for name in names:
            writer, into = self.writer(), self.column(name)
            value = writer.argument(self.node.sets[name])
            if self.node.node_type.role == "fade":
                rate = writer.argument(self.node.arguments["rate"])
                function = events.faded_vector if into.type == "vec3" else events.faded_number
                dt = self.dt or Uniform("0", "float", 0.0)
                inside.call(function, into, value, rate, dt, LEAST[writer.precision], into=into)
            else:
                inside.call(basic.copy_of(into.type), value, into=into)

    def _assign(self, inside: Builder, live: Collection[str]) -> None:
        node_type, writer = self.node.node_type, self.writer()
        operands: list[Operand] = []
        for name in node_type.arguments:
            if name in self.node.arguments:
                operands.append(writer.argument(self.node.arguments[name]))
            elif name in self.node.references:
                operands.append(writer.operand(Literal("mesh", value=self.node.references[name])))
            else:
                operands.append(writer.operand(Name(name)))
        function = node_function(node_type)
        results = inside.call(function, *operands, name=node_type.name)
        results = results if isinstance(results, tuple) else (results,)
        for name, result in zip(node_type.writes, results, strict=True):
            if name in live:
                into = self.column(name)
                inside.call(basic.copy_of(into.type), result, into=into)


def under_conditions(node: FlatNode, writer: ValueWriter, builder: Builder) -> Builder:
    """Return the builder under a node's `during` and `only`."""
    if node.during is not None:
        ends = [writer.operand(float(time)) for time in node.during]
        within = builder.call(basic.is_within, writer.operand(Name("time")), *ends, name="during")
        builder = builder.under(builder.call(basic.both, builder.mask, within), builder.note)
    if node.only is not None:
        only = writer.operand(node.only)
        builder = builder.under(builder.call(basic.both, builder.mask, only, name="only"), builder.note)
    return builder
