"""The Runge-Kutta pair of orders 5 and 4 of Dormand and Prince 1980, and the classical one of order 4 for a part of a motion."""

from __future__ import annotations

from typing import Any

from graphfx.math import cross
from graphfx.motion.basic import MOTION

INSTANTS = (0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0)
"""Where in the step each rate is found."""
STAGES = (
    (),
    (1 / 5,),
    (3 / 40, 9 / 40),
    (44 / 45, -56 / 15, 32 / 9),
    (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
    (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
    (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
)
"""How much of each earlier rate leads to where the next is found; the last is the result, of order 5."""
ERRORS = (71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40)
"""How much of each rate is in the difference from the result of order 4."""


@MOTION.function("vec3 vec3 float float", "vec3")
def advance_by(value: Any, rate: Any, dt: Any, share: Any) -> Any:
    """value + rate share dt."""
    return value + rate * (share * dt)


@MOTION.function("vec3 vec3 float vec3 float", "vec3")
def linear_rate(position: Any, velocity: Any, damping: Any, turning: Any, stiffness: Any) -> Any:
    """-d V + w x V - k P."""
    return cross(turning, velocity) - velocity * damping - position * stiffness


@MOTION.function("vec3 vec3 vec3 vec3", "vec3")
def classical_rate(first: Any, second: Any, third: Any, last: Any) -> Any:
    """(k1 + 2 k2 + 2 k3 + k4) / 6. [Kutta 1901]"""
    return (first + last + (second + third) * 2.0) * 0.16666666666666666
