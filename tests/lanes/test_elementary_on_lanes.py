"""Elementary functions and vectors give the same bits on lanes as in plain Python."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.math import (
    Vec3,
    acos,
    atan2,
    cos,
    cosinc,
    cross,
    dot,
    exp,
    exp2,
    expm1,
    length,
    log,
    log2,
    phi1,
    phi2,
    power,
    rotate,
    sin,
    sin3,
    sinc,
    sincos,
    unit,
    where,
)
from graphfx.program import Bundle

from .blocks import WIDTHS, adversarial, in_plain_python, on_lanes, pairs, same_bits, scattered

BUNDLE = Bundle("test_elementary")


@BUNDLE.function("float", "float float float float")
def angles(x):
    s, c = sincos(x)
    return s, c, sin(x), cos(x)


@BUNDLE.function("float", "float float float")
def exponentials(x):
    return exp2(x), exp(x), expm1(x)


@BUNDLE.function("float", "float float")
def logarithms(x):
    return log2(x), log(x)


@BUNDLE.function("float", "float float float float float")
def quotients(x):
    return phi1(x), phi2(x), sinc(x), cosinc(x), sin3(x)


@BUNDLE.function("float", "float")
def arcs(x):
    return acos(x)


@BUNDLE.function("float float", "float float")
def two_arguments(x, y):
    return power(x, y), atan2(x, y)


@BUNDLE.function("vec3 vec3 float", "vec3 vec3 vec3 vec3 vec3 vec3")
def vector_arithmetic(a, b, k):
    total = a
    total += b
    total -= a * 0.5
    return a + b, a - b, -a, a * k + k * b, a / k, total * k


@BUNDLE.function("vec3 vec3 float", "float vec3 float vec3 vec3 vec3")
def vector_functions(a, b, k):
    s, c = sincos(k)
    return dot(a, b), cross(a, b), length(a), unit(b), rotate(a, unit(b), s, c), where(k > 0.0, a, b)


@BUNDLE.function("vec3 float", "vec3 vec3 float vec3 vec3")
def components(a, k):
    up = Vec3(where(k > 0.0, 0.0, 0.1), 1 / 3, 0.0)
    return Vec3(a.y, 1.0, k), Vec3(k, k * 2.0, a.z) * 3.0, dot(Vec3(1.0, k, 0.0), a), Vec3(0.1, 2, -0.0), cross(up, a)


ONE = [angles, exponentials, logarithms, quotients, arcs]


@pytest.mark.parametrize("precision, width", WIDTHS)
@pytest.mark.parametrize("function", ONE, ids=lambda function: function.name)
def test_functions_of_one_number(function, precision, width):
    """Hostile and random numbers, of ordinary size and of any, have one result."""
    draw = np.random.default_rng(10)
    random = [draw.uniform(-2, 2, 300), draw.uniform(-110, 110, 300)]
    values = np.concatenate([adversarial(precision), scattered(precision, 300, 11), *random]).astype(f"f{precision // 8}")
    same_bits(on_lanes(function, [values], precision, width), in_plain_python(function, [values], precision), [values])


@pytest.mark.parametrize("precision, width", WIDTHS)
def test_functions_of_two_numbers(precision, width):
    """Powers and angles of hostile and random pairs have one result."""
    hostile = pairs(adversarial(precision)[:: 2 if width == 0 else 7])
    draw = np.random.default_rng(12)
    random = np.exp(draw.normal(0, 4, 500)), draw.normal(0, 5, 500)
    columns = [np.concatenate(both).astype(f"f{precision // 8}") for both in zip(hostile, random, strict=True)]
    same_bits(on_lanes(two_arguments, columns, precision, width), in_plain_python(two_arguments, columns, precision), columns)


@pytest.mark.parametrize("precision, width", WIDTHS)
@pytest.mark.parametrize("function", [vector_arithmetic, vector_functions], ids=lambda function: function.name)
def test_vectors(function, precision, width):
    """Operators and helpers of vectors round in one order, whatever stands in them."""
    few = adversarial(precision)
    parts = [
        np.concatenate([np.random.default_rng(20 + k).permutation(np.resize(few, 400)), scattered(precision, 400, 30 + k)])
        for k in range(7)
    ]
    columns = [tuple(parts[:3]), tuple(parts[3:6]), parts[6]]
    same_bits(on_lanes(function, columns, precision, width), in_plain_python(function, columns, precision), columns)


@pytest.mark.parametrize("precision, width", WIDTHS)
def test_vectors_of_literals_and_lanes(precision, width):
    """A vector made of lanes and literals takes the lanes' precision."""
    parts = [scattered(precision, 300, 40 + k) for k in range(4)]
    columns = [tuple(parts[:3]), parts[3]]
    same_bits(on_lanes(components, columns, precision, width), in_plain_python(components, columns, precision), columns)
