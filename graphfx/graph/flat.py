"""The flattened graph: no stacks, no groups, no parameters; what the plan is made from.

Paths are instance paths: `storm` for a node, `fall/spiral` for operator `spiral` of stack `fall`,
`fall/gust/left` for what stands inside a group.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from graphfx.errors import NOWHERE, Location
from graphfx.graph.values import Value
from graphfx.node.types import Attribute, NodeType


@dataclass(frozen=True)
class Cluster:
    """Numbers given to an emitter's particles, 0 to `count` - 1: in turn, or of the nearest of `count` seeds.

    The seeds are points of the emitter's own distribution of positions.
    """

    name: str
    count: int
    by: str = "turn"


@dataclass
class FlatNode:
    """One node that may run. `arguments` holds every parameter, given or default.

    `sources` are the paths of the nodes whose streams it takes, in order (images: their `from`);
    `references` maps a parameter that names a node (`camera`, `mesh`, `into`) to a path. `sets` are the attribute
    values of emit, spawn, set and fade; "tail.radius" sets the tail's alone. `only` is a condition; of a selector in
    a stream it is its own. `when` is a moment, and `surfaces` are those whose hits count (none named: all). `during`
    is (start, end) in seconds. `looks` are the modifiers of an image's `from` entries, in order of `sources`.
    """

    path: str
    node_type: NodeType
    sources: tuple[str, ...] = ()
    arguments: dict[str, Value] = field(default_factory=dict)
    sets: dict[str, Value] = field(default_factory=dict)
    references: dict[str, str] = field(default_factory=dict)
    only: Value | None = None
    during: tuple[float, float] | None = None
    when: str = ""
    enabled: bool = True
    looks: tuple[dict[str, object], ...] = ()
    location: Location = NOWHERE
    given: frozenset[str] = frozenset()
    """Names of the parameters that the document states; the rest stand at their defaults."""
    surfaces: tuple[str, ...] = ()
    clusters: dict[str, Cluster] = field(default_factory=dict)
    seed: str = ""
    """What keys its own random numbers: its path, or its `seed_key`."""

    @property
    def gives(self) -> tuple[str, ...]:
        """Return the attributes that it gives new values: those of its `set`, and those that its type writes."""
        return (*self.sets, *self.node_type.writes)


@dataclass(frozen=True)
class TimeSettings:
    """The clock: frame n shows t = (n - first) / fps; simulation begins at -preroll seconds."""

    fps: float = 24.0
    first: int = 1
    last: int = 100
    preroll: float = 0.0
    substeps: int = 1
    method: str = "auto"
    order: int = 6
    tolerance: float = 1e-3
    precision: int = 32
    locations: Mapping[str, Location] = field(default_factory=dict, compare=False, repr=False)
    """Where what is given stands, by key."""


@dataclass
class FlatGraph:
    """A whole effect after flattening; `nodes` is in document order."""

    name: str
    file: str
    seed: int
    time: TimeSettings
    nodes: dict[str, FlatNode]
    doc: str = ""
    document_hash: str = ""
    attributes: dict[str, Attribute] = field(default_factory=dict)
    """The graph's own, besides those of graphfx."""
