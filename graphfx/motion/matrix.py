"""Exact flows of any linear motion, by the exponential of its matrix.

    (P, V)' = A (P, V) + (u, g),    so (P, V)(h) = exp(A h) (P, V) + F(h) (u, g),    F(h) = integral of exp(A t) from 0 to h

A is the same for all particles; the applied velocity u and the acceleration g are each particle's own. Exponentials are
found once for a step. Where steps differ by particle, h is a sum of binary fractions of the whole step, each a matrix, and
a rest so small that a short Taylor series is exact.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.program import Bundle

MATRIX = Bundle("matrix")

FRACTIONS = 24
"""Halvings of a step: the rest is 6e-8 of it."""
TERMS = 6
"""Terms of the Taylor series: with a rest of 6e-8 of a step h they are exact to 1e-14 for |A| h up to 5e5."""
NUMERATOR = (64764752532480000, 32382376266240000, 7771770303897600, 1187353796428800, 129060195264000, 10559470521600,
             670442572800, 33522128640, 1323241920, 40840800, 960960, 16380, 182, 1)  # fmt: skip
"""Coefficients of the Pade approximant of order 13, exact to 2^-53 for |A| up to 5.37. [Higham 2005, table 2.3]"""
MOST_GROWTH = 68.0
"""The logarithm of the greatest growth in a step: 3e29, which 32 bits can hold."""
LARGEST = 5.371920351148152


def exponential(matrix: np.ndarray) -> np.ndarray:
    """Return exp(A): the Pade approximant of order 13 of A / 2^s, squared s times. [Higham 2005, algorithm 2.3]"""
    size = np.abs(matrix).sum(axis=0).max()
    if not np.isfinite(size):
        return np.full_like(matrix, np.nan)
    halvings = max(int(np.ceil(np.log2(size / LARGEST))), 0) if size > 0 else 0
    scaled, unit = matrix * 2.0**-halvings, np.eye(len(matrix))
    second = scaled @ scaled
    fourth = second @ second
    sixth = second @ fourth
    b = NUMERATOR
    odd = sixth @ (b[13] * sixth + b[11] * fourth + b[9] * second) + b[7] * sixth + b[5] * fourth + b[3] * second + b[1] * unit
    even = sixth @ (b[12] * sixth + b[10] * fourth + b[8] * second) + b[6] * sixth + b[4] * fourth + b[2] * second + b[0] * unit
    odd = scaled @ odd
    found: np.ndarray = np.linalg.solve(even - odd, even + odd)
    for _ in range(halvings):
        found = found @ found
    return found


def propagators(matrix: np.ndarray, time: float) -> np.ndarray:
    """Return exp(A h) and F(h) of a matrix of 6 x 6, side by side: 6 x 12.

    They are the upper half of exp([[A, 1], [0, 0]] h), with places in units in which A is balanced. A step in which
    something would grow by more than e^68 counts as so much shorter.
    """
    growth = float(np.linalg.eigvals(matrix).real.max()) * time if np.isfinite(matrix).all() else 0.0
    time = time * (MOST_GROWTH / growth) if growth > MOST_GROWTH else time
    pull, drift = np.abs(matrix[3:, :3]).max(), np.abs(matrix[:3, 3:]).max()
    unit = 2.0 ** np.round(np.log2(pull / drift) / 2) if pull > 0 and drift > 0 else 1.0
    scale = np.repeat([unit, 1.0, unit, 1.0], 3)
    both = np.zeros((12, 12))
    both[:6, :6], both[:6, 6:] = matrix, np.eye(6)
    balanced = both * scale[:, None] / scale
    found: np.ndarray = exponential(balanced * time)[:6] / scale[:6, None] * scale
    return found


@MATRIX.function("vec3 vec3 vec3 vec3 vec3 vec3 vec3 vec3", "vec3")
def product(first: Any, second: Any, ax: Any, ay: Any, az: Any, bx: Any, by: Any, bz: Any) -> Any:
    """(A B) (first, second), a matrix of 3 x 6 given by its columns."""
    return (ax * first.x + ay * first.y + az * first.z) + (bx * second.x + by * second.y + bz * second.z)


@MATRIX.function("float float float", "bool")
def is_left(left: Any, length: Any, share: Any) -> Any:
    """Whether a share of a step's length is still to be gone."""
    return left >= length * share


@MATRIX.function("float float float", "float")
def less(left: Any, length: Any, share: Any) -> Any:
    """What is left after a share of a step's length."""
    return left - length * share


@MATRIX.function("vec3 vec3 vec3 vec3 float float", "vec3 vec3 vec3 vec3")
def next_term(position: Any, velocity: Any, rate: Any, change: Any, left: Any, share: Any) -> Any:
    """(P, V) with the next term of the Taylor series, and the term: the one before, changed by A, times h / n."""
    more, faster = rate * (left * share), change * (left * share)
    return position + more, velocity + faster, more, faster
