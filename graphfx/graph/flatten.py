"""Flatten a graph: groups are opened, stacks become chains, parameters and named values are put in.

Each node gets its instance path, which also keys its random numbers: so inserting another node, or
using a group once more, changes no number of the others. What a group renders by itself belongs to
its own preview, and is left out where the group is used.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphfx.errors import GraphError, LimitError, Problem
from graphfx.graph.check_clusters import check_clusters
from graphfx.graph.check_document import read_graph, starting_from
from graphfx.graph.check_nodes import why_uniform
from graphfx.graph.check_values import default_value
from graphfx.graph.checking import Checking, in_order
from graphfx.graph.dependence import of_parent
from graphfx.graph.document import Document, load_document
from graphfx.graph.flat import Cluster, FlatGraph, FlatNode
from graphfx.graph.limits import Limits
from graphfx.graph.model import Entry, Graph
from graphfx.graph.names import OUTPUTS, REFERENCE_TYPES
from graphfx.graph.overrides import override
from graphfx.graph.own import CLUSTER_BY, CLUSTER_COUNT, check_inherited
from graphfx.graph.scope import particle_reader
from graphfx.graph.sets import wanted_of
from graphfx.graph.substitute import Substitution, both, overlap
from graphfx.graph.values import Expression, Literal, Name, Value
from graphfx.graph.wiring import Instance, Wiring
from graphfx.node import ATTRIBUTES, Attribute, Library, Parameter


@dataclass(frozen=True)
class Gate:
    """When, where and whether a node acts at all; a stack's or group's holds for all that it contains."""

    enabled: bool = True
    only: Value | None = None
    during: tuple[float, float] | None = None

    def within(self, other: Gate) -> Gate:
        """Return what is left of this gate inside another."""
        return Gate(self.enabled and other.enabled, both(other.only, self.only), overlap(other.during, self.during))


class Flattener:
    """Makes the nodes of one flat graph."""

    def __init__(self, checking: Checking):
        """Complain to `checking`."""
        self.checking = checking
        self.nodes: dict[str, FlatNode] = {}

    def flatten(self, instance: Instance, outer: Gate) -> None:
        """Add the nodes of an instance, in the order of its document."""
        for entry in instance.graph.nodes.values():
            gate = self._gate(instance, entry).within(outer)
            if entry.role == "stack":
                for op in entry.ops:
                    self._one(instance, op, self._gate(instance, op).within(gate))
            else:
                self._one(instance, entry, gate)

    def _one(self, instance: Instance, entry: Entry, gate: Gate) -> None:
        if entry.group is not None:
            self.flatten(instance.groups[entry.place], gate)
        elif not (instance.prefix and entry.role in OUTPUTS) and (entry.kind != "selectors" or entry.sources):
            self._add(instance, entry, gate)

    def _add(self, instance: Instance, entry: Entry, gate: Gate) -> None:
        if len(self.nodes) >= self.checking.limits.nodes:
            raise LimitError(Problem(f"the flattened graph has more than {self.checking.limits.nodes:,} nodes, the limit; "
                                     "raise the limit on nodes if that is meant", entry.location, entry.path))
        node_type = entry.node_type
        assert node_type is not None
        arguments = {}
        for parameter in node_type.parameters.values():
            if parameter.type in REFERENCE_TYPES:
                continue
            given = entry.arguments.get(parameter.name)
            value = _default(entry, parameter)
            if given is not None:
                value = instance.substitution.value(given, parameter)
                self._uniform(entry, parameter, value, given)
            arguments[parameter.name] = value
        own = instance.graph.attributes
        sets = {name: instance.substitution.value(value, wanted_of(name, own)) for name, value in entry.sets.items()}
        if entry.role == "spawn":
            _read_parents(arguments, sets, own)
        references = {name: found.value for name, parameter in node_type.parameters.items() if parameter.type in REFERENCE_TYPES
                      and isinstance(found := instance.substitution.argument(entry, parameter), Literal)}
        references |= {name: instance.prefix + target for name, (target, _) in entry.references.items() if "[" in name}
        makes = entry.kind in ("emitters", "operators")
        only = gate.only if entry.kind == "operators" or entry.role == "spawn" else None
        if entry.kind == "selectors":
            only = instance.substitution.selector(entry.name)
        path = instance.prefix + entry.place
        self.nodes[path] = FlatNode(
            path, node_type, instance.sources[entry.place], arguments, sets, references,
            only, gate.during if makes else None, entry.when, gate.enabled,
            instance.looks.get(entry.place, ()), entry.location, frozenset(entry.arguments),
            tuple(instance.prefix + target for target, _ in entry.surfaces), self._clusters(instance, entry),
            instance.substitution.seed(entry.seed))
        check_inherited(self.checking, arguments.get("inherit") if entry.role == "spawn" else None, instance.graph)

    def _clusters(self, instance: Instance, entry: Entry) -> dict[str, Cluster]:
        clusters = {}
        for name, (count, by) in entry.clusters.items():
            number = self._settled(instance.substitution, count, CLUSTER_COUNT)
            way = self._settled(instance.substitution, by, CLUSTER_BY)
            if number is not None and way is not None:
                clusters[name] = Cluster(name, int(number), way)
        return clusters

    def find_surfaces(self) -> None:
        """Put the surfaces themselves in the place of stacks and groups that hold them."""
        known = [path for path, node in self.nodes.items() if node.node_type.role == "surface"]
        for node in self.nodes.values():
            if node.surfaces:
                node.surfaces = tuple(path for path in known if any(_inside(path, place) for place in node.surfaces))

    def _uniform(self, entry: Entry, parameter: Parameter, value: Value, given: Value) -> None:
        """Complain of a value that varies by particle where a parameter brought it to a place that cannot."""
        why = why_uniform(entry, parameter)
        reader = particle_reader(value) if why else None
        if reader:
            cause = reader.value or given
            target = f"{entry.place}.{parameter.name} of {entry.location.file}"
            self.checking.complain(cause.location, cause.path, f"{why}; this, given on to {target}, reads {reader.what}")

    def _gate(self, instance: Instance, entry: Entry) -> Gate:
        substitution = instance.substitution
        enabled = self._settled(substitution, entry.enabled, Parameter("enabled", "bool", None))
        during = self._settled(substitution, entry.during, Parameter("during", "interval", None))
        only = entry.only
        if only is not None:
            only = substitution.value(only)
            if isinstance(only, Literal):
                enabled, only = (enabled is not False) and bool(only.value), None
        return Gate(enabled is not False, only, during)

    def _settled(self, substitution: Substitution, value: Value | None, want: Parameter) -> Any:
        """Return a value that must be known before the cook, or None where there is none."""
        if value is None:
            return None
        known = substitution.value(value, want)
        if not isinstance(known, Literal):
            self.checking.complain(value.location, value.path,
                                   f"{want.name} must be known before the cook, and this is not constant")
            return None
        if want.type == "interval" and known.value[0] > known.value[1]:
            self.checking.complain(value.location, value.path,
                                   f"the interval ends at {known.value[1]}, before its start at {known.value[0]}")
        return known.value


def _default(entry: Entry, parameter: Parameter) -> Value:
    """Return what a parameter is that the document does not state."""
    path = f"{entry.path}.{parameter.name}"
    if (entry.role, parameter.name) == ("spawn", "life"):
        return Expression("float", entry.location, path, "", Name("parent.life"))
    if (entry.role, parameter.name) == ("emit", "rate") and _bursts(entry.arguments.get("count")):
        return Literal("float", entry.location, path, "", 0.0)
    return default_value(parameter, path)


def _bursts(count: Value | None) -> bool:
    """Return whether a count that a document states makes particles."""
    return count is not None and not (isinstance(count, Literal) and count.value == 0)


def _read_parents(arguments: dict[str, Value], sets: dict[str, Value], own: Mapping[str, Attribute]) -> None:
    """Let what a spawn sets, and reads, stand for what the parent passes on."""
    listed = arguments["inherit"]
    names = listed.value if isinstance(listed, Literal) else None
    for name, value in sets.items():
        sets[name] = of_parent(name, value, names is None or name in (*names, "position"), own.get(name) or ATTRIBUTES[name])
    arguments["life"] = of_parent("life", arguments["life"], True, ATTRIBUTES["life"])


def _inside(path: str, place: str) -> bool:
    return path == place or path.startswith(place + "/")


def _whole(graph: Graph, checking: Checking, overrides: Mapping[str, Any] | None = None) -> dict[str, FlatNode]:
    """Return the flat nodes of a graph that stands alone; problems go to `checking`."""
    for name, doc in graph.inputs.items():
        checking.complain(graph.location, f"inputs.{name}",
                          f"this graph is a group, and its input '{name}' has no particles here; "
                          "use it in another graph, by \"use\" and from there as a type" + (f" ({doc})" if doc else ""))
    given = override(graph, checking, overrides or {})
    if checking.problems:
        return {}
    flattener = Flattener(checking)
    flattener.flatten(Wiring(checking).instance(graph, "", Substitution(checking, given, nodes=graph.nodes), {}), Gate())
    flattener.find_surfaces()
    clusters = [name for name, (attribute, _) in graph.merged.items() if attribute.type == "cluster"]
    check_clusters(checking, flattener.nodes, clusters)
    return flattener.nodes


def check_flat(graph: Graph, checking: Checking) -> list[Problem]:
    """Return what shows only when a sound graph is flattened with its defaults; nothing of a group that needs others."""
    if graph.inputs or any(parameter.required for parameter in graph.params.values()):
        return []
    inner = Checking(checking.library, checking.limits)
    try:
        _whole(graph, inner)
    except LimitError as error:
        inner.problems.extend(error.problems)
    return inner.problems


def flatten(source: str | Path | Document, library: Library, overrides: Mapping[str, Any] | None = None,
            limits: Limits | None = None) -> FlatGraph:
    """Return the flat graph of a document; `overrides` replace parameters, as `--set name=value` does.

    Raise `GraphError` with all problems of the document, of the groups that it uses, and of the overrides;
    `LimitError` where it flattens to too many nodes.
    """
    document = source if isinstance(source, Document) else load_document(source, limits)
    checking = Checking(library, document.limits)
    graph = read_graph(document, checking, starting_from(document))
    nodes = _whole(graph, checking, overrides) if not checking.problems else {}
    if checking.problems:
        raise GraphError(in_order(checking.problems, document.file))
    return FlatGraph(graph.name, graph.file, graph.seed, graph.time, nodes, graph.doc, graph.digest,
                     {name: attribute for name, (attribute, _) in graph.merged.items() if attribute.type != "cluster"})
