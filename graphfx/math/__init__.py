"""Scalar mathematics whose one text serves plain Python and the block machine."""

from .primitives import (
    absolute,
    by_precision,
    copysign,
    floor,
    fma,
    maximum,
    minimum,
    scale2,
    split2,
    sqrt,
    where,
)
from .vec3 import Vec3, cross, dot, length, rotate, unit

__all__ = ["Vec3", "absolute", "by_precision", "copysign", "cross", "dot", "floor", "fma", "length", "maximum",
           "minimum", "rotate", "scale2", "split2", "sqrt", "unit", "where"]
