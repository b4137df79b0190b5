"""A document after reading: its nodes, values and references, still with groups, stacks and parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from graphfx.errors import NOWHERE, Location
from graphfx.graph.flat import TimeSettings
from graphfx.graph.values import Value
from graphfx.node.types import Attribute, NodeType, Parameter


@dataclass(frozen=True)
class StreamReference:
    """`"from": "sky"` or `"storm.sparks"`: a node and, for a group, one of its outputs.

    `looks` are the modifiers of an image's entry.
    """

    node: str
    port: str = ""
    location: Location = NOWHERE
    path: str = ""
    looks: dict[str, object] = field(default_factory=dict)

    def __str__(self) -> str:
        """Return it as the document writes it."""
        return f"{self.node}.{self.port}" if self.port else self.node


@dataclass
class Entry:
    """One node, or one operator of a stack.

    `name` is the id, `place` its path in this graph (`fall/spiral`), `path` its JSON path. Exactly one of
    `node_type` and `group` is set, unless the type is unknown. `sets` are in order of dependence.
    """

    name: str
    place: str
    path: str
    location: Location
    type_name: str = ""
    type_location: Location = NOWHERE
    node_type: NodeType | None = None
    group: Graph | None = None
    sources: list[StreamReference] = field(default_factory=list)
    inputs: dict[str, list[StreamReference]] = field(default_factory=dict)
    arguments: dict[str, Value] = field(default_factory=dict)
    sets: dict[str, Value] = field(default_factory=dict)
    references: dict[str, tuple[str, Location]] = field(default_factory=dict)
    only: Value | None = None
    """A condition, in which a Literal of type 'selector' stands for the test of a selector node."""
    during: Value | None = None
    when: str = ""
    surfaces: list[tuple[str, Location]] = field(default_factory=list)
    clusters: dict[str, tuple[Value, Value]] = field(default_factory=dict)
    """The number and the way of each cluster of an emitter."""
    per: str = ""
    """What has one draw of a selector."""
    enabled: Value | None = None
    ops: list[Entry] = field(default_factory=list)
    seed: str = ""

    @property
    def role(self) -> str:
        """Return the role of its type: 'emit', 'stack', 'flow', ..., 'group', or '' where the type is unknown."""
        if self.group is not None:
            return "group"
        return self.node_type.role if self.node_type else ""

    @property
    def kind(self) -> str:
        """Return the kind of its type, or 'group'."""
        if self.group is not None:
            return "group"
        return self.node_type.kind if self.node_type else ""

    @property
    def has_surface(self) -> bool:
        """Return whether it is a surface, or a stack or a group that holds one."""
        if self.group is not None:
            return not self.group.sound or any(entry.has_surface for entry in self.group.nodes.values())
        return self.role == "surface" or any(op.has_surface for op in self.ops)

    @property
    def streams(self) -> tuple[str, ...]:
        """Return the names of the streams that it makes; one without a name is ''."""
        if self.group is not None:
            return tuple(self.group.outputs)
        makes = self.kind in ("emitters", "operators") or (self.kind == "selectors" and self.sources)
        return ("",) if makes else ()


@dataclass
class Graph:
    """One document, checked: an effect or a group."""

    name: str
    file: str
    folder: Path | None
    location: Location
    doc: str = ""
    seed: int = 0
    time: TimeSettings = field(default_factory=TimeSettings)
    use: dict[str, Graph] = field(default_factory=dict)
    params: dict[str, Parameter] = field(default_factory=dict)
    attributes: dict[str, Attribute] = field(default_factory=dict)
    """Its own, besides those of graphfx."""
    attribute_locations: dict[str, Location] = field(default_factory=dict)
    clusters: dict[str, Location] = field(default_factory=dict)
    """The names that its emitters give to clusters, and those of an outer graph that it knows of."""
    merged: dict[str, tuple[Attribute, str]] = field(default_factory=dict)
    """Own attributes and clusters, its groups' too, with the files that declare them."""
    param_locations: dict[str, Location] = field(default_factory=dict)
    inputs: dict[str, str] = field(default_factory=dict)
    outputs: dict[str, StreamReference] = field(default_factory=dict)
    nodes: dict[str, Entry] = field(default_factory=dict)
    order: list[str] = field(default_factory=list)
    """The nodes, each after those whose streams it takes."""
    digest: str = ""
    sound: bool = True
    """Whether nothing is wrong with it, nor with the groups that it uses."""
    broken: set[str] = field(default_factory=set)
    """JSON paths of what is named but wrong, which has been told: no one who refers to it is to blame."""

    @property
    def groups_own(self) -> dict[str, str]:
        """Return the types of what its groups declare of particles and it does not: attributes and clusters."""
        return {name: attribute.type for name, (attribute, _) in self.merged.items()
                if name not in self.attributes and name not in self.clusters}

    @property
    def parameter_line(self) -> str:
        """Return all parameters with units on one line."""
        return ", ".join(parameter.label for parameter in self.params.values()) or "no parameters"
