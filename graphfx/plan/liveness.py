"""Which attributes of an emitter's particles are stored: only what something kept reads, and that differs."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Literal, Name, Node, Random, Value, children
from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES, INFINITY
from graphfx.plan.rates import Rate, Scope, rate_of


def names_in(tree: Any) -> set[str]:
    """Return the attributes that a value reads."""
    own: set[str] = set()
    if isinstance(tree, Name):
        own = {tree.name} & (ATTRIBUTES.keys() | DERIVED_ATTRIBUTES.keys())
    elif isinstance(tree, Node) and tree.node_type is not None:
        own = set(tree.node_type.reads)
    return own.union(*(names_in(part) for part in children(tree)))


def draws_in(tree: Any) -> bool:
    """Return whether a value draws random numbers for each particle, or reads its id."""
    own = isinstance(tree, Random) or (
        isinstance(tree, Node) and tree.node_type is not None and "draw" in tree.node_type.reserved
    )
    own = own and tree.per != "graph"
    own |= isinstance(tree, Node) and tree.node_type is not None and "id" in tree.node_type.reserved
    return own or any(draws_in(part) for part in children(tree))


@dataclass
class Attributes:
    """`columns` maps what is stored to the store's column type; `constants` what is one for all to its value.

    `reasons` says for each column who reads it. `unread` are those that differ and that nobody reads.
    """

    columns: dict[str, str] = field(default_factory=dict)
    constants: dict[str, Value] = field(default_factory=dict)
    reasons: dict[str, str] = field(default_factory=dict)
    unread: list[str] = field(default_factory=list)


def set_value(emitter: FlatNode, name: str) -> Value:
    """Return what the emitter sets an attribute to, or its default."""
    if name == "life" and "life" in emitter.arguments:
        return emitter.arguments["life"]
    attribute = ATTRIBUTES[name]
    return emitter.sets.get(name) or Literal(attribute.type, value=attribute.default)


def _values_of(node: FlatNode) -> list[Value]:
    return [*node.arguments.values(), *([node.only] if node.only is not None else [])]


def find_attributes(
    emitter: FlatNode, operators: list[FlatNode], drawn: set[str], motion_blur: bool, prune: bool = True
) -> Attributes:
    """Decide what is stored. `drawn` are the attributes that the renderer reads; without `prune`, all are stored."""
    written = {name for node in operators for name in node.node_type.writes}
    if any(node.node_type.role == "surface" for node in operators):
        written |= {"position", "velocity"}
    readers = {name: "the renderer" for name in drawn}
    for node in operators:
        for name in set(node.node_type.reads) | {n for value in _values_of(node) for n in names_in(value)}:
            readers.setdefault(name, node.path)
    moving = set_value(emitter, "velocity")
    moves = "velocity" in written or not (isinstance(moving, Literal) and not any(moving.value))
    if moves:
        readers.setdefault("velocity", "the motion")
    written |= {"position"} if moves else set()
    motion_blur = motion_blur and "position" in written
    if not prune:
        readers |= {name: readers.get(name, "nothing") for name in ATTRIBUTES} | {"age": "nothing"}
        written = set(ATTRIBUTES) - {"life"}
    return _sort_out(emitter, operators, written, readers, motion_blur)


def _sort_out(
    emitter: FlatNode, operators: list[FlatNode], written: set[str], readers: dict[str, str], motion_blur: bool
) -> Attributes:
    found = Attributes()
    scope = Scope(0, "", None, None, lambda name: name in written or _varies(emitter, name))  # type: ignore[arg-type]

    def differs(name: str) -> bool:
        return name in written or rate_of(set_value(emitter, name), scope) > Rate.CONSTANT

    for name, attribute in ATTRIBUTES.items():
        if name == "life":
            continue
        if name in readers and differs(name):
            found.columns[name] = "float" if attribute.type == "float" else "vec3"
            found.reasons[name] = f"read by {readers[name]}"
        elif differs(name):
            found.unread.append(name)
        else:
            found.constants[name] = set_value(emitter, name)
    _add_hidden(found, emitter, operators, readers, motion_blur, differs("life"))
    return found


def _add_hidden(
    found: Attributes,
    emitter: FlatNode,
    operators: list[FlatNode],
    readers: dict[str, str],
    motion_blur: bool,
    lives_differ: bool,
) -> None:
    life = set_value(emitter, "life")
    mortal = lives_differ or not (isinstance(life, Literal) and life.value == INFINITY)
    if lives_differ:
        found.columns["life"], found.reasons["life"] = "float", "read at death"
    else:
        found.constants["life"] = life
    if mortal or "age" in readers or "normalized_age" in readers:
        found.columns["birth"], found.reasons["birth"] = "time", "for age and death"
    if any("draw" in node.node_type.reserved or any(map(draws_in, _values_of(node))) for node in operators):
        found.columns["id"], found.reasons["id"] = "id", "keys the random numbers of the operators"
    if motion_blur and "position" in found.columns:
        found.columns["tail"], found.reasons["tail"] = "vec3", "where the shutter opened, for motion blur"
    if any(node.node_type.role == "surface" for node in operators):
        found.columns["resting"], found.reasons["resting"] = "mask", "who has come to rest on a surface"


def _varies(emitter: FlatNode, name: str) -> bool:
    """Return whether an attribute differs by particle at birth."""
    if name not in ATTRIBUTES:
        return True
    value = set_value(emitter, name)
    scope = Scope(0, "", None, None, lambda inner: inner != name and _varies(emitter, inner))  # type: ignore[arg-type]
    return rate_of(value, scope) > Rate.CONSTANT


def birth_order(emitter: FlatNode, wanted: list[str]) -> list[str]:
    """Return the attributes to find at birth, each after those that its value reads."""
    ordered: list[str] = []

    def visit(name: str) -> None:
        if name in ordered or name not in ATTRIBUTES:
            return
        for read in sorted(names_in(set_value(emitter, name)) - {name}):
            visit(read)
        ordered.append(name)

    for name in wanted:
        visit(name)
    return ordered
