"""Named values: `"values": {"gusty": {...}}` on a graph or an emitter, read when first referred to."""

from __future__ import annotations

from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking
from graphfx.graph.expressions import KEYWORDS, QUALIFIERS
from graphfx.graph.functions import CALLED, CONSTANTS
from graphfx.graph.items import Item
from graphfx.graph.names import WORD
from graphfx.graph.scope import ALWAYS, READABLE, Scope
from graphfx.graph.values import Value
from graphfx.node.types import Parameter

_TAKEN = frozenset({*ALWAYS, *READABLE, *CALLED, *CONSTANTS, *QUALIFIERS, *KEYWORDS, "id"})


class NamedValues:
    """The named values of one owner; `outer` are those of the graph around an emitter."""

    def __init__(self, checking: Checking, reader: ValueReader, item: Item | None, scope: Scope,
                 outer: NamedValues | None = None):
        """Note the names; `scope` is the owner's, and its values may refer to one another."""
        self.checking, self.reader, self.outer = checking, reader, outer
        self.items: dict[str, Item] = {}
        self.known: dict[str, Value | None] = {}
        self.asking: list[str] = []
        path = f"{scope.path}.values" if scope.path else "values"
        if item is not None and not item.is_object:
            checking.mismatch(item, path, "\"values\" should be an object of named values")
        for name, given in item.entries() if item is not None else ():
            if not WORD.fullmatch(name) or name in _TAKEN:
                why = "already means something in expressions" if name in _TAKEN else "is not made of letters, digits and '_'"
                checking.complain(item.key_location(name), f"{path}.{name}",  # type: ignore[union-attr]
                                  f"a value cannot be called '{name}', which {why}; choose another name")
            else:
                self.items[name] = given
        names = frozenset(self.items) | (outer.names if outer else frozenset())
        self.scope = Scope(scope.path, scope.seed, scope.params, self.get, names, broken=scope.broken)

    @property
    def names(self) -> frozenset[str]:
        """Return all names in reach."""
        return self.scope.names

    def get(self, name: str) -> Value | None:
        """Return a named value, or None where it is wrong, which has been told."""
        if name not in self.items:
            return self.outer.get(name) if self.outer else None
        if name in self.asking:
            cycle = " -> ".join([*self.asking[self.asking.index(name):], name])
            item = self.items[name]
            path = f"{self.scope.path}.values.{name}" if self.scope.path else f"values.{name}"
            self.checking.complain(item.location, path,
                                   f"these values refer to one another in a circle: {cycle}; break it at one of them")
            return None
        if name not in self.known:
            self.asking.append(name)
            self.known[name] = self.reader.read(self.items[name], Parameter(name, "", None), self.scope, f"values.{name}")
            self.asking.pop()
        return self.known[name]

    def read_all(self) -> None:
        """Read also those that nothing refers to, so that their mistakes are told."""
        for name in self.items:
            self.get(name)
