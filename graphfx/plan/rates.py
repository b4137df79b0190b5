"""How often a value must be found, and which values are the same."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from graphfx.graph.values import Call, Expression, Keys, Literal, Member, Name, Node, Ramp, Random, Value, children, parts_of
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
    return max(_own_rate(part, scope) for part in parts_of(tree))


def _own_rate(part: Any, scope: Scope) -> Rate:
    """Return how often a part of a value must be found if what it is made of is constant."""
    if isinstance(part, Name):
        return Rate.STEP if part.name in CLOCK_NAMES else Rate.PARTICLE if scope.per_particle(part.name) else Rate.CONSTANT
    if isinstance(part, Literal) and part.type == "mesh":
        return Rate.PARTICLE
    if isinstance(part, Keys):
        return Rate.STEP
    if isinstance(part, Random):
        return Rate.CONSTANT if part.per == "graph" and not part.vary else Rate.PARTICLE
    if isinstance(part, Node) and part.node_type is not None:
        reserved = part.node_type.reserved
        if ("draw" in reserved and part.per != "graph") or "id" in reserved:
            return Rate.PARTICLE
        names = [name for name in (*part.node_type.reads, *reserved) if name not in ("draw", "dt", "id")]
        return max((_own_rate(Name(name), scope) for name in names), default=Rate.CONSTANT)
    return Rate.CONSTANT


ALWAYS_CHANGING = frozenset({"time", "frame", "age", "normalized_age", "position", "velocity", "hits"})


def depends_on_time(tree: Any, changing: frozenset[str] | None = None) -> bool:
    """Return whether a value changes while a particle lives: by time, frame, age, a hit, or an attribute that it reads.

    `changing` are the attributes that are set within a frame; where it is given, the others count as constant.
    """

    def changes(name: str) -> bool:
        return changing is None or name in ALWAYS_CHANGING or name in changing

    def alone(part: Any) -> bool:
        own = isinstance(part, Keys) or (isinstance(part, Name) and changes(part.name))
        own |= isinstance(part, (Random, Node)) and part.per in ("frame", "hit")
        own |= isinstance(part, Literal) and part.type == "mesh"
        if isinstance(part, Node) and part.node_type is not None:
            own |= any(map(changes, part.node_type.reads)) or bool({"time", "frame"}.intersection(part.node_type.reserved))
        return own

    return any(map(alone, parts_of(tree)))


class Identities:
    """Numbers of values: equal for those that are always equal, wherever they stand; draws differ by their seed.

    A value's own is found once, from the numbers of what it is made of, however often that is used.
    """

    def __init__(self) -> None:
        self._numbers: dict[Any, int] = {}
        self._known: dict[int, tuple[Any, int]] = {}
        """With each number its value, whose id is no other's as long as it is held here."""

    def of(self, tree: Any) -> int:
        """Return the number of a value, or a part of an expression."""
        if id(tree) not in self._known:
            self._known[id(tree)] = tree, self._number(tree)
        return self._known[id(tree)][1]

    def _number(self, tree: Any) -> int:
        if isinstance(tree, Expression):
            return self.of(tree.tree)
        key = (*_own_key(tree), *map(self.of, children(tree)))
        return self._numbers.setdefault(key, len(self._numbers))


def _own_key(tree: Any) -> tuple[Any, ...]:
    """Return what a value is, beside what it is made of."""
    match tree:
        case Literal():
            return (lane_type(tree.type), tree.value)
        case Call():
            return ("call", tree.function)
        case Name():
            return ("name", tree.name)
        case Keys():
            return ("keys", tree.type, tree.times, tree.interpolation, tree.repeat)
        case Ramp():
            return ("ramp", tree.type, tree.positions, tree.interpolation)
        case Random():
            return ("rand", tree.seed, tree.per, tree.vary)
        case Member():
            return ("member", tree.index)
        case Node():
            return ("node", id(tree.node_type), tree.seed, tree.per, tuple(name for name, _ in tree.arguments))
    return (type(tree).__name__, tree)
