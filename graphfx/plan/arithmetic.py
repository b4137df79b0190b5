"""The instructions that values become: expressions, keys, ramps, random numbers. One kernel holds them all."""

from __future__ import annotations

from typing import Any

from graphfx.graph.functions import FUNCTIONS
from graphfx.math import floor, maximum, minimum, where
from graphfx.math.arithmetic import body_of
from graphfx.program import Bundle, Function

EXPRESSIONS = Bundle("expressions")

_FORMS: dict[tuple[str, tuple[str, ...]], Function] = {
    (name, arguments): EXPRESSIONS.add(body_of(name), arguments, (result,), name)
    for name, function in FUNCTIONS.items()
    for arguments, result in function.forms
}


def function_for(name: str, arguments: tuple[str, ...]) -> Function:
    """Return the instruction for a function of an expression on these lane types."""
    return _FORMS[name, arguments]


@EXPRESSIONS.function("draw", "float")
def first_of(draw: Any) -> Any:
    """u, the first number of a draw."""
    return draw[0]


@EXPRESSIONS.function("float draw float", "float")
def varied(shared: Any, draw: Any, share: Any) -> Any:
    """u + (v - u) share: a number u shared by many, varied by one's own v."""
    return shared + (draw[0] - shared) * share


@EXPRESSIONS.function("float float float", "float")
def random_number(low: Any, high: Any, u: Any) -> Any:
    """low + (high - low) u."""
    return low + (high - low) * u


@EXPRESSIONS.function("vec3 vec3 float", "vec3")
def random_vector(low: Any, high: Any, u: Any) -> Any:
    """low + (high - low) u: on the segment between two vectors."""
    return low + (high - low) * u


def _share(x: Any, x0: Any, x1: Any) -> Any:
    return minimum(maximum(where(x1 > x0, (x - x0) / (x1 - x0), 1.0), 0.0), 1.0)


@EXPRESSIONS.function("float float float float float float", "float")
def key_number(before: Any, x: Any, x0: Any, x1: Any, v0: Any, v1: Any) -> Any:
    """From x0 on: v0 + (v1 - v0) s with s = (x - x0) / (x1 - x0) held within 0 and 1; else what stood before."""
    return where(x >= x0, v0 + (v1 - v0) * _share(x, x0, x1), before)


@EXPRESSIONS.function("vec3 float float float vec3 vec3", "vec3")
def key_vector(before: Any, x: Any, x0: Any, x1: Any, v0: Any, v1: Any) -> Any:
    """`key_number` for vectors."""
    return where(x >= x0, v0 + (v1 - v0) * _share(x, x0, x1), before)


@EXPRESSIONS.function("float float float float float float float float", "float")
def spline_number(before: Any, x: Any, x0: Any, x1: Any, v0: Any, v1: Any, m0: Any, m1: Any) -> Any:
    """From x0 on: v0 + (v1 - v0) (3 s^2 - 2 s^3) + (m0 s (1 - s)^2 - m1 s^2 (1 - s)) (x1 - x0), Hermite's cubic with the
    slopes m0 and m1 and with s as in `key_number`; else what stood before."""
    s = _share(x, x0, x1)
    rest = 1.0 - s
    bend = (m0 * (s * rest * rest) - m1 * (s * s * rest)) * (x1 - x0)
    return where(x >= x0, v0 + (v1 - v0) * (s * s * (3.0 - 2.0 * s)) + bend, before)


@EXPRESSIONS.function("vec3 float float float vec3 vec3 vec3 vec3", "vec3")
def spline_vector(before: Any, x: Any, x0: Any, x1: Any, v0: Any, v1: Any, m0: Any, m1: Any) -> Any:
    """`spline_number` for vectors."""
    s = _share(x, x0, x1)
    rest = 1.0 - s
    bend = (m0 * (s * rest * rest) - m1 * (s * s * rest)) * (x1 - x0)
    return where(x >= x0, v0 + (v1 - v0) * (s * s * (3.0 - 2.0 * s)) + bend, before)


@EXPRESSIONS.function("float float float", "float")
def smooth_between(x: Any, x0: Any, x1: Any) -> Any:
    """x moved within [x0, x1] so that it starts and ends at rest: x0 + (x1 - x0) (3 s^2 - 2 s^3)."""
    s = _share(x, x0, x1)
    return where((x >= x0) & (x < x1), x0 + (x1 - x0) * (s * s * (3.0 - 2.0 * s)), x)


@EXPRESSIONS.function("float float float", "float")
def held_between(x: Any, x0: Any, x1: Any) -> Any:
    """x0 for x within [x0, x1), else x."""
    return where((x >= x0) & (x < x1), x0, x)


@EXPRESSIONS.function("float float float", "float")
def looped(x: Any, x0: Any, x1: Any) -> Any:
    """x brought into [x0, x1) by whole periods."""
    return x - floor((x - x0) / (x1 - x0)) * (x1 - x0)


@EXPRESSIONS.function("float float float", "float")
def mirrored(x: Any, x0: Any, x1: Any) -> Any:
    """x brought into [x0, x1], there and back."""
    turns = (x - x0) / (x1 - x0)
    phase = turns - floor(turns * 0.5) * 2.0
    return x0 + minimum(phase, 2.0 - phase) * (x1 - x0)
