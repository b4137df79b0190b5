"""Find the matrix of a `linear` operator by evaluating it on basis vectors.

An operator that adds to the rate of change of the velocity has an exact flow of the simple kind if

    rate(P, V) = g - d V + w x V - k P

for whatever parameters and attributes it has. That is tried on random ones when the plan is made; g, d, w and k
themselves are then found by evaluating the operator at V = 0, e_x and e_y, and at P = 2^60 e_x.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from graphfx.math import Vec3

TRIALS = 4
TOLERANCE = 1e-12
SHORT = 2.0**-20
"""A time in which a particle goes straight on [s]."""


@dataclass(frozen=True)
class LinearForm:
    """Which of the terms an operator has: constant g, damping d, turning w, stiffness k."""

    constant: bool
    damping: bool
    turning: bool
    stiffness: bool = False


def _array(v: Vec3) -> np.ndarray:
    return np.array([v.x, v.y, v.z], np.float64)


def probe(function: Callable[..., Any], arguments: tuple[str, ...], types: tuple[str, ...]) -> LinearForm | None:
    """Return the form of a rate of change of the velocity, or None if it is not of the simple kind."""
    generator = np.random.default_rng(1990)
    constant = damping = turning = stiffness = False
    for _ in range(TRIALS):
        fixed = {name: _random(type_, generator) for name, type_ in zip(arguments, types, strict=True)}

        def rate(position: Any, velocity: Any, fixed: dict[str, Any] = fixed) -> np.ndarray:
            given = fixed | {
                name: Vec3(*map(np.float64, state))
                for name, state in (("position", position), ("velocity", velocity))
                if name in fixed
            }
            with np.errstate(all="ignore"):
                return _array(function(*(given[name] for name in arguments)))

        zero = np.zeros(3)
        g = rate(zero, zero)
        matrix = np.stack([rate(zero, axis) - g for axis in np.eye(3)], axis=1)
        pull = np.stack([rate(axis, zero) - g for axis in np.eye(3)], axis=1)
        d, k = -np.trace(matrix) / 3, -np.trace(pull) / 3
        w = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]]) / 2
        position, velocity = generator.normal(size=3), generator.normal(size=3)
        expected = g - d * velocity + np.cross(w, velocity) - k * position
        scale = 1 + np.abs(expected).max()
        if not np.allclose(rate(position, velocity), expected, rtol=0, atol=TOLERANCE * scale):
            return None
        constant |= bool(np.abs(g).max() > 0)
        damping |= bool(abs(d) > TOLERANCE * scale)
        turning |= bool(np.abs(w).max() > TOLERANCE * scale)
        stiffness |= bool(abs(k) > TOLERANCE * scale)
    return LinearForm(constant, damping, turning, stiffness)


def carries(function: Callable[..., Any], arguments: tuple[str, ...], types: tuple[str, ...], writes: tuple[str, ...]) -> bool:
    """Return whether a flow that gives position and velocity carries a particle by its velocity: P' = P + V dt + O(dt^2)."""
    generator = np.random.default_rng(1990)
    for _ in range(TRIALS):
        given = {name: _random(type_, generator) for name, type_ in zip(arguments, types, strict=True)}
        given["dt"] = np.float64(SHORT)
        with np.errstate(all="ignore"):
            result = dict(zip(writes, function(*(given[name] for name in arguments)), strict=True))
        moved = _array(result["position"]) - _array(given["position"]) if "position" in given else np.full(3, np.nan)
        wanted = _array(given["velocity"]) * SHORT if "velocity" in given else np.full(3, np.nan)
        if not np.allclose(moved, wanted, rtol=0, atol=1e-3 * SHORT):
            return False
    return True


@cache
def shape_of(function: Callable[..., Any], arguments: tuple[str, ...], types: tuple[str, ...], truths: tuple[bool, ...]) -> str:
    """Return the shape of a surface's solid, whatever its numbers: "plane", "convex", "hollow" (the outside is convex) or "".

    A signed distance is convex where the solid is, concave where the outside is, and both for a plane. That is tried with
    places from 1 mm to 1000 km apart; `truths` are the truths among the parameters, in order.
    """
    generator = np.random.default_rng(1990)
    kinds, given = dict(zip(arguments, types, strict=True)), iter(truths)
    fixed_truths = {name: np.bool_(next(given)) for name, type_ in kinds.items() if type_ == "bool"}
    convex = concave = True
    for _ in range(TRIALS):
        fixed = {name: _random(type_, generator) for name, type_ in kinds.items()} | fixed_truths
        vectors = [name for name, type_ in kinds.items() if type_ == "vec3" and name != "position"]
        fixed |= {name: Vec3(*np.abs(_array(fixed[name]) / np.linalg.norm(_array(fixed[name])))) for name in vectors}

        def distance(place: np.ndarray, fixed: dict[str, Any] = fixed) -> float:
            with np.errstate(all="ignore"):
                return float(function(*((fixed | {"position": Vec3(*place)})[name] for name in arguments))[0])

        for scale in (1e-3, 0.1, 1.0, 1.0, 1.0, 3.0, 10.0, 1e3, 1e6) * 2:
            a, c = generator.normal(size=3) * generator.uniform(0.0, 3.0) + generator.normal(size=(2, 3)) * scale
            over = (distance(a) + distance(c)) / 2 - distance((a + c) / 2)
            slack = TOLERANCE * (1 + np.abs((a, c)).max())
            convex &= bool(over >= -slack)
            concave &= bool(over <= slack)
    return "plane" if convex and concave else "convex" if convex else "hollow" if concave else ""


def _random(type_: str, generator: np.random.Generator) -> Any:
    if type_ == "vec3":
        return Vec3(*map(np.float64, generator.normal(size=3)))
    if type_ == "bool":
        return np.bool_(True)
    return np.float64(generator.uniform(0.1, 2.0))
