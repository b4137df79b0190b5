"""Vec3: three lane values, and the operations on such vectors.

Every operation is written out in plain arithmetic, so a product that should cancel exactly does: the
cross product of a vector with itself is 0. Components may be literals, scalars or arrays (primitives.py).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .primitives import sqrt, where

__all__ = ["Vec3", "cross", "dot", "length", "rotate", "unit"]


class Vec3:
    """A vector (x, y, z)."""

    __slots__ = ("x", "y", "z")
    __array_ufunc__ = None  # so that NumPy's scalar * Vec3 comes here

    def __init__(self, x: Any, y: Any, z: Any) -> None:
        """From its components."""
        self.x = x
        self.y = y
        self.z = z

    def __add__(self, other: Vec3) -> Vec3:
        """The sum."""
        return Vec3(self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Vec3) -> Vec3:
        """The difference."""
        return Vec3(self.x - other.x, self.y - other.y, self.z - other.z)

    def __mul__(self, factor: Any) -> Vec3:
        """The vector times a scalar."""
        return Vec3(self.x * factor, self.y * factor, self.z * factor)

    def __rmul__(self, factor: Any) -> Vec3:
        """A scalar times the vector."""
        return Vec3(self.x * factor, self.y * factor, self.z * factor)

    def __truediv__(self, divisor: Any) -> Vec3:
        """Each component divided by a scalar."""
        return Vec3(self.x / divisor, self.y / divisor, self.z / divisor)

    def __neg__(self) -> Vec3:
        """The opposite vector."""
        return Vec3(-self.x, -self.y, -self.z)

    def __iter__(self) -> Iterator[Any]:
        """The components x, y, z."""
        return iter((self.x, self.y, self.z))

    def __repr__(self) -> str:
        """As it is written."""
        return f"Vec3({self.x}, {self.y}, {self.z})"

    def where(self, condition: Any, other: Vec3) -> Vec3:
        """This vector where the condition holds, else the other: what where(condition, self, other) calls."""
        return Vec3(where(condition, self.x, other.x), where(condition, self.y, other.y),
                    where(condition, self.z, other.z))


def dot(a: Vec3, b: Vec3) -> Any:
    """a.x b.x + a.y b.y + a.z b.z."""
    return a.x * b.x + a.y * b.y + a.z * b.z


def cross(a: Vec3, b: Vec3) -> Vec3:
    """The vector at right angles to both, right-handed: x cross y is z."""
    return Vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


def length(v: Vec3) -> Any:
    """sqrt(v . v).

    Right to 2 ulp for lengths of 1e-18 to 1e19 (float64: 1e-153 to 1e154), the middle half of the
    exponents. Beyond, the squares leave the range: longer is infinite, shorter loses digits and is then 0.
    """
    return sqrt(dot(v, v))


def unit(v: Vec3) -> Vec3:
    """v / |v|, and 0 for the zero vector.

    Its length is 1 to 3 ulp where `length` is right. A vector too short or too long for `length`, whose
    square is 0 or infinite, gives 0.
    """
    size = length(v)
    return v * where(size > 0.0, 1.0 / size, 0.0)


def rotate(v: Vec3, axis: Vec3, s: Any, c: Any) -> Vec3:
    """v turned about the unit vector axis by the angle with sine s and cosine c, right-handed.

        along + (v - along) c + (axis x v) s,    along = axis (axis . v)

    The part along the axis is untouched: about a coordinate axis it keeps its bits. An axis whose length
    squared is 1 + d grows the height by d (1 - c) and the radius by d s^2/2, relatively, at every turn, so
    hand over what `unit` gives. [Rodrigues 1840]
    """
    along = axis * dot(axis, v)
    across = v - along
    return along + across * c + cross(axis, across) * s
