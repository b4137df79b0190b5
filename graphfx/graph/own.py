"""What a graph adds to the state of particles: its own attributes, and the clusters of its emitters."""

from __future__ import annotations

from graphfx.errors import Location, suggestion
from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking
from graphfx.graph.items import Item
from graphfx.graph.literals import Literals
from graphfx.graph.model import Entry, Graph
from graphfx.graph.named import TAKEN
from graphfx.graph.names import ATTRIBUTE_KEYS, ATTRIBUTE_TYPES, CLUSTER_KEYS, CLUSTER_WAYS, SCOPES, WORD
from graphfx.graph.scope import READABLE, Scope
from graphfx.graph.values import Literal, Value
from graphfx.node import ATTRIBUTES, OTHER_NAMES, RESERVED, Attribute, Parameter

FOREIGN = {other: name for other, name in OTHER_NAMES.items() if name in READABLE}
RESERVED_WORDS = frozenset({*TAKEN, *FOREIGN, *RESERVED, *SCOPES, "tail"})
"""Names that no graph may give to an attribute or a cluster of its own."""
_DEFAULTS = {"float": 0.0, "color": (1.0, 1.0, 1.0), "direction": (0.0, 1.0, 0.0)}
CLUSTER_COUNT = Parameter("count", "int", None, min=1, max=10_000_000)
CLUSTER_BY = Parameter("by", "string", CLUSTER_WAYS[0], choices=CLUSTER_WAYS)


class OwnReader:
    """Reads what one graph declares of its particles."""

    def __init__(self, checking: Checking, graph: Graph, literals: Literals):
        """Fill `graph`."""
        self.checking, self.graph, self.literals, self.complain = checking, graph, literals, checking.complain

    def attributes(self, item: Item | None) -> None:
        """Read the graph's own attributes."""
        if item is not None and not item.is_object:
            self.checking.mismatch(item, "attributes", "\"attributes\" should be an object of attributes",
                                   'for instance {"heat": {"type": "float", "default": 0, "unit": "K"}}')
        for name, given in item.entries() if item is not None else ():
            path = f"attributes.{name}"
            location = item.key_location(name)  # type: ignore[union-attr]
            if not self._name(name, location, path, "an attribute"):
                self.graph.broken.add(path)
            elif not given.is_object:
                self.checking.mismatch(given, path, "an attribute should be an object with a \"type\"",
                                       'for instance {"type": "float", "default": 0, "unit": "K"}')
                self.graph.broken.add(path)
            else:
                self._attribute(name, given, location, path)

    def _name(self, name: str, location: Location, path: str, what: str) -> bool:
        if not WORD.fullmatch(name):
            self.complain(location, path, f"the name of {what} is made of letters, digits and '_' and begins with a letter; "
                          f"'{name[:60]}' is not")
        elif name in ATTRIBUTES:
            self.complain(location, path, f"'{name}' is an attribute of graphfx; choose another name, or leave this out")
        elif name in FOREIGN:
            self.complain(location, path, f"'{name}' is what others call '{FOREIGN[name]}'; use that, or choose another name")
        elif name in RESERVED_WORDS:
            self.complain(location, path, f"{what} cannot be called '{name}', which already means something in expressions; "
                          "choose another name")
        else:
            return True
        return False

    def _attribute(self, name: str, item: Item, location: Location, path: str) -> None:
        self.checking.unknown_keys(item, path, ATTRIBUTE_KEYS, "an attribute")
        given = item.value.get("type")
        kind = "float"
        if given is None:
            self.complain(item.location, path, 'an attribute needs a "type"', f"types: {', '.join(ATTRIBUTE_TYPES)}")
        else:
            kind = self.checking.choice(given, f"{path}.type", "type", ATTRIBUTE_TYPES)
        unit, doc = (self.checking.text(item.value[key], f"{path}.{key}", key) if key in item.value else ""
                     for key in ("unit", "doc"))
        if not kind:
            self.graph.broken.add(path)
            return
        default = item.value.get("default")
        if kind == "cluster":
            if default is not None:
                self.complain(default.location, f"{path}.default", "the emitter gives a cluster's number; leave 'default' out")
            self.graph.clusters[name] = location
            return
        value = _DEFAULTS.get(kind, (0.0, 0.0, 0.0))
        if default is not None:
            read = self.literals.read(default, Parameter(name, kind, None, unit), f"{path}.default")
            value = value if read is None else read
        self.graph.attributes[name] = Attribute(name, kind, value, unit, doc)
        self.graph.attribute_locations[name] = location

    def clusters(self, nodes: Item | None) -> None:
        """Note the clusters that the emitters declare, so that all values may name them."""
        for node, given in nodes.entries() if nodes is not None else ():
            kind = given.value.get("type") if given.is_object else None
            item = given.value.get("clusters") if kind is not None and kind.value == "emit" else None
            for name, _ in item.entries() if item is not None else ():
                location, path = item.key_location(name), f"nodes.{node}.clusters.{name}"  # type: ignore[union-attr]
                if name in self.graph.attributes:
                    self.complain(location, path, f"'{name}' is an attribute of this graph already; choose another name")
                elif self._name(name, location, path, "a cluster"):
                    self.graph.clusters.setdefault(name, location)

    def merge(self) -> None:
        """Join what the groups declare with what the graph does; a name means one thing in all of them."""
        graph = self.graph
        merged: dict[str, tuple[Attribute, str]] = {}
        for group in graph.use.values():
            for name, (attribute, file) in group.merged.items():
                known, where = merged.setdefault(name, (attribute, file))
                if known.type != attribute.type:
                    self._differ(graph.location, f"use.{group.name}", attribute, file, known, where)
        own = [(attribute, graph.attribute_locations[name]) for name, attribute in graph.attributes.items()]
        own += [(Attribute(name, "cluster", 0.0, "", ""), location) for name, location in graph.clusters.items()]
        for attribute, location in own:
            known, where = merged.get(attribute.name, (attribute, ""))
            if known.type != attribute.type:
                self._differ(location, f"attributes.{attribute.name}", attribute, graph.file, known, where)
            merged[attribute.name] = attribute, graph.file
        graph.merged = merged

    def _differ(self, location: Location, path: str, one: Attribute, file: str, other: Attribute, where: str) -> None:
        self.complain(location, path, f"'{one.name}' is of type {one.type} in {file} and {other.type} in {where}; "
                      "it is one attribute, so declare it alike, or rename one")


def read_clusters(reader: ValueReader, entry: Entry, item: Item, scope: Scope) -> None:
    """Fill the clusters of an emitter, whose names are known."""
    checking, path = reader.checking, f"{entry.path}.clusters"
    if not item.is_object:
        checking.mismatch(item, path, "\"clusters\" should be an object {name: {\"count\": number, \"by\": ...}}")
    for name, given in item.entries():
        at = f"{path}.{name}"
        if not given.is_object:
            checking.mismatch(given, at, 'a cluster should be an object such as {"count": 60, "by": "turn"}')
            continue
        checking.unknown_keys(given, at, CLUSTER_KEYS, "a cluster")
        if "count" not in given.value:
            checking.complain(given.location, at, f"the cluster '{name}' needs \"count\", how many numbers are given out")
            continue
        count = reader.read(given.value["count"], CLUSTER_COUNT, scope, f"clusters.{name}.count")
        by: Value | None = Literal("string", value=CLUSTER_WAYS[0])
        if "by" in given.value:
            by = reader.read(given.value["by"], CLUSTER_BY, scope, f"clusters.{name}.by")
        if count is not None and by is not None and name in scope.clusters:
            entry.clusters[name] = count, by


def check_inherited(checking: Checking, value: Value | None, graph: Graph) -> None:
    """Complain of names in a spawn's `inherit` that are no attributes."""
    known = [*ATTRIBUTES, *graph.merged]
    for name in value.value or () if isinstance(value, Literal) else ():
        if name not in known:
            checking.complain(value.location, value.path, f"there is no attribute '{name}' to inherit."  # type: ignore[union-attr]
                              + suggestion(str(name), known, OTHER_NAMES), f"attributes: {', '.join(known)}")
