"""Attributes given inside `"set": {...}`, in order of dependence."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from types import MappingProxyType

from graphfx.errors import Location, suggestion
from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking, listed
from graphfx.graph.dependence import in_order
from graphfx.graph.items import Item
from graphfx.graph.model import Entry
from graphfx.graph.names import TAIL, WORD
from graphfx.graph.scope import Scope
from graphfx.graph.values import Node, Value
from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES, OTHER_NAMES, Attribute, NodeType, Parameter

_COUNTED = ("hits", "lives", "generation")


def wanted_of(name: str, own: Mapping[str, Attribute] = MappingProxyType({})) -> Parameter:
    """Return what an attribute, of graphfx or a graph's own, may be given; what is set of the tail alone is as the attribute."""
    attribute = own.get(name) or ATTRIBUTES[name.removeprefix("tail.")]
    return Parameter(name, attribute.type, attribute.default, attribute.unit, doc=attribute.doc)


def _declaration(name: str) -> str:
    """Return how a graph would declare an attribute of its own, where it may have such a name."""
    return f' A graph declares its own: "attributes": {{"{name}": {{"type": "float"}}}}' if WORD.fullmatch(name) else ""


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
            elif entry.role in ("set", "fade"):
                self.checking.complain(entry.location, entry.path, f'{entry.type_name} needs "set": {{attribute: value, ...}}')
            in_order(self.checking, entry, {}, None)
            return
        parameters = entry.node_type.parameters if entry.node_type else {}
        sets: dict[str, Value] = {}
        for name, given in item.entries():
            location, at = item.key_location(name), f"{path}.{name}"
            own = scope.own.get(name)
            if name in parameters and own is None:
                self.checking.complain(location, at,
                                       f"'{name}' is a parameter of {entry.type_name}; write it beside \"set\", not inside")
            elif name in DERIVED_ATTRIBUTES:
                self.checking.complain(location, at, f"'{name}' follows from birth and life and cannot be set")
            elif name in _COUNTED:
                self.checking.complain(location, at, f"'{name}' is counted by the engine and cannot be set; "
                                       "give a graph an attribute of its own, under \"attributes\"")
            elif name in TAIL and entry.role != "set":
                self.checking.complain(location, at, f"{entry.type_name} sets head and tail alike; "
                                       f"the operator set sets '{name}'")
            elif f"attributes.{name}" in scope.broken:
                continue
            elif name in scope.clusters:
                self.checking.complain(location, at, f"'{name}' is a cluster; its emitter gives the numbers")
            elif name in scope.groups_own and scope.groups_own[name] != "cluster":
                self.checking.complain(location, at, scope.undeclared(name))
            elif name not in ATTRIBUTES and name not in TAIL and own is None:
                known = [*ATTRIBUTES, *islice(scope.own, 2000), *(TAIL if entry.role == "set" else ())]
                near = suggestion(name, known, OTHER_NAMES) or _declaration(name)
                self.checking.complain(location, at, f"there is no attribute '{name}'." + near,
                                       f"attributes: {listed([*ATTRIBUTES, *scope.own], 40)}")
            else:
                value = self.reader.read(given, wanted_of(name, scope.own), scope, f"set.{name}")
                if value is not None:
                    sets[name] = value
                if isinstance(value, Node) and value.node_type and name in value.node_type.results[1:]:
                    self._beside(location, at, name, value.node_type)
        entry.sets = in_order(self.checking, entry, sets, item)

    def _beside(self, location: Location, path: str, name: str, node_type: NodeType) -> None:
        """Complain of a value whose place is given where one of its further results was meant."""
        self.checking.complain(location, path, f"{node_type.name} gives a {node_type.results[0]} here, not a {name}; leave "
                               f"'{name}' out, as it comes with the position, or name the value under \"values\" and write "
                               f'{{"expr": "spot.{name}"}}')
