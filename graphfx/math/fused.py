"""fma: a * b + c rounded once, as the processor's instruction does, but from ordinary arithmetic.

float32: the product of two is exact in double. Add c there, rounding to odd (a sum that is not exact
takes the neighbour whose last bit is 1): the double then lies on the right side of every tie of float32,
so that rounding it again is harmless. [Boldo and Melquiond 2008, Emulation of a FMA and correctly rounded
sums: proved algorithms using rounding to odd]

float64: by whole numbers, since Python divides those with one correct rounding; arrays by Boldo and
Melquiond's sum of three parts, where neither overflow nor underflow can touch it.
"""

from __future__ import annotations

import struct
from math import copysign, inf, isfinite, nextafter
from typing import Any

import numpy as np

from .precision import lane_type

LARGEST_SINGLE = 3.4028234663852886e38
PACK_DOUBLE = struct.Struct("<d").pack
SPLITTER = 134217729.0  # 2**27 + 1: cuts a double into halves whose products are exact


def fma(a: Any, b: Any, c: Any) -> Any:
    """a * b + c, rounded once; infinities, NaN and signed zeros as IEEE 754 has them."""
    kinds = (type(a), type(b), type(c))
    if np.ndarray in kinds:
        return fma_arrays(a, b, c)
    if np.float32 in kinds and np.float64 not in kinds:
        return fma_single(np.float32(a), np.float32(b), np.float32(c))
    return np.float64(fma_double(float(a), float(b), float(c)))


def fma_single(a: np.float32, b: np.float32, c: np.float32) -> np.float32:
    """fma of three float32."""
    product = float(a) * float(b)
    addend = float(c)
    total = product + addend
    back = total - product
    error = (product - (total - back)) + (addend - back)
    if error and not PACK_DOUBLE(total)[0] & 1 and isfinite(error):
        total = nextafter(total, copysign(inf, error))
    if -LARGEST_SINGLE < total < LARGEST_SINGLE:
        return np.float32(total)
    with np.errstate(over="ignore"):
        return np.float32(total)


def fma_double(a: float, b: float, c: float) -> float:
    """fma of three doubles."""
    if not (isfinite(a) and isfinite(b)):
        return a * b + c
    if not isfinite(c):
        return c
    (an, ad), (bn, bd), (cn, cd) = a.as_integer_ratio(), b.as_integer_ratio(), c.as_integer_ratio()
    numerator = an * bn * cd + cn * ad * bd
    if numerator == 0:
        return a * b + c
    try:
        return numerator / (ad * bd * cd)
    except OverflowError:
        return inf if numerator > 0 else -inf


def fma_arrays(a: Any, b: Any, c: Any) -> Any:
    """fma of arrays, and of arrays with scalars."""
    kind = lane_type(a, b, c)
    exact = fma_array_single if kind is np.float32 else fma_array_double
    with np.errstate(all="ignore"):
        return exact(*np.broadcast_arrays(*(np.asarray(x, kind) for x in (a, b, c))))


def fma_array_single(a: Any, b: Any, c: Any) -> Any:
    """fma of float32 arrays."""
    return sum_to_odd(a.astype(np.float64) * b.astype(np.float64), c.astype(np.float64)).astype(np.float32)


def fma_array_double(a: Any, b: Any, c: Any) -> Any:
    """fma of float64 arrays: three parts where that is safe, one by one elsewhere."""
    product, product_error = exact_product(a, b)
    head, head_error = exact_sum(c, product_error)
    top, top_error = exact_sum(product, head)
    result = np.asarray(top + sum_to_odd(head_error, top_error))
    unsafe = ~(within(a, 2.0**500) & within(b, 2.0**500) & within(c, 2.0**1000) & (abs(product) > 2.0**-900))
    for i in zip(*np.nonzero(unsafe), strict=True):
        result[i] = fma_double(float(a[i]), float(b[i]), float(c[i]))
    return result


def within(x: Any, bound: float) -> Any:
    """Whether |x| < bound; not for NaN."""
    return abs(x) < bound


def exact_sum(x: Any, y: Any) -> tuple[Any, Any]:
    """(s, e) with s + e = x + y and s the rounded sum. [Knuth, TAOCP 2, 4.2.2]"""
    total = x + y
    back = total - x
    return total, (x - (total - back)) + (y - back)


def exact_product(x: Any, y: Any) -> tuple[Any, Any]:
    """(p, e) with p + e = x * y and p the rounded product. [Dekker 1971]"""
    product = x * y
    x_cut, y_cut = x * SPLITTER, y * SPLITTER
    x_high, y_high = x_cut - (x_cut - x), y_cut - (y_cut - y)
    x_low, y_low = x - x_high, y - y_high
    error = x_low * y_low - (((product - x_high * y_high) - x_low * y_high) - x_high * y_low)
    return product, error


def sum_to_odd(x: Any, y: Any) -> Any:
    """x + y of float64 arrays, rounded to odd."""
    total, error = exact_sum(x, y)
    even = (total.view(np.int64) & 1) == 0
    towards = np.copysign(np.inf, error)
    return np.where((error != 0.0) & np.isfinite(error) & even, np.nextafter(total, towards), total)
