"""Whether the particles that a value speaks of have the clusters that it names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphfx.graph.checking import Checking
from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Name, Node, Random, Value, parts_of


def check_clusters(checking: Checking, nodes: dict[str, FlatNode], names: Iterable[str]) -> None:
    """Complain of each value of a flat graph that names a cluster which not all of its particles have."""
    wanted = set(names)
    used = {path: named for path, node in nodes.items() if (named := dict(_used(node, wanted)))}
    for name in dict.fromkeys(name for named in used.values() for name in named):
        lacking = _without(nodes, name)
        for path, named in used.items():
            if name in named and path in lacking:
                value, emitter = named[name], lacking[path]
                checking.complain(value.location, value.path, f"the particles of '{emitter}' are in no cluster '{name}'; "
                                  f'write "clusters": {{"{name}": {{"count": ...}}}} there too')


def _used(node: FlatNode, wanted: set[str]) -> Iterator[tuple[str, Value]]:
    """Yield the clusters that a node names, with the values that do."""
    if not wanted:
        return
    for value in (*node.arguments.values(), *node.sets.values(), *([node.only] if node.only is not None else [])):
        for part in parts_of(value):
            name = part.name if isinstance(part, Name) else part.per if isinstance(part, Random | Node) else ""
            if name in wanted:
                yield name, value


def _without(nodes: dict[str, FlatNode], name: str) -> dict[str, str]:
    """Return the nodes that particles without a cluster reach, each with the emitter of such particles."""
    takers: dict[str, list[str]] = {}
    for path, node in nodes.items():
        for source in node.sources:
            takers.setdefault(source, []).append(path)
    reached = {path: path for path, node in nodes.items() if node.node_type.role == "emit" and name not in node.clusters}
    ahead = list(reached)
    while ahead:
        path = ahead.pop()
        for taker in takers.get(path, ()):
            if taker not in reached:
                reached[taker] = reached[path]
                ahead.append(taker)
    return reached
