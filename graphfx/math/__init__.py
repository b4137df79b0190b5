"""Scalar mathematics whose one text serves plain Python and the block machine.

Random numbers are in `graphfx.math.random`.
"""

from .exponential import exp, exp2, expm1
from .kepler import kepler
from .logarithmic import log, log2, power
from .noise import curl_noise
from .phi import cosinc, phi1, phi2, sin3, sinc
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
from .sampling import around, on_unit_sphere
from .trigonometric import acos, atan2, cos, sin, sincos
from .vec3 import Vec3, cross, dot, length, rotate, unit

__all__ = [
    "Vec3", "absolute", "acos", "around", "atan2", "by_precision", "copysign", "cos", "cosinc", "cross", "curl_noise",
    "dot", "exp", "exp2", "expm1", "floor", "fma", "kepler", "length", "log", "log2", "maximum", "minimum", "on_unit_sphere",
    "phi1", "phi2", "power", "rotate", "scale2", "sin", "sin3", "sinc", "sincos", "split2", "sqrt", "unit", "where",
]
