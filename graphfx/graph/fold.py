"""Compute at once what is the same for all particles at all times.

Only functions whose result is the same on every machine are computed here, in double precision:
arithmetic, comparison, choice, vectors. What divides by zero or overflows is left to the program.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from graphfx.graph.values import Call, Literal

_NUMBERS: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "negate": lambda a: -a,
    "less": lambda a, b: a < b,
    "less_equal": lambda a, b: a <= b,
    "greater": lambda a, b: a > b,
    "greater_equal": lambda a, b: a >= b,
    "equal": lambda a, b: a == b,
    "not_equal": lambda a, b: a != b,
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
    "not": lambda a: not a,
    "abs": abs,
    "floor": lambda a: float(math.floor(a)),
    "sqrt": math.sqrt,
    "min": lambda a, b: a if a < b else b,
    "max": lambda a, b: a if a > b else b,
    "clamp": lambda x, low, high: min(max(x, low), high),
    "vec": lambda x, y, z: (x, y, z),
    "interval": lambda start, end: (start, end),
    "component_x": lambda v: v[0],
    "component_y": lambda v: v[1],
    "component_z": lambda v: v[2],
    "select": lambda c, a, b: a if c else b,
}
_EACH = ("add", "subtract", "negate")
"""Functions that take vectors component by component."""


def constant(tree: Any) -> Any:
    """Return what a part of an expression is, where it is known: a float, a bool or a tuple; else None."""
    if isinstance(tree, Literal):
        return tree.value
    return tree if isinstance(tree, float | bool) else None


def fold(call: Call) -> Any:
    """Return what a call of known arguments gives, or the call."""
    arguments = [constant(argument) for argument in call.arguments]
    if call.function == "select" and arguments[0] is not None:
        return call.arguments[1 if arguments[0] else 2]
    compute = _NUMBERS.get(call.function)
    if compute is None or any(argument is None for argument in arguments):
        return call
    try:
        if call.function in _EACH and isinstance(arguments[0], tuple):
            result: Any = tuple(compute(*parts) for parts in zip(*arguments, strict=True))
        elif call.function in ("multiply", "divide") and any(isinstance(argument, tuple) for argument in arguments):
            scale = next(argument for argument in arguments if not isinstance(argument, tuple))
            vector = next(argument for argument in arguments if isinstance(argument, tuple))
            result = tuple(compute(part, scale) for part in vector)
        else:
            result = compute(*arguments)
    except (ZeroDivisionError, OverflowError, ValueError):
        return call
    finite = all(math.isfinite(part) for part in (result if isinstance(result, tuple) else (result,)))
    if not finite and not any(_infinite(argument) for argument in arguments):
        return call
    return Literal("vec3", value=result) if isinstance(result, tuple) else result


def _infinite(value: Any) -> bool:
    return any(math.isinf(part) for part in (value if isinstance(value, tuple) else (value,)))
