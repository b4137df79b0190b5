"""exp2, exp and expm1, in both precisions; logarithmic.py has their inverses.

The coefficients are minimax fits by Remez exchange of the relative error, in 45 digits; each was rounded
to its precision in turn, lowest power first, and the rest fitted again.

Results that would be denormal, below 2**-126 (float64: 2**-1022), are 0.
"""

from __future__ import annotations

from typing import Any

from .primitives import absolute, by_precision, floor, fma, maximum, minimum, scale2, where

__all__ = ["exp", "exp2", "expm1"]


def exp2_fraction_single(r: Any) -> Any:
    """2**r for 0 <= r <= 1, with a relative error of 8e-8; exactly 1 at 0."""
    p = fma(r, fma(r, 0.00021565985, 0.0012482288), 0.009673775)
    return fma(r, fma(r, fma(r, fma(r, p, 0.055486184), 0.24022909), 0.69314706), 1.0)


def exp2_fraction_double(r: Any) -> Any:
    """2**r for 0 <= r <= 1, with a relative error of 1.2e-16; exactly 1 at 0."""
    p = fma(r, fma(r, 6.270916184796152e-10, 6.55569298106076e-09), 1.0254061190335406e-07)
    p = fma(r, fma(r, p, 1.3208261804642058e-06), 1.5253183137586902e-05)
    p = fma(r, fma(r, p, 0.00015403511915375225), 0.001333355864177605)
    p = fma(r, fma(r, p, 0.009618129099318825), 0.055504108665627334)
    return fma(r, fma(r, fma(r, p, 0.24022650695906198), 0.693147180559946), 1.0)


def exp2_single(x: Any) -> Any:
    """2**x.

        2**x = 2**k 2**r,  k = floor(x)

    Relative error: 8e-8 in float32, 1.2e-16 in float64. Powers of two are exact. x >= 128 gives infinity and x < -126 gives 0
    (float64: 1024 and -1022); NaN gives NaN.
    """
    bounded = minimum(128.0, maximum(-127.0, x))
    k = floor(bounded)
    return scale2(exp2_fraction_single(bounded - k), k)


def exp2_double(x: Any) -> Any:
    """exp2 in float64."""
    bounded = minimum(1024.0, maximum(-1023.0, x))
    k = floor(bounded)
    return scale2(exp2_fraction_double(bounded - k), k)


exp2 = by_precision(exp2_single, exp2_double)


def exp_single(x: Any) -> Any:
    """e**x.

        e**x = 2**k 2**r,  k = floor(x log2 e),  r = x log2 e - k, the product in two numbers

    Relative error: 9.5e-8 in float32, 1.6e-16 in float64. exp(0) is 1. Infinite for x > 88.7228 and 0 for x < -87.3366
    (float64: 709.7827 and -708.3965); NaN gives NaN.
    """
    bounded = minimum(89.0, maximum(-88.0, x))
    turns = bounded * 1.442695
    rest = fma(bounded, 1.442695, -turns) + bounded * 1.925963e-08
    k = floor(turns)
    return scale2(exp2_fraction_single((turns - k) + rest), k)


def exp_double(x: Any) -> Any:
    """exp in float64."""
    bounded = minimum(710.0, maximum(-709.0, x))
    turns = bounded * 1.4426950408889634
    rest = fma(bounded, 1.4426950408889634, -turns) + bounded * 2.0355273740931033e-17
    k = floor(turns)
    return scale2(exp2_fraction_double((turns - k) + rest), k)


exp = by_precision(exp_single, exp_double)


def scaled_expm1_single(x: Any, shift: float, unit: float, most: float) -> Any:
    """(e**x - 1) unit, with unit = 2**-shift so that it overflows later; x above `most` counts as `most`.

        e**x - 1 = 2**k q + (2**k - 1),  q = e**r - 1,  x = k ln 2 + r,  |r| <= ln(2)/2

    For k = 0 that is q alone, and for no other k do the terms cancel.
    """
    bounded = minimum(most, maximum(-20.0, x))
    k = floor(fma(bounded, 1.442695, 0.5))
    r = fma(k, 1.904654e-09, fma(k, -0.6931472, bounded))
    p = fma(r, fma(r, 0.0013836025, 0.0083671305), 0.041667752)
    q = fma(r * r, fma(r, fma(r, p, 0.16666539), 0.49999997), r)
    factor = scale2(1.0, k - shift)
    return fma(factor, q, factor - unit)


def scaled_expm1_double(x: Any, shift: float, unit: float, most: float) -> Any:
    """scaled_expm1 in float64."""
    bounded = minimum(most, maximum(-40.0, x))
    k = floor(fma(bounded, 1.4426950408889634, 0.5))
    r = fma(k, -2.3190468138462996e-17, fma(k, -0.6931471805599453, bounded))
    p = fma(r, fma(r, 1.6373474351304838e-09, 2.5101796765841858e-08), 2.7572015708458246e-07)
    p = fma(r, fma(r, p, 2.7557264526583216e-06), 2.4801570019631958e-05)
    p = fma(r, fma(r, p, 0.00019841269867076227), 0.0013888888897707274)
    p = fma(r, fma(r, p, 0.008333333333328159), 0.041666666666648394)
    q = fma(r * r, fma(r, fma(r, p, 0.1666666666666667), 0.5000000000000001), r)
    factor = scale2(1.0, k - shift)
    return fma(factor, q, factor - unit)


def expm1_single(x: Any) -> Any:
    """e**x - 1, without loss near 0.

    Relative error: 1.3e-7 in float32, 2.6e-16 in float64, for small x too. Infinite for
    x > 88.7228 (float64: 709.7827); -1 at -infinity; NaN gives NaN.
    """
    return where(absolute(x) < 1e-8, x, scaled_expm1_single(x, 1.0, 0.5, 89.0) * 2.0)


def expm1_double(x: Any) -> Any:
    """expm1 in float64."""
    return where(absolute(x) < 1e-17, x, scaled_expm1_double(x, 1.0, 0.5, 710.0) * 2.0)


expm1 = by_precision(expm1_single, expm1_double)
