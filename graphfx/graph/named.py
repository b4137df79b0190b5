"""Named values: `"values": {"gusty": {...}}` on a graph or an emitter, each after those that it refers to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking
from graphfx.graph.functions import CALLED, CONSTANTS
from graphfx.graph.items import Item
from graphfx.graph.lexer import KEYWORDS, QUALIFIERS, names_in
from graphfx.graph.names import WORD
from graphfx.graph.scope import ALWAYS, READABLE, Scope
from graphfx.graph.values import Value
from graphfx.node.types import Parameter

TAKEN = frozenset({*ALWAYS, *READABLE, *CALLED, *CONSTANTS, *QUALIFIERS, *KEYWORDS, "id"})


class NamedValues:
    """The named values of one owner; `outer` are those of the graph around an emitter."""

    def __init__(self, checking: Checking, reader: ValueReader, item: Item | None, scope: Scope,
                 outer: NamedValues | None = None):
        """Note the names; `scope` is the owner's, and its values may refer to one another."""
        self.checking, self.reader, self.outer = checking, reader, outer
        self.items: dict[str, Item] = {}
        self.known: dict[str, Value | None] = {}
        path = f"{scope.path}.values" if scope.path else "values"
        if item is not None and not item.is_object:
            checking.mismatch(item, path, "\"values\" should be an object of named values")
        for name, given in item.entries() if item is not None else ():
            taken = name in TAKEN or name in scope.own or name in scope.clusters
            if not WORD.fullmatch(name) or taken:
                why = "already means something in expressions" if taken else "is not made of letters, digits and '_'"
                checking.complain(item.key_location(name), f"{path}.{name}",  # type: ignore[union-attr]
                                  f"a value cannot be called '{name}', which {why}; choose another name")
            else:
                self.items[name] = given
        names = dict.fromkeys([*self.items, *(outer.scope.names if outer else ())])
        self.scope: Scope = replace(scope, named=self.get, names=names, uniform="", qualifiers=scope.qualifiers - {"birth"})
        self.path = path
        inside = replace(self.scope, shared=True)
        for name in self._order():
            self.known[name] = self.reader.read(self.items[name], Parameter(name, "", None), inside, f"values.{name}")

    def get(self, name: str) -> Value | None:
        """Return a named value, or None where it is wrong, which has been told."""
        if name in self.items or self.outer is None:
            return self.known.get(name)
        return self.outer.get(name)

    def _order(self) -> list[str]:
        """Return the names, each after those that its expressions read; complain of circles and leave them out."""
        order: dict[str, None] = {}
        for start in self.items:
            trail = {start: iter(self._reads(start))} if start not in order else {}
            while trail:
                name = next(reversed(trail))
                read = next(trail[name], None)
                if read is None:
                    del trail[name]
                    order[name] = None
                elif read in trail:
                    self._circle(list(trail), read)
                elif read not in order:
                    trail[read] = iter(self._reads(read))
        return list(order)

    def _circle(self, trail: list[str], name: str) -> None:
        circle = " -> ".join([*trail[trail.index(name):], name])
        self.checking.complain(self.items[name].location, f"{self.path}.{name}",
                               f"these values refer to one another in a circle: {circle}; break it at one of them")

    def _reads(self, name: str) -> list[str]:
        return [word for text in _expressions(self.items[name]) for word in names_in(text) if word in self.items]


def _expressions(item: Item) -> Iterator[str]:
    """Yield the texts of all expressions in a value."""
    parts = list(item.value.values()) if isinstance(item.value, dict) else item.value if isinstance(item.value, list) else []
    for key, part in item.entries():
        if key in ("expr", "over") and part.is_text:
            yield part.value
    for part in parts:
        yield from _expressions(part)
