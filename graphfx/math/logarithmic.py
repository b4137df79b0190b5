"""log2, log and power, in both precisions.

The coefficients are minimax fits by Remez exchange of the relative error, in 45 digits; each was rounded
to its precision in turn, lowest power first, and the rest fitted again.
"""

from __future__ import annotations

import math
from typing import Any

from .exponential import exp2_fraction_double, exp2_fraction_single
from .primitives import absolute, by_precision, floor, fma, maximum, minimum, scale2, split2, where

__all__ = ["log", "log2", "power"]

INFINITY = math.inf
NAN = math.nan


def log2_fraction_single(m: Any) -> Any:
    """log2 of m, sqrt(1/2) <= m < sqrt(2), with a relative error of 9e-8."""
    u = m - 1.0
    p = fma(u, fma(u, -0.14697051, 0.2098096), -0.18752757)
    p = fma(u, fma(u, p, 0.2005286), -0.23955122)
    p = fma(u, fma(u, p, 0.2887881), -0.36070707)
    p = fma(u, fma(u, p, 0.4808944), -0.7213472)
    return fma(u, fma(u, p, 0.44269505), u)


def log2_fraction_double(m: Any) -> tuple[Any, Any]:
    """log2 of m, sqrt(1/2) <= m < sqrt(2), as the sum of two numbers, with a relative error of 3e-18.

        log2 m = 2/ln 2 (t + t^3/3 + t^5/5 + ...),  t = (m - 1)/(m + 1)

    The first term, quotient and product, is held in two numbers; the rest is below 1/100 of it.
    """
    u, d = m - 1.0, m + 1.0
    d_low = m - (d - 1.0)
    reciprocal = 1.0 / d
    t = u * reciprocal
    t_low = fma(t, -d_low, fma(-t, d, u)) * reciprocal
    q = t * t
    p = fma(q, fma(q, 0.19090898679057813, 0.19119155714234018), 0.22198715207231234)
    p = fma(q, fma(q, p, 0.26230761919441853), 0.3205989034603024)
    p = fma(q, fma(q, p, 0.4121985830825493), 0.5770780163556544)
    tail = t * q * fma(q, p, 0.9617966939259756)
    first = t * 2.8853900817779268
    first_low = fma(t, 2.8853900817779268, -first) + fma(t_low, 2.8853900817779268, t * 4.0710547481862066e-17)
    high = first + tail
    return high, ((first - high) + tail) + first_low


def defined(value: Any, x: Any) -> Any:
    """A logarithm's value for finite x > 0; -infinity at 0, infinity at infinity, NaN for x < 0 and NaN."""
    return where(x > 0.0, where(x < INFINITY, value, x), where(x < 0.0, x * NAN, x - INFINITY))


def log2_single(x: Any) -> Any:
    """The logarithm to base 2.

        log2 x = e + log2 m,  x = m 2**e,  sqrt(1/2) <= m < sqrt(2)

    Relative error: 1.2e-7 in float32, 1.2e-16 in float64, near x = 1 and for denormal x too.
    Powers of two are exact. log2(0) is -infinity; NaN for x < 0 and NaN.
    """
    denormal = x < 1.17549435e-38
    m, e = split2(where(denormal, x * 16777216.0, x))
    return defined(where(denormal, e - 24.0, e) + log2_fraction_single(m), x)


def log2_double(x: Any) -> Any:
    """log2 in float64."""
    denormal = x < 2.2250738585072014e-308
    m, e = split2(where(denormal, x * 18014398509481984.0, x))
    e = where(denormal, e - 54.0, e)
    high, low = log2_fraction_double(m)
    total = e + high
    return defined(total + (((e - total) + high) + low), x)


log2 = by_precision(log2_single, log2_double)


def log_single(x: Any) -> Any:
    """The natural logarithm, log2(x) ln 2.

    Relative error: 1.6e-7 in float32, 2.4e-16 in float64, near x = 1 and for denormal x too.
    log(0) is -infinity; NaN for x < 0 and NaN.
    """
    turns = log2_single(x)
    return turns * 0.6931472


def log_double(x: Any) -> Any:
    """log in float64."""
    return log2_double(x) * 0.6931471805599453


log = by_precision(log_single, log_double)


def power_single(x: Any, y: Any) -> Any:
    """x**y, for x >= 0.

        x**y = 2**k 2**r,  k = floor(y log2 x),  r = (y e - k) + y log2 m,  x = m 2**e

    With y e - k and y log2 m apart, few digits are lost where y log2 x is large. Relative error in float32: 1.4e-7 where
    y e is exact (y = 1/2, 1, 3/2, 2, 3, ...), else 1.4e-7 + 6e-8 |y log2 x|; in float64, which keeps y e in two
    numbers, 2e-16 + 5e-18 |y log2 x|.

    power(x, 0) and power(1, y) are 1. power(0, y) is 0 for y > 0 and infinite for y < 0; power(infinity, y)
    the other way about. x < 2**-126 (float64: 2**-1022), denormal, counts as 0. Results beyond the range are
    infinite, or 0 for those that would be denormal. NaN for x < 0, for a NaN and for infinite y. At x = 0
    and infinity, the size of y must be 0 or at least 1e-36 (float64: 1e-290).
    """
    m, e = split2(x)
    f = log2_fraction_single(m)
    e = where(x >= 1.17549435e-38, where(x < INFINITY, e, 3e38), where(x >= 0.0, -3e38, e * NAN))
    scaled = y * e
    k = floor(minimum(128.0, maximum(-127.0, fma(y, f, scaled))))
    r = minimum(1.1, maximum(-0.1, fma(y, f, scaled - k)))
    return scale2(exp2_fraction_single(r), k)


def power_double(x: Any, y: Any) -> Any:
    """power in float64."""
    m, e = split2(x)
    f, f_low = log2_fraction_double(m)
    e = where(x >= 2.2250738585072014e-308, where(x < INFINITY, e, 1e300), where(x >= 0.0, -1e300, e * NAN))
    scaled = y * e
    scaled_low = where(absolute(scaled) < 1e9, fma(y, e, -scaled), 0.0)
    k = floor(minimum(1024.0, maximum(-1023.0, fma(y, f, scaled))))
    r = fma(y, f, scaled - k) + fma(y, f_low, scaled_low)
    return scale2(exp2_fraction_double(minimum(1.1, maximum(-0.1, r))), k)


power = by_precision(power_single, power_double)
