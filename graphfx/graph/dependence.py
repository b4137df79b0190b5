"""The order in which attributes are found, each after those that it reads; and what a spawn's mean that read themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from graphfx.errors import Location
from graphfx.graph.checking import Checking
from graphfx.graph.items import Item
from graphfx.graph.model import Entry
from graphfx.graph.names import SCOPES
from graphfx.graph.values import Call, Expression, Literal, Member, Name, Node, Ramp, Random, Value, parts_of
from graphfx.node import ATTRIBUTES, Attribute


def names_read(tree: Any) -> Iterator[str]:
    """Yield the names that a value reads where it stands, and the clusters by which it is drawn."""
    for part in parts_of(tree):
        if isinstance(part, Name):
            yield "life" if part.name == "normalized_age" else part.name
        elif isinstance(part, Random | Node) and part.per not in SCOPES:
            yield part.per
        if isinstance(part, Node) and part.node_type is not None:
            yield from part.node_type.reads


def in_order(checking: Checking, entry: Entry, sets: dict[str, Value], item: Item | None) -> dict[str, Value]:
    """Return what a node sets so that each comes after those that it reads; complain of circles.

    With `set` and `fade` an attribute that reads itself reads its value before, with `spawn` what was inherited; what an
    emitter makes has none before.
    """
    given = {name: value for name, value in entry.arguments.items() if name in ATTRIBUTES} | sets
    read = {name: set(names_read(value)) for name, value in given.items()}
    nearest = {name for name, (_, by) in entry.clusters.items() if not (isinstance(by, Literal) and by.value == "turn")}
    before = {name: {"position" if other in nearest else other for other in names} for name, names in read.items()}
    if entry.role == "emit" or (entry.role == "spawn" and "inherit" in entry.arguments):
        inherited = getattr(entry.arguments.get("inherit"), "value", None) or ()
        before |= {name: {attribute.follows} for name, attribute in ATTRIBUTES.items()
                   if attribute.follows and name not in given and name not in inherited}
    for circle in _circles(before, alone=entry.role == "emit"):
        name = next(name for name in circle if name in given)
        location = item.key_location(name) if item is not None and name in sets else given[name].location
        path = f"{entry.path}.set.{name}" if name in sets else given[name].path
        checking.complain(location, path, _circular(circle, len(circle) > 2 or circle[0] in read[circle[0]]))
    if entry.role == "spawn":
        for name, value in given.items():
            _refuse_hidden(checking, name, value)
    order = [name for name in _sorted(before) if name in sets]
    return {name: sets[name] for name in order}


def _walk(before: Mapping[str, set[str]]) -> Iterator[tuple[list[str], str]]:
    """Yield for each name, when all that it reads is done, ([], name); and for each circle its names, and ''."""
    done: set[str] = set()
    for start in before:
        trail = {} if start in done else {start: iter(before)}
        while trail:
            name = next(reversed(trail))
            other = next((other for other in trail[name] if other in before[name]), None)
            if other is None:
                del trail[name]
                done.add(name)
                yield [], name
            elif other in trail:
                names = list(trail)
                yield [*names[names.index(other):], other], ""
            elif other not in done:
                trail[other] = iter(before)


def _circles(before: Mapping[str, set[str]], alone: bool) -> list[list[str]]:
    """Return the circles among names; of one name alone only where that is one."""
    return [circle for circle, _ in _walk(before) if len(circle) > (1 if alone else 2)]


def _sorted(before: Mapping[str, set[str]]) -> list[str]:
    return [name for _, name in _walk(before) if name]


def _circular(circle: list[str], plain: bool) -> str:
    """Return what is wrong with attributes that read one another."""
    if len(circle) > 2:
        return f"these attributes read one another in a circle: {' -> '.join(circle)}; give one of them a value of its own"
    if plain:
        return f"'{circle[0]}' reads itself, and at birth it has no value yet; let it read others"
    return ("'position' is drawn by a cluster whose numbers are those of the nearest seed, and so follow from it; "
            'number them by "turn", or let it read others')


def _refuse_hidden(checking: Checking, name: str, value: Value) -> None:
    """Complain where a spawn's attribute reads itself by a value node, which cannot tell the parent's from the child's."""
    for part in parts_of(value):
        if isinstance(part, Node) and part.node_type is not None and name in part.node_type.reads:
            location: Location = part.location or value.location
            checking.complain(location, part.path or value.path, f"{part.node_type.name} reads '{name}', which is being set; "
                              f"in an expression parent.{name} is the parent's")


def of_parent(name: str, value: Value, inherited: bool, attribute: Attribute) -> Value:
    """Return what a spawn sets an attribute to, where it reads itself: that stands for what the parent passed on."""
    before: Any = Name(f"parent.{name}")
    if not inherited:
        before = Name(attribute.follows) if attribute.follows else Literal(attribute.type, value=attribute.default)
    done: dict[int, tuple[Any, Any]] = {}

    def new(tree: Any) -> Any:
        known = done.get(id(tree))
        if known is None:
            known = done[id(tree)] = (tree, made(tree))
        return known[1]

    def made(tree: Any) -> Any:
        match tree:
            case Name() if tree.name == name:
                return before
            case Call():
                return Call(tree.function, tuple(map(new, tree.arguments)))
            case Expression():
                return replace(tree, tree=new(tree.tree))
            case Ramp():
                return replace(tree, over=new(tree.over))
            case Random():
                return replace(tree, low=new(tree.low), high=new(tree.high))
            case Node():
                return replace(tree, arguments=tuple((key, new(part)) for key, part in tree.arguments))
            case Member():
                return replace(tree, value=new(tree.value))
        return tree

    result: Value = new(value) if name in names_read(value) else value
    return result
