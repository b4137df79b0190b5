"""The operations from which every formula is made, for plain Python on NumPy scalars.

These definitions are the meaning: the block machine has an instruction or two for each, and must give
the same bits. A *lane value* is an np.float32 or an np.float64. A Python float is a literal: it takes
the precision of the lane values that it meets, and is a double where it meets none. Every function also
takes NumPy arrays, element by element, so that tests and plans can evaluate a formula on many values.

Division by zero, overflow and invalid operations follow IEEE 754; callers run under
`np.errstate(all="ignore")`. The sign of a NaN means nothing. Denormals are kept.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .fused import fma
from .precision import lane_type

__all__ = ["absolute", "by_precision", "copysign", "floor", "fma", "maximum", "minimum", "scale2", "split2",
           "sqrt", "where"]

NOT_A_CONDITION = "where takes a comparison, or comparisons joined by & | ~, of lane values; not {}"
SPLIT_FORMATS: dict[Any, tuple[int, int, Any]] = {  # bits of float(sqrt(1/2)), bits of the fraction, integer type
    np.float32: (0x3F3504F3, 23, np.int32),
    np.float64: (0x3FE6A09E667F3BCD, 52, np.int64),
}


def where(condition: Any, a: Any, b: Any) -> Any:
    """a where the condition holds, else b; of two Vec3, the whole vector. Both sides are evaluated."""
    if hasattr(a, "where"):
        return a.where(condition, b)
    if isinstance(condition, np.ndarray):
        return np.where(condition, a, b)
    if not isinstance(condition, (bool, np.bool_)):
        raise TypeError(NOT_A_CONDITION.format(f"{condition!r} of type {type(condition).__name__}"))
    chosen, other = (a, b) if condition else (b, a)
    if type(chosen) in (float, int) and isinstance(other, np.generic):
        return type(other)(chosen)
    return chosen


def floor(x: Any) -> Any:
    """The greatest integer <= x; infinities and NaN as they are."""
    return np.floor(x)


def sqrt(x: Any) -> Any:
    """The square root, correctly rounded; NaN for x < 0, and -0 for -0."""
    if isinstance(x, np.ndarray):
        with np.errstate(invalid="ignore"):
            return np.sqrt(x)
    return lane_type(x)(math.sqrt(x) if x >= 0.0 else math.nan)


def minimum(a: Any, b: Any) -> Any:
    """a if a < b else b: so b where either is NaN, and b of two zeros."""
    return where(a < b, a, b)


def maximum(a: Any, b: Any) -> Any:
    """a if a > b else b: so b where either is NaN, and b of two zeros."""
    return where(a > b, a, b)


def absolute(x: Any) -> Any:
    """x without its sign."""
    return np.abs(x)


def copysign(x: Any, y: Any) -> Any:
    """The size of x with the sign of y, that of a zero included."""
    return np.copysign(x, y)


def scale2(x: Any, k: Any) -> Any:
    """x * 2**k, rounded once, for an integral k from -127 to 128 (float64: -1023 to 1024).

    The factor is made from its bits, (k + 127) << 23. So the two ends are not powers of two: at -127
    (-1023) the factor is 0, and at 128 (1024) it is infinite; this is how exp2 underflows and
    overflows. A k outside them is a mistake. NaN is allowed as k where x is NaN too: the result is NaN.
    """
    kind = lane_type(x, k)
    least, most = (-127, 128) if kind is np.float32 else (-1023, 1024)
    if isinstance(x, np.ndarray) or isinstance(k, np.ndarray):
        exponents = np.clip(np.where(np.isnan(k), 0, k), least, most).astype(np.int32)
        factor = np.ldexp(1.0, exponents, where=exponents < most, out=np.full(exponents.shape, np.inf))
        return x * np.where(exponents > least, factor, 0.0).astype(kind)
    exponent = least if not k > least else most if k >= most else int(k)
    if exponent == least:
        return x * kind(0.0)
    return x * kind(math.inf if exponent == most else math.ldexp(1.0, exponent))


def split2(x: Any) -> Any:
    """(m, e) with x = m * 2**e and sqrt(1/2) <= m < sqrt(2), for a positive normal x.

    With b the bits of x as a signed integer and h those of sqrt(1/2): e = (b - h) >> 23 and the bits of
    m are b - (e << 23), wrapping (52 for float64). For other x they are numbers without meaning, m
    still from sqrt(1/2) to sqrt(2) and e from -256 to 256 (-2048 to 2048).
    """
    kind = lane_type(x)
    half, fraction, integer = SPLIT_FORMATS[kind]
    bits = np.atleast_1d(np.asarray(x, kind)).view(integer)
    exponent = (bits - integer(half)) >> fraction
    m, e = (bits - (exponent << fraction)).view(kind), exponent.astype(kind)
    return (m, e) if isinstance(x, np.ndarray) else (m[0], e[0])


class by_precision:
    """A function that runs `single` when its first argument is float32, `double` when it is float64.

    Of a Vec3 its x counts. A Python float counts as a double. The block machine chooses by type in the same way, when it
    compiles; it finds the two functions as `.single` and `.double`.
    """

    def __init__(self, single: Callable[..., Any], double: Callable[..., Any]) -> None:
        """Take the function's name and documentation from `single`."""
        self.single = single
        self.double = double
        self.__name__ = single.__name__.removesuffix("_single")
        self.__qualname__ = self.__name__
        self.__module__ = single.__module__
        self.__doc__ = single.__doc__

    def __call__(self, *arguments: Any) -> Any:
        """Run the function of the first argument's precision."""
        first = arguments[0]
        chosen = self.single if lane_type(getattr(first, "x", first)) is np.float32 else self.double
        return chosen(*arguments)

    def __repr__(self) -> str:
        """Say what it is."""
        return f"<function {self.__module__}.{self.__name__} by precision>"
