"""Sums and products that keep in a second number what rounding takes: no digits go where they cancel.

A value in two numbers is (high, low): high is the value rounded, low the rest. [Dekker 1971; Ogita, Rump and Oishi 2005]
"""

from __future__ import annotations

from typing import Any

from .primitives import fma
from .vec3 import Vec3

__all__ = ["determinant", "moment", "square_in_two", "sum_in_two"]


def sum_in_two(a: Any, b: Any) -> tuple[Any, Any]:
    """a + b = high + low, exactly. [Knuth 1969]"""
    high = a + b
    other = high - a
    return high, (a - (high - other)) + (b - other)


def square_in_two(v: Any) -> tuple[Any, Any]:
    """v . v in two numbers, to about the square of the rounding unit."""
    x, y, z = v.x * v.x, v.y * v.y, v.z * v.z
    rest = (fma(v.x, v.x, -x) + fma(v.y, v.y, -y)) + fma(v.z, v.z, -z)
    two, two_rest = sum_in_two(x, y)
    all_three, last_rest = sum_in_two(two, z)
    rest = rest + (two_rest + last_rest)
    high = all_three + rest
    return high, (all_three - high) + rest


def determinant(a: Any, b: Any, c: Any, d: Any) -> Any:
    """a d - b c to 1.5 ulp. [Kahan; Jeannerod, Louvet and Muller 2013]"""
    product = b * c
    return fma(a, d, -product) + fma(-b, c, product)


def moment(a: Any, b: Any) -> Any:
    """a x b with every component to 1.5 ulp, for vectors that are nearly parallel too."""
    return Vec3(determinant(a.y, a.z, b.y, b.z), determinant(a.z, a.x, b.z, b.x), determinant(a.x, a.y, b.x, b.y))
