"""Flatten a graph: groups are opened, stacks become chains, parameters and named values are put in.

Each node gets its instance path, which also keys its random numbers: so inserting another node, or
using a group once more, changes no number of the others. What a group renders by itself belongs to
its own preview, and is left out where the group is used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphfx.errors import GraphError, LimitError, Problem
from graphfx.graph.check_document import read_graph, starting_from
from graphfx.graph.check_nodes import why_uniform
from graphfx.graph.check_values import default_value
from graphfx.graph.checking import Checking, in_order
from graphfx.graph.document import Document, load_document
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.limits import Limits
from graphfx.graph.model import Entry, Graph, StreamReference
from graphfx.graph.names import REFERENCE_TYPES
from graphfx.graph.overrides import override
from graphfx.graph.scope import particle_reader
from graphfx.graph.substitute import Substitution, both, overlap
from graphfx.graph.values import Literal, Value
from graphfx.node import ATTRIBUTES, Library, Parameter


@dataclass(frozen=True)
class Gate:
    """When, where and whether a node acts at all; a stack's or group's holds for all that it contains."""

    enabled: bool = True
    only: Value | None = None
    during: tuple[float, float] | None = None

    def within(self, other: Gate) -> Gate:
        """Return what is left of this gate inside another."""
        return Gate(self.enabled and other.enabled, both(other.only, self.only), overlap(other.during, self.during))


@dataclass
class Instance:
    """One use of a graph: the whole effect, or a group at one place. `inputs` are the paths of the streams it takes."""

    graph: Graph
    prefix: str
    substitution: Substitution
    gate: Gate = field(default_factory=Gate)
    inputs: dict[str, tuple[str, ...]] = field(default_factory=dict)
    groups: dict[str, Instance] = field(default_factory=dict)


class Flattener:
    """Makes the nodes of one flat graph."""

    def __init__(self, checking: Checking):
        """Complain to `checking`."""
        self.checking = checking
        self.nodes: dict[str, FlatNode] = {}

    def flatten(self, instance: Instance) -> None:
        """Add the nodes of an instance, in the order of its document."""
        for entry in instance.graph.nodes.values():
            gate = self._gate(instance, entry).within(instance.gate)
            if entry.group is not None:
                self.flatten(self._group(instance, entry, gate, self._inputs(instance, entry)))
            elif entry.role == "stack":
                for op, sources in self._chain(instance, entry):
                    inner = self._gate(instance, op).within(gate)
                    if op.group is not None:
                        self.flatten(self._group(instance, op, inner, {next(iter(op.group.inputs)): sources}))
                    else:
                        self._add(instance, op, inner, sources)
            elif not (instance.prefix and entry.role == "image"):
                sources, looks = self._sources(instance, entry)
                self._add(instance, entry, gate, sources, looks)

    def _add(self, instance: Instance, entry: Entry, gate: Gate, sources: tuple[str, ...],
             looks: tuple[dict[str, object], ...] = ()) -> None:
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
            value: Value = default_value(parameter, f"{entry.path}.{parameter.name}")
            if given is not None:
                value = instance.substitution.value(given, parameter)
                self._uniform(entry, parameter, value, given)
            arguments[parameter.name] = value
        sets = {name: instance.substitution.value(value, _attribute(name)) for name, value in entry.sets.items()}
        references = {name: instance.prefix + target for name, (target, _) in entry.references.items()}
        makes = entry.kind in ("emitters", "operators")
        self.nodes[instance.prefix + entry.place] = FlatNode(
            instance.prefix + entry.place, node_type, sources, arguments, sets, references,
            gate.only if entry.kind == "operators" else None, gate.during if makes else None, entry.when, gate.enabled, looks,
            entry.location, frozenset(entry.arguments))

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
        if isinstance(only, Literal) and only.type == "selector":
            only = Literal("selector", only.location, only.path, "", instance.prefix + only.value)
        elif only is not None:
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

    def _group(self, outer: Instance, entry: Entry, gate: Gate, inputs: dict[str, tuple[str, ...]]) -> Instance:
        """Return the instance of a group at one place, made once."""
        prefix = f"{outer.prefix}{entry.place}/"
        known = outer.groups.get(entry.place)
        if known is not None:
            known.gate = gate
            return known
        group = entry.group
        assert group is not None
        given: dict[str, Value] = {}
        for name, parameter in group.params.items():
            argument = entry.arguments.get(name)
            given[name] = (outer.substitution.value(argument, parameter) if argument is not None
                           else default_value(parameter, f"{entry.path}.{name}"))
        seed = outer.substitution.seed(entry.seed) + "/"
        instance = Instance(group, prefix, Substitution(self.checking, given, seed), gate, inputs)
        outer.groups[entry.place] = instance
        return instance

    def _chain(self, instance: Instance, stack: Entry) -> Iterator[tuple[Entry, tuple[str, ...]]]:
        """Yield the operators of a stack with the paths that each takes its stream from."""
        sources, _ = self._sources(instance, stack)
        for op in stack.ops:
            yield op, sources
            sources = self._op_ends(instance, op, sources)

    def _op_ends(self, instance: Instance, op: Entry, sources: tuple[str, ...]) -> tuple[str, ...]:
        if op.group is None:
            return (instance.prefix + op.place,)
        inner = self._group(instance, op, Gate(), {next(iter(op.group.inputs)): sources})
        return self._ends(inner, next(iter(op.group.outputs.values())))

    def _inputs(self, instance: Instance, entry: Entry) -> dict[str, tuple[str, ...]]:
        return {name: tuple(path for reference in references for path in self._ends(instance, reference))
                for name, references in entry.inputs.items()}

    def _sources(self, instance: Instance, entry: Entry) -> tuple[tuple[str, ...], tuple[dict[str, object], ...]]:
        pairs = [(path, reference.looks) for reference in entry.sources for path in self._ends(instance, reference)]
        looks = tuple(look for _, look in pairs) if entry.role == "image" else ()
        return tuple(path for path, _ in pairs), looks

    def _ends(self, instance: Instance, reference: StreamReference) -> tuple[str, ...]:
        """Return the paths of the nodes at whose end a stream stands."""
        if reference.node in instance.inputs:
            return instance.inputs[reference.node]
        entry = instance.graph.nodes[reference.node]
        if entry.group is not None:
            inner = self._group(instance, entry, Gate(), self._inputs(instance, entry))
            return self._ends(inner, entry.group.outputs[reference.port or next(iter(entry.group.outputs))])
        if entry.role != "stack":
            return (instance.prefix + entry.place,)
        ends, _ = self._sources(instance, entry)
        for op in entry.ops:
            ends = self._op_ends(instance, op, ends)
        return ends


def _attribute(name: str) -> Parameter:
    attribute = ATTRIBUTES[name]
    return Parameter(name, attribute.type, attribute.default, attribute.unit)


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
    try:
        flattener.flatten(Instance(graph, "", Substitution(checking, given)))
    except LimitError as error:
        checking.problems.extend(error.problems)
    return flattener.nodes


def check_flat(graph: Graph, checking: Checking) -> list[Problem]:
    """Return what shows only when a sound graph is flattened with its defaults; nothing of a group that needs others."""
    if graph.inputs or any(parameter.required for parameter in graph.params.values()):
        return []
    inner = Checking(checking.library, checking.limits)
    _whole(graph, inner)
    return inner.problems


def flatten(source: str | Path | Document, library: Library, overrides: Mapping[str, Any] | None = None,
            limits: Limits | None = None) -> FlatGraph:
    """Return the flat graph of a document; `overrides` replace parameters, as `--set name=value` does.

    Raise `GraphError` with all problems of the document, of the groups that it uses, and of the overrides.
    """
    document = source if isinstance(source, Document) else load_document(source, limits)
    checking = Checking(library, document.limits)
    graph = read_graph(document, checking, starting_from(document))
    nodes = _whole(graph, checking, overrides) if not checking.problems else {}
    if checking.problems:
        raise GraphError(in_order(checking.problems, document.file))
    return FlatGraph(graph.name, graph.file, graph.seed, graph.time, nodes, graph.doc, graph.digest)
