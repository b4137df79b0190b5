"""What a parameter or an attribute may be given: a tree of values, independent of any particle.

`Value.type` is the type that the place asks for ('float', 'vec3', 'color', ...); a scalar value may
stand where a vector is wanted only if it is a literal of three numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

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
    """`{"param": name}`: replaced by what the parameter was given when the graph is flattened."""

    name: str = ""


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
    """`{"keys": [[t, v], ...]}` over time [s]: interpolation 'linear', 'step' or 'smooth'; repeat 'hold', 'loop' or 'mirror'."""

    times: tuple[float, ...] = ()
    values: tuple[Any, ...] = ()
    interpolation: str = "linear"
    repeat: str = "hold"


@dataclass(frozen=True)
class Ramp(Value):
    """`{"ramp": [[x, v], ...], "over": value}`: linear between the points, held beyond them."""

    positions: tuple[float, ...] = ()
    values: tuple[Any, ...] = ()
    over: Value | None = None


@dataclass(frozen=True)
class Random(Value):
    """`{"rand": [low, high]}`: uniform between two values; `per` is the scope of one draw, `vary` a share that varies by particle."""

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
