"""How often a value must be found, and which values are the same."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from graphfx.graph.values import Call, Expression, Keys, Literal, Member, Name, Node, Ramp, Random, Value, children
from graphfx.node import NUMERIC_TYPES
from graphfx.program import Column, Operand, Uniform


class Rate(IntEnum):
    """How often a value is found."""

    CONSTANT = 0
    STEP = 1
    PARTICLE = 2


LANE_TYPES = {"float": "float", "int": "float", "bool": "bool"} | {
    name: "vec3" for name, size in NUMERIC_TYPES.items() if size == 3
}
"""The lane type in which a parameter type is computed."""

CLOCK_NAMES = ("time", "frame")


def lane_type(name: str) -> str:
    """Return the lane type of a parameter or attribute type; other types have none."""
    return LANE_TYPES.get(name, name)


def literal(value: Value) -> Any:
    """Return what a literal holds."""
    assert isinstance(value, Literal)
    return value.value


NOUGHT = Uniform("0", "word", 0)


@dataclass
class Scope:
    """What names mean where a value stands.

    `attribute` finds the operand of an attribute; `identity` is the column of particle ids, and `number` gives as a
    word what counts the draws: "lives", "hits", or a particle's number in a cluster.
    """

    seed: int
    emitter: str
    attribute: Callable[[str], Operand]
    identity: Callable[[], Column]
    per_particle: Callable[[str], bool]
    number: Callable[[str], Operand] = lambda name: NOUGHT


def rate_of(tree: Any, scope: Scope) -> Rate:
    """Return how often a value, or a part of an expression, must be found."""
    own = Rate.CONSTANT
    if isinstance(tree, Name):
        own = Rate.STEP if tree.name in CLOCK_NAMES else Rate.PARTICLE if scope.per_particle(tree.name) else Rate.CONSTANT
    elif isinstance(tree, Literal) and tree.type == "mesh":
        own = Rate.PARTICLE
    elif isinstance(tree, Keys):
        own = Rate.STEP
    elif isinstance(tree, Random):
        own = Rate.CONSTANT if tree.per == "graph" and not tree.vary else Rate.PARTICLE
    elif isinstance(tree, Node) and tree.node_type is not None:
        reserved = tree.node_type.reserved
        if ("draw" in reserved and tree.per != "graph") or "id" in reserved:
            own = Rate.PARTICLE
        own = max(
            own,
            *(rate_of(Name(name), scope) for name in (*tree.node_type.reads, *reserved) if name not in ("draw", "dt", "id")),
            Rate.CONSTANT,
        )
    return max(own, *(rate_of(part, scope) for part in children(tree)), Rate.CONSTANT)


ALWAYS_CHANGING = frozenset({"time", "frame", "age", "normalized_age", "position", "velocity", "hits"})


def depends_on_time(tree: Any, changing: frozenset[str] | None = None) -> bool:
    """Return whether a value changes while a particle lives: by time, frame, age, a hit, or an attribute that it reads.

    `changing` are the attributes that are set within a frame; where it is given, the others count as constant.
    """

    def changes(name: str) -> bool:
        return changing is None or name in ALWAYS_CHANGING or name in changing

    own = isinstance(tree, Keys) or (isinstance(tree, Name) and changes(tree.name))
    own |= isinstance(tree, (Random, Node)) and tree.per in ("frame", "hit")
    own |= isinstance(tree, Literal) and tree.type == "mesh"
    if isinstance(tree, Node) and tree.node_type is not None:
        own |= any(map(changes, tree.node_type.reads)) or bool({"time", "frame"}.intersection(tree.node_type.reserved))
    return own or any(depends_on_time(part, changing) for part in children(tree))


def identity_of(tree: Any) -> Any:
    """Return a key that is equal for values that are always equal, wherever they stand; draws differ by their seed."""
    match tree:
        case Expression():
            return identity_of(tree.tree)
        case Literal():
            return (lane_type(tree.type), tree.value)
        case Call():
            return (tree.function, *map(identity_of, tree.arguments))
        case Name():
            return ("name", tree.name)
        case Keys():
            return ("keys", tree.type, tree.times, tuple(map(identity_of, tree.values)), tree.interpolation, tree.repeat)
        case Ramp():
            points = tuple(map(identity_of, tree.values))
            return ("ramp", tree.type, tree.positions, points, identity_of(tree.over), tree.interpolation)
        case Random():
            return ("rand", tree.seed, tree.per, tree.vary, identity_of(tree.low), identity_of(tree.high))
        case Member():
            return ("member", tree.index, identity_of(tree.value))
        case Node():
            arguments = tuple((name, identity_of(value)) for name, value in tree.arguments)
            return ("node", id(tree.node_type), tree.seed, tree.per, arguments)
    return (type(tree).__name__, tree)
