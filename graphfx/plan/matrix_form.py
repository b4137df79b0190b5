"""Which linear operators can be summed into one matrix: those whose rate of change has the same matrix for all particles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from graphfx.graph.values import Node, Random, Value, children
from graphfx.math import Vec3
from graphfx.motion.basic import FAR
from graphfx.plan.evaluate import particle_free_scope
from graphfx.plan.movers import MatrixForm, Mover, linear_form
from graphfx.plan.rates import Rate, rate_of
from graphfx.program import Function

TRIALS = 3
TOLERANCE = 1e-11
STATES = ("position", "velocity")
MOST_CONDITIONS = 4
"""Operators under `only` may divide particles into 16 classes, each with a matrix of its own."""


def columns_of(function: Function, arguments: tuple[str, ...], given: Mapping[str, Any]) -> np.ndarray:
    """Return the matrix M, 3 x 6, of a rate of change, found by evaluating it far out along each axis of P and of V."""
    zero = Vec3(*(np.float64(0.0) for _ in range(3)))
    rest = {name: zero for name in STATES if name in arguments}

    def rate(changed: dict[str, Any]) -> np.ndarray:
        with np.errstate(all="ignore"):
            result = function.body(*(({**given, **rest, **changed})[name] for name in arguments))
        return np.array([*result], np.float64)

    still, found = rate({}), np.zeros((3, 6))
    for k, name in enumerate(STATES):
        for axis in range(3) if name in arguments else ():
            far = Vec3(*(np.float64(FAR if part == axis else 0.0) for part in range(3)))
            found[:, 3 * k + axis] = (rate({name: far}) - still) / FAR
    return found


def matrix_form(mover: Mover, constants: Mapping[str, Value]) -> MatrixForm | None:
    """Return the form of an operator whose matrix is the same for all particles at a time, or None.

    `constants` are the attributes that are one for all.
    """
    node_type = mover.node.node_type
    if mover.role == "flow":
        as_rate = linear_form(mover) if not node_type.exact_if else None
        return matrix_form(as_rate, constants) if as_rate is not None else None
    if node_type.role not in ("linear", "flow") or "dt" in mover.arguments or mover.node.during is not None:
        return None
    given = {**constants, **mover.node.arguments}
    uniform = {name: given[name] for name in mover.arguments if name in given and name not in STATES and _is_uniform(given[name])}
    return _probed(mover, uniform)


def _is_uniform(value: Any) -> bool:
    """Return whether a parameter is one for all particles, found from the time alone."""
    return rate_of(value, particle_free_scope()) < Rate.PARTICLE and not _draws(value)


def _draws(tree: Any) -> bool:
    own = isinstance(tree, Random) or (isinstance(tree, Node) and tree.node_type is not None and tree.node_type.draws)
    return own or any(map(_draws, children(tree)))


def _probed(mover: Mover, uniform: dict[str, Value]) -> MatrixForm | None:
    """Return the form if the rate is affine in (P, V), with a matrix that depends on what is `uniform` alone."""
    random = np.random.default_rng(1962)
    types = dict(zip(mover.arguments, mover.function.arguments, strict=True))
    if not set(types.values()) <= {"float", "vec3", "bool"}:
        return None
    some_matrix = some_constant = False
    for _ in range(TRIALS):
        given = {name: random_value(kind, random) for name, kind in types.items()}
        matrix = columns_of(mover.function, mover.arguments, given)
        others = given | {name: random_value(types[name], random) for name in types if name not in uniform}
        states = {name: given.get(name, Vec3(0.0, 0.0, 0.0)) for name in STATES}
        still = {name: Vec3(*map(np.float64, (0, 0, 0))) for name in STATES if name in types}

        def rate(changed: dict[str, Any], mover: Mover = mover) -> np.ndarray:
            with np.errstate(all="ignore"):
                return np.array([*mover.function.body(*(changed[name] for name in mover.arguments))], np.float64)

        constant = rate(given | still)
        whole = constant + matrix @ np.array([*states["position"], *states["velocity"]])
        size = TOLERANCE * (1 + np.abs(matrix).max() + np.abs(constant).max())
        again = columns_of(mover.function, mover.arguments, others)
        if not (np.allclose(rate(given), whole, rtol=0, atol=size) and np.allclose(again, matrix, rtol=0, atol=size)):
            return None
        some_matrix |= bool(np.abs(matrix).max() > 0)
        some_constant |= bool(np.abs(constant).max() > 0)
    return MatrixForm(some_matrix, some_constant, uniform)


def random_value(kind: str, random: np.random.Generator) -> Any:
    """Return some value of an argument."""
    if kind == "vec3":
        return Vec3(*map(np.float64, random.normal(size=3)))
    return np.bool_(True) if kind == "bool" else np.float64(random.uniform(0.1, 2.0))


def gathered(movers: list[Mover], constants: Mapping[str, Value], method: str, drifts: bool) -> list[Mover]:
    """Return the operators, those that move in the form of a matrix if all together have none simpler and may have that.

    `constants` are the attributes that are one for all; `drifts` tells whether velocities carry particles beside the operators.
    """
    acting = [mover for mover in movers if not mover.idle and mover.role not in ("surface", "noise")]
    simple = all(mover.role == "linear" for mover in acting)
    alone = len(acting) == 1 and acting[0].role == "flow" and not (drifts and not acting[0].carries)
    conditions = [mover for mover in acting if mover.node.only is not None]
    noisy = any(mover.role == "noise" for mover in movers)
    if method == "sims" or simple or (alone and not noisy) or len(conditions) > MOST_CONDITIONS:
        return movers
    forms = {id(mover): matrix_form(mover, constants) for mover in acting}
    if None in forms.values():
        return movers
    return [_with_form(mover, forms[id(mover)]) if id(mover) in forms else mover for mover in movers]


def _with_form(mover: Mover, form: MatrixForm | None) -> Mover:
    rate = linear_form(mover) or mover
    return replace(rate, role="linear", form=None, matrix=form, idle=mover.idle, changing=mover.changing)
