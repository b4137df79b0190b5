"""Where a stream's particles come from: their sources, and the conditions that narrow them on the way.

A source is a node that holds particles: an `emit`, or a `spawn` that does not add to another's. A
stream is narrowed by every selector that it passes; where streams merge, either will do.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.substitute import both
from graphfx.graph.values import Call, Expression, Value
from graphfx.plan.schedule import Schedule

MAKERS = ("emit", "spawn")


@dataclass
class Sources:
    """The sources of a graph, and what reaches whom."""

    flat: FlatGraph
    schedule: Schedule
    _known: dict[str, dict[str, Value | None]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Go through the nodes in order, so that no question goes deep."""
        for path in self.schedule.order:
            self.reaching(path)

    @property
    def paths(self) -> list[str]:
        """Return the nodes that hold particles, parents first."""
        return [path for path in self.schedule.order if self.home(path) == path]

    def home(self, path: str) -> str:
        """Return the source that holds what a maker makes: itself, or whom a `spawn` adds to; '' of other nodes."""
        node = self.flat.nodes[path]
        return node.references.get("into", path) if node.node_type.role in MAKERS else ""

    def makers(self, source: str) -> list[FlatNode]:
        """Return the nodes that make particles of a source: itself, then the spawns that add to it."""
        return [self.flat.nodes[path] for path in self.schedule.order if self.home(path) == source]

    def reaching(self, path: str) -> dict[str, Value | None]:
        """Return the sources whose particles a node hands on, each with the condition on them (None: all)."""
        home = self.home(path)
        if home:
            return {home: None}
        if path not in self._known:
            node = self.flat.nodes[path]
            own = node.only if node.node_type.kind == "selectors" else None
            self._known[path] = {source: both(found, own) for source, found in self.taken(path).items()}
        return self._known[path]

    def taken(self, path: str) -> dict[str, Value | None]:
        """Return the sources whose particles a node takes, with the conditions on them."""
        merged: dict[str, Value | None] = {}
        for source in self.schedule.through.get(path, ()):
            for found, condition in self.reaching(source).items():
                merged[found] = either(merged[found], condition) if found in merged else condition
        return merged

    def _acting(self, path: str, source: str) -> FlatNode:
        """Return a node with the conditions of its stream put into its own."""
        node = self.flat.nodes[path]
        condition = self.taken(path)[source]
        return node if condition is None else replace(node, only=both(condition, node.only))

    def operators(self, source: str) -> list[FlatNode]:
        """Return the operators that act on a source's particles, in order."""
        return [
            self._acting(path, source)
            for path in self.schedule.order
            if self.flat.nodes[path].node_type.kind == "operators" and source in self.taken(path)
        ]

    def spawns(self, source: str) -> list[FlatNode]:
        """Return the spawns whose parents are a source's particles, in order."""
        return [
            self._acting(path, source)
            for path in self.schedule.order
            if self.flat.nodes[path].node_type.role == "spawn" and source in self.taken(path)
        ]

    def parents(self, spawn: str) -> list[str]:
        """Return the sources of a spawn's parents."""
        return list(self.taken(spawn))


def either(first: Value | None, second: Value | None) -> Value | None:
    """Return the condition under which either of two holds; None is always."""
    if first is None or second is None:
        return None
    return Expression("bool", second.location, second.path, second.seed, Call("or", (first, second)))
