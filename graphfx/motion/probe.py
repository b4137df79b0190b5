"""Find the matrix of a `linear` operator by evaluating it on basis vectors.

An operator that adds to the rate of change of the velocity has an exact flow of the simple kind if

    rate(P, V) = g - d V + w x V - k P

for whatever parameters and attributes it has. That is tried on random ones when the plan is made; g, d, w and k
themselves are then found by evaluating the operator at V = 0, e_x and e_y, and at P = 2^60 e_x.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
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


def _random(type_: str, generator: np.random.Generator) -> Any:
    if type_ == "vec3":
        return Vec3(*map(np.float64, generator.normal(size=3)))
    if type_ == "bool":
        return np.bool_(True)
    return np.float64(generator.uniform(0.1, 2.0))
