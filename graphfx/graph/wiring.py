"""Open the groups of a graph and find at which nodes each stream stands."""

from __future__ import annotations

from dataclasses import dataclass, field

from graphfx.errors import LimitError, Location, Problem
from graphfx.graph.check_values import default_value
from graphfx.graph.checking import Checking
from graphfx.graph.model import Entry, Graph, StreamReference
from graphfx.graph.names import PICTURES
from graphfx.graph.substitute import Substitution
from graphfx.graph.values import Value

Paths = tuple[str, ...]
_ENDS_PER_NODE = 20
"""Streams may merge until the paths at all ends number this many for each node that the limit allows."""


@dataclass
class Instance:
    """One use of a graph: the whole effect, or a group at one place.

    `ends` are the paths of the nodes at which a stream stands, by what names the stream (`sky`, `halves.left`);
    `sources` the paths that each node or operator takes from; `groups` the instances inside, by place.
    """

    graph: Graph
    prefix: str
    substitution: Substitution
    ends: dict[str, Paths] = field(default_factory=dict)
    sources: dict[str, Paths] = field(default_factory=dict)
    looks: dict[str, tuple[dict[str, object], ...]] = field(default_factory=dict)
    groups: dict[str, Instance] = field(default_factory=dict)


class Wiring:
    """Makes instances, with all groups inside them."""

    def __init__(self, checking: Checking):
        """Complain to `checking`; at its limits stop."""
        self.checking = checking
        self.instances = 0
        self.paths = 0

    def instance(self, graph: Graph, prefix: str, substitution: Substitution, inputs: dict[str, Paths]) -> Instance:
        """Return an instance of a graph that takes streams from these paths."""
        self.instances += 1
        if self.instances > self.checking.limits.nodes:
            raise self._too_many("groups are used", self.checking.limits.nodes, graph.location, "")
        instance = Instance(graph, prefix, substitution, dict(inputs))
        for name in graph.order:
            self._wire(instance, graph.nodes[name])
        return instance

    def _too_many(self, what: str, limit: int, location: Location, path: str) -> LimitError:
        message = f"{what} more than {limit:,} times in the flattened graph; raise the limit on nodes if that is meant"
        return LimitError(Problem(message, location, path))

    def _wire(self, instance: Instance, entry: Entry) -> None:
        name = entry.name
        if entry.group is not None:
            inputs = {port: self._merged(instance, references) for port, references in entry.inputs.items()}
            inner = self._group(instance, entry, inputs)
            for port, reference in entry.group.outputs.items():
                instance.ends[f"{name}.{port}"] = inner.ends[str(reference)]
            if len(entry.group.outputs) == 1:
                instance.ends[name] = instance.ends[f"{name}.{next(iter(entry.group.outputs))}"]
            return
        if entry.role in PICTURES:
            pairs = [(path, reference.looks) for reference in entry.sources for path in instance.ends[str(reference)]]
            instance.sources[entry.place] = tuple(path for path, _ in pairs)
            instance.looks[entry.place] = tuple(look for _, look in pairs)
            return
        sources = self._merged(instance, entry.sources)
        if entry.role != "stack":
            instance.sources[entry.place] = sources
            instance.ends[name] = (instance.prefix + entry.place,)
            return
        for op in entry.ops:
            instance.sources[op.place] = sources
            if op.group is None:
                sources = (instance.prefix + op.place,)
            else:
                inner = self._group(instance, op, {next(iter(op.group.inputs)): sources})
                sources = inner.ends[str(next(iter(op.group.outputs.values())))]
        instance.ends[name] = sources

    def _merged(self, instance: Instance, references: list[StreamReference]) -> Paths:
        """Return the paths of several streams, each once."""
        if len(references) == 1:
            return instance.ends[str(references[0])]
        paths = tuple(dict.fromkeys(path for reference in references for path in instance.ends[str(reference)]))
        self.paths += len(paths)
        limit = _ENDS_PER_NODE * self.checking.limits.nodes
        if self.paths > limit:
            raise self._too_many("streams merge", limit, references[0].location, references[0].path)
        return paths

    def _group(self, outer: Instance, entry: Entry, inputs: dict[str, Paths]) -> Instance:
        group = entry.group
        assert group is not None
        given: dict[str, Value] = {}
        for name, parameter in group.params.items():
            given[name] = outer.substitution.argument(entry, parameter) or default_value(parameter, f"{entry.path}.{name}")
        seed = outer.substitution.seed(entry.seed) + "/"
        place = f"{outer.prefix}{entry.place}/"
        inner = self.instance(group, place, Substitution(self.checking, given, seed, group.nodes, place), inputs)
        outer.groups[entry.place] = inner
        return inner
