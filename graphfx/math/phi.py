"""The functions of exact flows, without the digits lost near 0: phi1, phi2, sinc, cosinc and sin3.

    phi1(x) = (e**x - 1)/x                phi2(x) = (e**x - 1 - x)/x**2
    sinc(x) = sin(x)/x     cosinc(x) = (1 - cos x)/x**2     sin3(x) = (x - sin x)/x**3

The coefficients are minimax fits by Remez exchange of the relative error, in 45 digits; each was rounded
to its precision in turn, lowest power first, and the rest fitted again.
"""

from __future__ import annotations

import math
from typing import Any

from .exponential import scaled_expm1_double, scaled_expm1_single
from .primitives import absolute, by_precision, fma, where
from .trigonometric import sin

__all__ = ["cosinc", "phi1", "phi2", "sin3", "sinc"]

INFINITY = math.inf


def phi1_single(x: Any) -> Any:
    """(e**x - 1)/x, and 1 at 0.

    Relative error: 1.7e-7 in float32, 3.3e-16 in float64. Infinite only where the value is beyond
    the range (x > 93.25, float64: 716.35); 0 at -infinity; NaN gives NaN.
    """
    value = scaled_expm1_single(x, 10.0, 0.0009765625, 94.0) / (x * 0.0009765625)
    return where(absolute(x) < 1e-8, 1.0, where(x > 94.0, INFINITY, value))


def phi1_double(x: Any) -> Any:
    """phi1 in float64."""
    value = scaled_expm1_double(x, 16.0, 1.52587890625e-05, 718.0) / (x * 1.52587890625e-05)
    return where(absolute(x) < 1e-17, 1.0, where(x > 718.0, INFINITY, value))


phi1 = by_precision(phi1_single, phi1_double)


def phi2_single(x: Any) -> Any:
    """(e**x - 1 - x)/x**2, and 1/2 at 0.

        (phi1(x) - 1)/x for |x| >= 1, a polynomial below

    Relative error: 3.1e-7 in float32, 5.5e-16 in float64. Infinite only where the value is beyond the
    range (x > 97.86, float64: 722.94); 0 at -infinity; NaN gives NaN.
    """
    p = fma(x, fma(x, 2.880256e-07, 2.7806695e-06), 2.4792755e-05)
    p = fma(x, fma(x, p, 0.00019843488), 0.0013888871)
    p = fma(x, fma(x, p, 0.008333307), 0.041666668)
    near = fma(x, fma(x, p, 0.16666667), 0.5)
    first = scaled_expm1_single(x, 16.0, 1.52587890625e-05, 99.0) / x
    far = (first - 1.52587890625e-05) / (x * 1.52587890625e-05)
    return where(absolute(x) < 1.0, near, where(x > 99.0, INFINITY, far))


def phi2_double(x: Any) -> Any:
    """phi2 in float64."""
    p = fma(x, fma(x, 4.9487039657275885e-14, 7.739264487071632e-13), 1.14668166100837e-11)
    p = fma(x, fma(x, p, 1.6057971852460987e-10), 2.0876793795761122e-09)
    p = fma(x, fma(x, p, 2.505211304197499e-08), 2.7557319074197995e-07)
    p = fma(x, fma(x, p, 2.755731922659395e-06), 2.48015873017892e-05)
    p = fma(x, fma(x, p, 0.00019841269841194847), 0.0013888888888889007)
    p = fma(x, fma(x, p, 0.008333333333333505), 0.041666666666666664)
    near = fma(x, fma(x, p, 0.16666666666666666), 0.5)
    first = scaled_expm1_double(x, 24.0, 5.960464477539063e-08, 724.0) / x
    far = (first - 5.960464477539063e-08) / (x * 5.960464477539063e-08)
    return where(absolute(x) < 1.0, near, where(x > 724.0, INFINITY, far))


phi2 = by_precision(phi2_single, phi2_double)


def sinc(x: Any) -> Any:
    """sin(x)/x, and 1 at 0.

    Relative error for |x| <= pi/2: 1.5e-7 in float32, 2.5e-16 in float64; absolute error beyond: that of `sin`
    divided by x. NaN for infinities and NaN.
    """
    return where(x == 0.0, 1.0, sin(x) / x)


def cosinc(x: Any) -> Any:
    """(1 - cos x)/x**2, and 1/2 at 0.

        sinc(x/2)**2 / 2

    Relative error for |x| <= 3: 2.8e-7 in float32, 4.8e-16 in float64; beyond, relative to 1/x**2. NaN for infinities and NaN.
    """
    half = sinc(x * 0.5)
    return half * half * 0.5


def sin3_single(x: Any) -> Any:
    """(x - sin x)/x**3, and 1/6 at 0.

        (1 - sinc(x))/x**2 for |x| >= 2, a polynomial in x**2 below

    Relative error: 2.3e-7 in float32, 4.3e-16 in float64. NaN for infinities and NaN.
    """
    q = x * x
    near = fma(q, fma(q, fma(q, fma(q, 2.5644118e-08, -2.7680305e-06), 0.00019845094), -0.008333368), 0.16666667)
    return where(absolute(x) < 2.0, near, (1.0 - sinc(x)) / q)


def sin3_double(x: Any) -> Any:
    """sin3 in float64."""
    q = x * x
    p = fma(q, fma(q, 3.6893632922294125e-18, -2.7415061982298898e-15), 7.642650067837548e-13)
    p = fma(q, fma(q, p, -1.605889093027492e-10), 2.5052105503487318e-08)
    p = fma(q, fma(q, p, -2.7557319194390773e-06), 0.00019841269841120094)
    near = fma(q, fma(q, p, -0.008333333333333044), 0.16666666666666666)
    return where(absolute(x) < 2.0, near, (1.0 - sinc(x)) / q)


sin3 = by_precision(sin3_single, sin3_double)
