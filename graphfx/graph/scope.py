"""What the values of one place may read: parameters, named values, and attributes where there is a particle."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from graphfx.errors import suggestion
from graphfx.graph.checking import Checking, listed, nearest, not_one_of
from graphfx.graph.functions import CONSTANTS
from graphfx.graph.items import Item
from graphfx.graph.literals import lane
from graphfx.graph.names import SCOPES
from graphfx.graph.values import Expression, Member, Name, Node, ParameterValue, Random, Value, children
from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES, OTHER_NAMES, Attribute, Parameter

READABLE = ATTRIBUTES | DERIVED_ATTRIBUTES
ALWAYS = {"time": "float", "frame": "float"}
_MOST_NAMES = 2000
_HIT = {"normal": "vec3", "point": "vec3", "speed": "float"}
_ELSEWHERE = {
    "birth": "these values are made at birth; birth.x is for operators",
    "parent": "only what `spawn` makes has a parent",
    "hit": 'there is a hit only where the operator says "when": "hit"',
}


@dataclass(frozen=True)
class Scope:
    """Where a value stands: `path` and `seed` are its owner's, `uniform` says why no particle may be read here, or ''."""

    path: str
    seed: str
    params: dict[str, Parameter]
    named: Callable[[str], Value | None]
    names: Collection[str] = ()
    uniform: str = ""
    qualifiers: frozenset[str] = frozenset()
    broken: frozenset[str] | set[str] = frozenset()
    own: Mapping[str, Attribute] = field(default_factory=dict)
    """The graph's own attributes."""
    clusters: Collection[str] = ()
    groups_own: Mapping[str, str] = field(default_factory=dict)
    """The types of attributes and clusters that only the graph's groups declare."""
    settled: bool = False
    """Whether the value must be known before the cook: time passes, and draws are made, only later."""
    shared: bool = False
    """Whether it is a named value: it may be drawn per hit, for those who read it at hits."""

    def resolve(self, word: str) -> tuple[Any, str] | str:
        """Return what a name of an expression means, with its type, or the message that says why it means nothing."""
        qualifier, dot, rest = word.partition(".")
        if dot:
            return self._parameter(rest) if qualifier == "param" else self._qualified(qualifier, rest)
        if word in ALWAYS and self.settled:
            return f"'{word}' cannot be read here: {self.uniform}"
        if word in ALWAYS:
            return Name(word), ALWAYS[word]
        if word in self.names:
            value = self.named(word)
            return (value, lane(value.type)) if value is not None else (None, "")
        if f"attributes.{word}" in self.broken:
            return None, ""
        found = READABLE.get(word) or self.own.get(word)
        if found or word in self.clusters or word == "id":
            if self.uniform:
                return f"'{word}' cannot be read here: {self.uniform}"
            return Name(word), lane(found.type) if found else "float"
        if word in self.groups_own:
            return self.undeclared(word)
        if word in self.params:
            return f"there is no name '{word}'. Did you mean 'param.{word}'?"
        if word in ("param", "birth", "parent", "hit"):
            return f"'{word}' needs a name after it, as in {word}.{next(iter(self.params), 'x')}"
        params = [f"param.{name}" for name in islice(self.params, _MOST_NAMES)]
        known = [*islice(self.names, _MOST_NAMES), *READABLE, *islice(self.own, _MOST_NAMES), *islice(self.clusters, _MOST_NAMES),
                 *ALWAYS, *CONSTANTS, *params]
        return f"there is no name '{word}'." + suggestion(word, known, OTHER_NAMES)

    def undeclared(self, word: str) -> str:
        """Return what to do about an attribute or a cluster that only a group declares."""
        kind = self.groups_own[word]
        what = "cluster" if kind == "cluster" else "attribute"
        return f"'{word}' is the {what} of a group; declare it here too: \"attributes\": {{\"{word}\": {{\"type\": \"{kind}\"}}}}"

    def per(self, checking: Checking, item: Item, path: str) -> str:
        """Return what has one draw: a scope or a cluster, or '' after a complaint."""
        if item.is_text and self.groups_own.get(item.value) == "cluster":
            checking.complain(item.location, path, self.undeclared(item.value))
            return ""
        known = (*SCOPES, *self.clusters)
        if item.is_text and item.value not in known:
            checking.complain(item.location, path, not_one_of(item, '"per"', known),
                              f'a cluster is declared on an emit: "clusters": {{"{item.value[:40]}": {{"count": 60}}}}')
            return ""
        if item.value == "hit" and not self.shared and "hit" not in self.qualifiers:
            checking.complain(item.location, path, _ELSEWHERE["hit"])
            return ""
        return checking.choice(item, path, '"per"', known)

    def members(self, word: str) -> dict[str, tuple[Any, str]]:
        """Return the results of a named value that has several, by their names."""
        value = self.named(word) if word in self.names else None
        if not isinstance(value, Node) or value.node_type is None:
            return {}
        kinds = [lane(kind) for kind in value.node_type.result]
        found = {name: (Member(kind, value.location, value.path, "", value, index), kind)
                 for index, (name, kind) in enumerate(zip(value.node_type.results, kinds, strict=False))}
        return found

    def _parameter(self, rest: str) -> tuple[Any, str] | str:
        name, _, component = rest.partition(".")
        parameter = self.params.get(name)
        if parameter is None and f"params.{name}" in self.broken:
            return None, ""
        if parameter is None:
            near = nearest(name, self.params)
            return f"the graph has no parameter '{name}'.{near} Its parameters: {listed(self.params)}"
        kind = lane(parameter.type)
        if kind == "interval":
            if component not in ("start", "end"):
                return f"'{name}' is an interval; read param.{name}.start or param.{name}.end"
            kind = "float"
        elif component:
            return f"'{name}' is no interval; only those have .{component}"
        if kind not in ("float", "vec3", "bool"):
            return f"'{name}' is a parameter of type {parameter.type}; an expression reads numbers, vectors and conditions"
        return ParameterValue(kind, name=name, component=component), kind

    def _qualified(self, qualifier: str, rest: str) -> tuple[Any, str] | str:
        if self.uniform:
            return f"'{qualifier}.{rest}' cannot be read here: {self.uniform}"
        if qualifier not in self.qualifiers:
            return f"'{qualifier}.{rest}' cannot be read here: {_ELSEWHERE[qualifier]}"
        if f"attributes.{rest}" in self.broken:
            return None, ""
        stored = READABLE if qualifier == "parent" else ATTRIBUTES
        known = _HIT if qualifier == "hit" else {name: lane(found.type) for name, found in {**stored, **self.own}.items()}
        if rest not in known:
            return f"there is no '{qualifier}.{rest}'." + suggestion(rest, list(islice(known, _MOST_NAMES)), OTHER_NAMES)
        return Name(f"{qualifier}.{rest}"), known[rest]


@dataclass
class Reader:
    """Something that a value reads from the particle, and the value that reads it."""

    what: str
    value: Value | None = None


def particle_reader(tree: Any, seen: set[int] | None = None) -> Reader | None:
    """Return the first thing in a value that differs from particle to particle, or None where it is uniform."""
    seen = set() if seen is None else seen
    if id(tree) in seen:
        return None
    seen.add(id(tree))
    if isinstance(tree, Name) and tree.name not in ALWAYS:
        return Reader(f"'{tree.name}'")
    if isinstance(tree, Random) and tree.per not in ("frame", "graph"):
        return Reader(f'a random number per {tree.per}; say "per": "graph" or "frame"', tree)
    if isinstance(tree, Node) and tree.node_type is not None:
        if tree.node_type.reads:
            return Reader(f"the attribute '{tree.node_type.reads[0]}', by {tree.node_type.name}", tree)
        if "id" in tree.node_type.reserved or ("draw" in tree.node_type.reserved and tree.per not in ("frame", "graph")):
            return Reader(f'a random number per {tree.per}, by {tree.node_type.name}; say "per": "graph" or "frame"',
                          tree)
    for part in children(tree):
        found = particle_reader(part, seen)
        if found:
            if found.value is None and isinstance(tree, Expression):
                found.value = tree
            return found
    return None
