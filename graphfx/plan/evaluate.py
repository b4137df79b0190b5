"""Find values when the plan is made: constants, and what the frames need (cameras, rates)."""

from __future__ import annotations

from typing import Any

from graphfx.errors import GraphError, NodeError, Problem, suggestion
from graphfx.graph.expressions import parse
from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Literal, Value
from graphfx.math import Vec3
from graphfx.plan.rates import Rate, Scope, rate_of
from graphfx.plan.values import StepValues, ValueWriter, find_step_values
from graphfx.program import Uniform


def _nothing(name: str) -> Any:
    raise KeyError(name)


def particle_free_scope(seed: int = 0) -> Scope:
    """Return the scope of a place where there are no particles."""
    return Scope(seed, "", _nothing, _nothing, lambda name: True)  # type: ignore[arg-type]


def constant_value(tree: Any, precision: int = 64, seed: int = 0) -> Any:
    """Return the value of a tree that depends on nothing."""
    return timed_value(tree, 0.0, 0, precision, seed)


def timed_value(tree: Any, time: float, frame: int, precision: int = 64, seed: int = 0) -> Any:
    """Return the value of a tree that depends on time alone: a float, a bool, or a tuple of three floats."""
    scope = particle_free_scope(seed)
    if rate_of(tree, scope) == Rate.PARTICLE:
        place = tree if isinstance(tree, Value) else None
        raise GraphError(
            Problem(
                "this value must be one for all: it may depend on time, not on particles",
                *((place.location, place.path) if place else ()),
            )
        )
    steps = StepValues()
    operand = ValueWriter(steps.builder, scope, {}, steps, precision).operand(tree)
    value = operand.value if isinstance(operand, Uniform) and operand.value is not None else None
    if value is None:
        value = find_step_values(steps, time, frame, precision)[id(operand)]
    return tuple(float(part) for part in value) if isinstance(value, (tuple, Vec3)) else value


def holds(node: FlatNode, condition: str, precision: int = 64) -> bool:
    """Return whether a condition that a node type declares holds for constants given as parameters."""
    constants = {name: value for name, value in node.arguments.items() if isinstance(value, Literal)}

    varies: list[str] = []

    def resolve(name: str) -> tuple[Any, str] | str:
        if name in constants:
            value = constants[name]
            return value, "vec3" if isinstance(value.value, tuple) else "float"
        if name not in node.node_type.parameters:
            return f"it has no parameter '{name}'.{suggestion(name, node.node_type.parameters)}"
        varies.append(name)
        return f"'{name}' is not constant"

    tree, _, mistakes = parse(condition, resolve)
    if mistakes and not varies:
        declared = node.node_type
        message = f"its condition '{condition}' cannot be read: {mistakes[0].message}"
        raise NodeError(Problem(message, declared.location, declared.name))
    return not mistakes and bool(constant_value(tree, precision))
