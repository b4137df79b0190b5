"""Which nodes run, and in what order: from the outputs backwards, then a topological sort."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import networkx

from graphfx.errors import GraphError, Location, Problem
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.names import OUTPUTS
from graphfx.graph.values import Literal, children
from graphfx.plan.evaluate import holds


@dataclass
class Schedule:
    """`order` lists the nodes that run; `dropped` the others, with the reason; `through` the sources of each
    kept node after the dropped ones between are passed over."""

    order: list[str]
    dropped: dict[str, str]
    through: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def upstream(self, path: str) -> list[str]:
        """Return the kept nodes above a node, nearest last, in order."""
        found: list[str] = []

        def visit(name: str) -> None:
            for source in self.through.get(name, ()):
                if source not in found:
                    visit(source)
                    found.append(source)

        visit(path)
        return sorted(found, key=self.order.index)

    def kept(self, path: str, flat: FlatGraph) -> list[str]:
        """Return a node, or what stands for it where it was dropped."""
        return _pass_over(path, flat, self.dropped)


def make_schedule(flat: FlatGraph, precision: int, *, prune: bool = True) -> Schedule:
    """Drop what does nothing or is not needed, and order the rest; ties keep the document's order."""
    dropped = {path: reason for path, node in flat.nodes.items() if (reason := _idle(node, flat, precision, prune))}
    for path, node in flat.nodes.items():
        if node.node_type.role == "movie" and node.references["image"] in dropped:
            dropped.setdefault(path, f"its image '{node.references['image']}' is not drawn")
    through = {
        path: tuple(source for given in node.sources for source in _pass_over(given, flat, dropped))
        for path, node in flat.nodes.items()
    }
    edges = networkx.DiGraph()
    edges.add_nodes_from(flat.nodes)
    for path, node in flat.nodes.items():
        edges.add_edges_from((source, path) for source in (*through[path], *node.references.values(), *_meshes(node)))
    outputs = [path for path, node in flat.nodes.items() if node.node_type.role in OUTPUTS and path not in dropped]
    if not outputs:
        message = "the graph has no output: give it an enabled node of type 'image'"
        raise GraphError(Problem(message, Location(flat.file), "nodes"))
    needed = _needed(flat, edges, outputs, dropped, through) if prune else set(flat.nodes)
    for path in flat.nodes:
        if path not in needed and path not in dropped:
            dropped[path] = "no output depends on it"
    place = {path: k for k, path in enumerate(flat.nodes)}
    order = networkx.lexicographical_topological_sort(edges.subgraph(needed - set(dropped)), key=place.__getitem__)
    return Schedule(list(order), dropped, {path: through[path] for path in through if path not in dropped})


def _meshes(node: FlatNode) -> set[str]:
    """Return the paths of the meshes that a node's values read."""
    waiting: list[Any] = [*node.arguments.values(), *node.sets.values(), *([node.only] if node.only is not None else [])]
    found = set()
    while waiting:
        tree = waiting.pop()
        if isinstance(tree, Literal) and tree.type == "mesh":
            found.add(tree.value)
        waiting += children(tree)
    return found


def _needed(
    flat: FlatGraph, edges: networkx.DiGraph, outputs: list[str], dropped: dict[str, str], through: dict[str, tuple[str, ...]]
) -> set[str]:
    """Return the nodes that the outputs depend on: those above them, what else acts on the same particles, who adds to them."""
    needed: set[str] = set()
    waiting = list(outputs)
    while waiting:
        needed = needed.union(waiting, *(networkx.ancestors(edges, path) for path in waiting))
        taken = _acting(flat, through, needed)
        adding = [path for path, node in flat.nodes.items() if node.references.get("into") in needed]
        waiting = [path for path in (*taken, *adding) if path not in needed and path not in dropped]
    return needed


def _acting(flat: FlatGraph, through: dict[str, tuple[str, ...]], needed: set[str]) -> list[str]:
    """Return the operators that act on particles of needed nodes: all stacks of an emitter act on the same particles."""
    streams = networkx.DiGraph()
    for path, sources in through.items():
        if flat.nodes[path].node_type.kind in ("operators", "selectors"):
            streams.add_edges_from((source, path) for source in sources)
    makers = [path for path in needed if flat.nodes[path].node_type.kind == "emitters" and path in streams]
    taken = set().union(*(networkx.descendants(streams, path) for path in makers))
    return [path for path in flat.nodes if path in taken]


def _pass_over(path: str, flat: FlatGraph, dropped: dict[str, str]) -> list[str]:
    """Return a node, or what stands for it where it was dropped: the nearest kept ones above, in order."""
    kept: dict[str, None] = {}
    waiting, seen = [path], set()
    while waiting:
        here = waiting.pop()
        if here in seen:
            continue
        seen.add(here)
        if here not in dropped:
            kept[here] = None
        else:
            waiting += reversed(flat.nodes[here].sources)
    return list(kept)


def _idle(node: FlatNode, flat: FlatGraph, precision: int, prune: bool) -> str:
    if not node.enabled:
        return "not enabled"
    if node.node_type.neutral and holds(node, node.node_type.neutral, precision):
        return f"it does nothing: {node.node_type.neutral}"
    return never_acts(node, flat) if prune else ""


def never_acts(node: FlatNode, flat: FlatGraph) -> str:
    """Return why a node acts at no time that is simulated, or nothing if it does."""
    start, end = node.during or (-math.inf, math.inf)
    begin, finish = 0.0 - flat.time.preroll, (flat.time.last - flat.time.first) / flat.time.fps
    if end > begin and start <= finish and end > start:
        return ""
    return f"acts from {start:g} to {end:g} s, outside the simulated {begin:g} to {finish:g} s"
