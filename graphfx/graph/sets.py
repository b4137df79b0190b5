"""Attributes given inside `"set": {...}`, in order of dependence."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphfx.errors import suggestion
from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking
from graphfx.graph.items import Item
from graphfx.graph.model import Entry
from graphfx.graph.scope import Scope
from graphfx.graph.values import Name, Node, Value, children
from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES, OTHER_NAMES, Parameter


def attributes_read(tree: Any, seen: set[int] | None = None) -> Iterator[str]:
    """Yield the attributes that a value reads where it stands."""
    seen = set() if seen is None else seen
    if id(tree) in seen:
        return
    seen.add(id(tree))
    if isinstance(tree, Name) and tree.name in ATTRIBUTES:
        yield tree.name
    elif isinstance(tree, Name) and tree.name == "normalized_age":
        yield "life"
    elif isinstance(tree, Node) and tree.node_type is not None:
        yield from tree.node_type.reads
    for part in children(tree):
        yield from attributes_read(part, seen)


class AttributeReader:
    """Reads one `set`."""

    def __init__(self, checking: Checking, reader: ValueReader):
        """Complain to `checking`."""
        self.checking, self.reader = checking, reader

    def read(self, entry: Entry, item: Item | None, scope: Scope) -> None:
        """Fill `entry.sets`."""
        path = f"{entry.path}.set"
        if item is None or not item.is_object:
            if item is not None:
                self.checking.mismatch(item, path, "\"set\" should be an object of attributes")
            elif entry.role == "set":
                self.checking.complain(entry.location, entry.path, 'set needs "set": {attribute: value, ...}')
            return
        parameters = entry.node_type.parameters if entry.node_type else {}
        sets: dict[str, Value] = {}
        for name, given in item.entries():
            location, at = item.key_location(name), f"{path}.{name}"
            if name in parameters:
                self.checking.complain(location, at,
                                       f"'{name}' is a parameter of {entry.type_name}; write it beside \"set\", not inside")
            elif name in DERIVED_ATTRIBUTES:
                self.checking.complain(location, at, f"'{name}' follows from birth and life and cannot be set")
            elif name not in ATTRIBUTES:
                self.checking.complain(location, at,
                                       f"there is no attribute '{name}'." + suggestion(name, ATTRIBUTES, OTHER_NAMES),
                                       f"attributes: {', '.join(ATTRIBUTES)}")
            else:
                attribute = ATTRIBUTES[name]
                want = Parameter(name, attribute.type, attribute.default, attribute.unit)
                value = self.reader.read(given, want, scope, f"set.{name}")
                if value is not None:
                    sets[name] = value
        entry.sets = self._ordered(entry, sets, parameters, item)

    def _ordered(self, entry: Entry, sets: dict[str, Value], parameters: dict[str, Parameter], item: Item) -> dict[str, Value]:
        """Return the values so that each comes after those that it reads; complain of circles.

        The operator `set` may read the attribute that it sets: that is its value before. At birth there is none.
        """
        reads = {name: {other for other in attributes_read(value) if other in sets} for name, value in sets.items()}
        ordered: dict[str, Value] = {}
        trail: list[str] = []

        def visit(name: str) -> None:
            if name in ordered:
                return
            if name in trail:
                cycle = [*trail[trail.index(name):], name]
                what = (f"'{name}' reads itself, and at birth it has no value yet; let it read others" if len(cycle) == 2
                        else f"these attributes read one another in a circle: {' -> '.join(cycle)}")
                self.checking.complain(item.key_location(name), f"{entry.path}.set.{name}",
                                       what + "; give one of them a value of its own" * (len(cycle) > 2))
                return
            trail.append(name)
            others = reads[name] - ({name} if entry.role == "set" else set())
            for other in sets:
                if other in others:
                    visit(other)
            trail.pop()
            ordered[name] = sets[name]

        for name in sets:
            visit(name)
        return ordered
