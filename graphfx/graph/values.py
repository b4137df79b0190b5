"""What a parameter or an attribute may be given: a tree of values, independent of any particle.

`Value.type` is the type that the place asks for ('float', 'vec3', 'color', ...); a scalar value may
stand where a vector is wanted only if it is a literal of three numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from graphfx.errors import NOWHERE, Location
from graphfx.node.types import NodeType


@dataclass(frozen=True)
class Value:
    """Base of all values: `path` is the JSON path for messages, `seed` the path that keys random numbers."""

    type: str
    location: Location = NOWHERE
    path: str = ""
    seed: str = ""


@dataclass(frozen=True)
class Literal(Value):
    """A constant: float, bool, str, or a tuple of floats (vec3, interval, list); colours are linear."""

    value: Any = None


@dataclass(frozen=True)
class ParameterValue(Value):
    """`{"param": name}`: replaced by what the parameter was given when the graph is flattened.

    `component` is 'start' or 'end' where an expression reads one end of an interval.
    """

    name: str = ""
    component: str = ""


@dataclass(frozen=True)
class Call:
    """A function of an expression: `function` is a name of `expressions.FUNCTIONS`."""

    function: str
    arguments: tuple[Any, ...]


@dataclass(frozen=True)
class Name:
    """A name in an expression: an attribute, `age`, `time`, `frame`, `birth.x`, `hit.x`, ...; never a parameter
    or a named value, which are replaced by their values when the graph is flattened."""

    name: str


@dataclass(frozen=True)
class Expression(Value):
    """`{"expr": "1 - age / life"}`: a tree of Call, Name, Value and Python floats.

    A named value or parameter inside it stands as a Value leaf after flattening.
    """

    tree: Any = None
    text: str = ""


@dataclass(frozen=True)
class Keys(Value):
    """`{"keys": [[t, v], ...]}` over time [s]: interpolation 'linear', 'step', 'smooth' or 'spline'; repeat 'hold',
    'loop' or 'mirror'."""

    times: tuple[float, ...] = ()
    values: tuple[Any, ...] = ()
    interpolation: str = "linear"
    repeat: str = "hold"


@dataclass(frozen=True)
class Ramp(Value):
    """`{"ramp": [[x, v], ...], "over": value}`: between the points as the interpolation says, held beyond them."""

    positions: tuple[float, ...] = ()
    values: tuple[Any, ...] = ()
    over: Value | None = None
    interpolation: str = "linear"


@dataclass(frozen=True)
class Random(Value):
    """`{"rand": [low, high]}`: uniform between two values, on the segment between two vectors.

    `per` is the scope of one draw, `vary` a share that varies by particle.
    """

    low: Value | None = None
    high: Value | None = None
    per: str = "life"
    vary: float = 0.0


@dataclass(frozen=True)
class Node(Value):
    """A value node of the library (a distribution, ...) with its arguments given or defaulted."""

    node_type: NodeType | None = None
    arguments: tuple[tuple[str, Value], ...] = ()
    per: str = "life"


@dataclass(frozen=True)
class Member(Value):
    """`spot.normal`: one of the further results of a value node that has several, by its place among them."""

    value: Node | None = None
    index: int = 0


class Measure(NamedTuple):
    """How deep a tree of values nests, and how many parts it has when nothing is shared."""

    depth: int
    size: int


_LEAF = Measure(0, 1)


def children(tree: Any) -> tuple[Any, ...]:
    """Return the parts of a value or of an expression's tree, one level down."""
    match tree:
        case Call():
            return tree.arguments
        case Expression():
            return (tree.tree,)
        case Keys():
            return tree.values
        case Ramp():
            return (*tree.values, tree.over)
        case Random():
            return (tree.low, tree.high)
        case Node():
            return tuple(value for _, value in tree.arguments)
        case Member():
            return (tree.value,)
    return ()


def parts_of(tree: Any) -> Iterator[Any]:
    """Yield a value and all its parts, each once however often it is shared."""
    waiting, seen = [tree], set()
    while waiting:
        part = waiting.pop()
        if id(part) not in seen:
            seen.add(id(part))
            yield part
            waiting += reversed(children(part))


def measure(tree: Any) -> Measure:
    """Return a tree's depth and size; each part remembers its own, so shared parts are measured once."""
    parts = children(tree)
    if not parts:
        return _LEAF
    known: Measure | None = tree.__dict__.get("_measure")
    if known is None:
        measures = [measure(part) for part in parts]
        known = Measure(1 + max(m.depth for m in measures), 1 + sum(m.size for m in measures))
        tree.__dict__["_measure"] = known
    return known
