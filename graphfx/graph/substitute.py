"""Put what the parameters were given into a tree of values, and give each value its seed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from graphfx.graph.check_values import default_value
from graphfx.graph.checking import Checking
from graphfx.graph.fold import constant, fold
from graphfx.graph.items import shown
from graphfx.graph.literals import lane, not_chosen, out_of_range
from graphfx.graph.model import Entry
from graphfx.graph.names import SCOPES
from graphfx.graph.values import (
    Call,
    Expression,
    Literal,
    Member,
    Node,
    ParameterValue,
    Ramp,
    Random,
    Value,
    measure,
)
from graphfx.node.types import Parameter


@dataclass
class Substitution:
    """What stands for the parameters of one instance of a graph.

    `prefix` and `place` are the instance's path with a slash, or '', the first as seeds have it; `nodes` are the
    graph's, among which conditions name selectors.

    Values that are shared stay shared: each is substituted once.
    """

    checking: Checking
    given: Mapping[str, Value]
    prefix: str = ""
    nodes: Mapping[str, Entry] = field(default_factory=dict)
    place: str = ""
    _done: dict[int, tuple[Any, Any]] = field(default_factory=dict)

    def seed(self, seed: str) -> str:
        """Return the path that keys random numbers: of the instance, unless a `seed_key` states it whole."""
        return seed[1:] if seed.startswith("=") else self.prefix + seed

    def value(self, value: Value, want: Parameter | None = None) -> Value:
        """Return a value without parameters; complain where it is constant and out of `want`'s range."""
        result = self._typed(self._value(value), value.type)
        if want is not None and isinstance(result, Literal):
            self._check(result, value, want)
        size = measure(result)
        limits = self.checking.limits
        if size.size > limits.value_size or size.depth > limits.expression_depth:
            self.checking.complain(value.location, value.path,
                                   f"with its parameters the value has {size.size:,} parts, {size.depth} deep; "
                                   f"the limits are {limits.value_size:,} and {limits.expression_depth}")
            return Literal(value.type, value.location, value.path, "", (0.0, 0.0, 0.0) if lane(value.type) == "vec3" else 0.0)
        return result

    def argument(self, entry: Entry, parameter: Parameter) -> Value | None:
        """Return what a node states for a parameter, or None; a mesh is a literal with the path of the geometry."""
        if parameter.name in entry.references:
            target, location = entry.references[parameter.name]
            return Literal(parameter.type, location, f"{entry.path}.{parameter.name}", "", self.place + target)
        given = entry.arguments.get(parameter.name)
        return None if given is None else self.value(given, parameter)

    def selector(self, name: str) -> Node:
        """Return the test of a selector node: wherever it is used, it draws the same numbers."""
        entry = self.nodes[name]
        known = self._done.get(id(entry))
        if known is None:
            parameters = entry.node_type.parameters  # type: ignore[union-attr]
            arguments = tuple(
                (parameter.name, self.argument(entry, parameter)
                 or default_value(parameter, f"{entry.path}.{parameter.name}")) for parameter in parameters.values())
            test = Node("bool", entry.location, entry.path, self.seed(entry.seed), entry.node_type, arguments,
                        entry.per or SCOPES[0])
            known = self._done[id(entry)] = (entry, test)
        return known[1]  # type: ignore[no-any-return]

    def _check(self, result: Literal, value: Value, want: Parameter) -> None:
        message = out_of_range(result.value, want)
        if not message and not_chosen(result.value, want):
            message = f"{want.name} should be one of {', '.join(want.choices)}, not {shown(str(result.value))}"
        if not message and want.type == "direction" and not any(result.value):
            message = f"{want.name} is a direction, and [0, 0, 0] points nowhere"
        if message and not isinstance(value, Literal):
            origin = f"from the parameter '{value.name}'" if isinstance(value, ParameterValue) else "as this expression gives it"
            self.checking.complain(value.location, value.path, f"{message} ({origin})")
        if want.type == "int" and isinstance(result.value, float):
            whole = result.value.is_integer()
            if not whole:
                self.checking.complain(value.location, value.path, f"{want.name} should be a whole number, not {result.value}")

    def _typed(self, value: Value, kind: str) -> Value:
        if value.type == kind:
            return value
        if kind == "int" and isinstance(value, Literal) and float(value.value).is_integer():
            return replace(value, type=kind, value=int(value.value))
        return replace(value, type=kind)

    def _value(self, value: Value) -> Value:
        known = self._done.get(id(value))
        if known is None:
            known = self._done[id(value)] = (value, self._new(value))
        result: Value = known[1]
        return result

    def _new(self, value: Value) -> Value:
        match value:
            case ParameterValue():
                return self._parameter(value)
            case Expression():
                return self._expression(value)
            case Literal(type="selector"):
                return self.selector(value.value)
            case Literal(type="mesh"):
                return replace(value, value=self.place + value.value)
            case Member():
                return replace(value, value=self._value(value.value))  # type: ignore[arg-type]
            case Ramp():
                return replace(value, over=self._value(value.over), seed=self.seed(value.seed))  # type: ignore[arg-type]
            case Random():
                low, high = self._value(value.low), self._value(value.high)  # type: ignore[arg-type]
                return replace(value, low=low, high=high, seed=self.seed(value.seed))
            case Node():
                parameters = value.node_type.parameters  # type: ignore[union-attr]
                arguments = tuple((name, self.value(argument, parameters[name])) for name, argument in value.arguments)
                return replace(value, arguments=arguments, seed=self.seed(value.seed))
        return replace(value, seed=self.seed(value.seed)) if value.seed else value

    def _parameter(self, value: ParameterValue) -> Value:
        given = self.given[value.name]
        if value.component:
            ends = constant(given)
            return Literal("float", value.location, value.path, "", ends[0 if value.component == "start" else 1])
        return given

    def _expression(self, value: Expression) -> Value:
        tree = self._tree(value.tree)
        known = constant(tree)
        if known is not None:
            return Literal(value.type, value.location, value.path, "", known)
        if isinstance(tree, Value):
            return self._typed(tree, value.type)
        return replace(value, tree=tree, seed=self.seed(value.seed))

    def _tree(self, tree: Any) -> Any:
        if isinstance(tree, Value):
            result: Any = self._value(tree)
            known = constant(result)
            return known if isinstance(known, float | bool) else float(known) if isinstance(known, int) else result
        if isinstance(tree, Call):
            done = self._done.get(id(tree))
            if done is None:
                arguments = tuple(self._tree(part) for part in tree.arguments)
                done = self._done[id(tree)] = (tree, fold(Call(tree.function, arguments)))
            return done[1]
        return tree


def both(first: Value | None, second: Value | None) -> Value | None:
    """Return the condition that two conditions hold, either of which may be missing."""
    if first is None or second is None:
        return second if first is None else first
    return Expression("bool", second.location, second.path, second.seed, Call("and", (first, second)))


def overlap(first: tuple[float, float] | None, second: tuple[float, float] | None) -> tuple[float, float] | None:
    """Return the time in both of two intervals, either of which may be missing; an empty one ends where it starts."""
    if first is None or second is None:
        return second if first is None else first
    start = max(first[0], second[0])
    return start, max(start, min(first[1], second[1]))
