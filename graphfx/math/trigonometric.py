"""sincos, sin, cos, atan2 and acos, in both precisions.

The coefficients are minimax fits by Remez exchange of the relative error, in 45 digits; each was rounded
to its precision in turn, lowest power first, and the rest fitted again.
"""

from __future__ import annotations

from typing import Any

from .primitives import absolute, by_precision, copysign, floor, fma, maximum, minimum, sqrt, where

__all__ = ["acos", "atan2", "cos", "sin", "sincos"]


def sincos_single(x: Any) -> Any:
    """(sin x, cos x), x in radians.

        y = x - k pi/2,  S = sin y,  C = cos y:    (sin x, cos x) = (S, C) (C, -S) (-S, -C) (-C, S)

    for k = 0 1 2 3 modulo 4. k is the integer nearest 2x/pi, with pi/2 held in two numbers; S and C are
    polynomials of degree 7 and 8 (float64: 13 and 14). [reduction: Cody and Waite 1980]

    Absolute error of each: 7.5e-8 for |x| <= 2e5 in float32, 1.3e-16 for |x| <= 1e13 in float64. Relative
    error of sin x for |x| <= pi/2: 9.5e-8 and 1.9e-16. For larger |x| the angle loses its meaning, but for
    every finite x the result is on the circle: |s^2 + c^2 - 1| <= 1.4e-7 (2.4e-16), and its mean over the
    angles is below 1e-9 (1e-17), so that turning many times neither shrinks nor grows a radius.
    NaN for infinities and NaN. sin(-0) is +0.
    """
    k = floor(fma(x, 0.63661975, 0.5))
    y = fma(k, 4.371139e-08, fma(k, -1.5707964, x))
    y = minimum(0.8, maximum(-0.8, y))
    q = y * y
    s = fma(y * q, fma(q, fma(q, -0.0001950554, 0.008332095), -0.16666654), y)
    c = fma(q, fma(q, fma(q, fma(q, 2.4412086e-05, -0.001388713), 0.04166664), -0.5), 1.0)
    return turned(s, c, k)


def sincos_double(x: Any) -> Any:
    """sincos in float64."""
    k = floor(fma(x, 0.6366197723675814, 0.5))
    y = fma(k, -6.123233995736766e-17, fma(k, -1.5707963267948966, x))
    y = minimum(0.8, maximum(-0.8, y))
    q = y * y
    p = fma(q, 1.5889843361292355e-10, -2.505063869731035e-08)
    p = fma(q, fma(q, p, 2.7557312933527304e-06), -0.000198412698276373)
    p = fma(q, fma(q, p, 0.008333333333319726), -0.1666666666666662)
    s = fma(y * q, p, y)
    p = fma(q, fma(q, -1.1354251666373748e-11, 2.087561844037236e-09), -2.7557313576473926e-07)
    p = fma(q, fma(q, p, 2.480158728677984e-05), -0.0013888888888869768)
    c = fma(q, fma(q, fma(q, p, 0.041666666666666574), -0.5), 1.0)
    return turned(s, c, k)


def turned(s: Any, c: Any, k: Any) -> Any:
    """The sine and cosine (s, c) of an angle, after k quarter turns more."""
    half_turns = floor(k * 0.5)
    odd = fma(half_turns, -2.0, k) > 0.0
    half = half_turns * 0.5
    sign = fma(half - floor(half), -4.0, 1.0)
    return where(odd, c, s) * sign, where(odd, -s, c) * sign


sincos = by_precision(sincos_single, sincos_double)


def sin(x: Any) -> Any:
    """The sine of x radians, as `sincos` has it."""
    return sincos(x)[0]


def cos(x: Any) -> Any:
    """The cosine of x radians, as `sincos` has it."""
    return sincos(x)[1]


def atan_fraction_single(a: Any) -> Any:
    """The arc tangent of 0 <= a <= 1, with a relative error of 1e-7."""
    q = a * a
    p = fma(q, fma(q, -0.0017828123, 0.01086866), -0.031096961)
    p = fma(q, fma(q, p, 0.05788138), -0.08399306)
    p = fma(q, fma(q, p, 0.109508805), -0.14264016)
    p = fma(q, fma(q, p, 0.1999853), -0.333333)
    return fma(a * q, p, a)


def atan_fraction_double(a: Any) -> Any:
    """The arc tangent of 0 <= a <= 1, with a relative error of 2e-16."""
    q = a * a
    p = fma(q, -8.662536718804482e-06, 0.00010396161473066385)
    p = fma(q, fma(q, p, -0.0005933425186582311), 0.0021529767320129906)
    p = fma(q, fma(q, p, -0.005615353871507903), 0.011322296997526305)
    p = fma(q, fma(q, p, -0.018619724013374403), 0.026156761749880915)
    p = fma(q, fma(q, p, -0.03278911900430441), 0.038212176808291955)
    p = fma(q, fma(q, p, -0.04286486686792569), 0.04744960386467545)
    p = fma(q, fma(q, p, -0.05259443402113808), 0.05881718243328681)
    p = fma(q, fma(q, p, -0.06666584068453708), 0.07692299754226924)
    p = fma(q, fma(q, p, -0.09090908550988987), 0.11111111086670494)
    p = fma(q, fma(q, p, -0.1428571428504498), 0.19999999999990617)
    return fma(a * q, fma(q, p, -0.33333333333333287), a)


def steepness(y: Any, x: Any) -> tuple[Any, Any]:
    """(the smaller of |x| and |y| over the larger, whether |y| is the larger); 0 of two zeros, 1 of two infinities."""
    height, width = absolute(y), absolute(x)
    steep = height > width
    low, high = where(steep, width, height), where(steep, height, width)
    equal = where(high > 0.0, 1.0, high)
    return where(high >= low, where(high > low, low / high, equal), low + high), steep


def atan2_single(y: Any, x: Any) -> Any:
    """The angle of the point (x, y) in radians, from -pi to pi, as in C.

        atan(low/high) of the smaller and the larger of |x| and |y|, then reflected into place

    Relative error: 1.4e-7 in float32, 2.6e-16 in float64. atan2(0, 0) is 0; the signs of zeros count; two infinities are at
    pi/4 from the axes; NaN gives NaN.
    """
    ratio, steep = steepness(y, x)
    angle = atan_fraction_single(ratio)
    angle = where(steep, 1.5707964 - (angle + 4.371139e-08), angle)
    angle = where(copysign(1.0, x) < 0.0, 3.1415927 - (angle + 8.742278e-08), angle)
    return copysign(angle, y)


def atan2_double(y: Any, x: Any) -> Any:
    """atan2 in float64."""
    ratio, steep = steepness(y, x)
    angle = atan_fraction_double(ratio)
    angle = where(steep, 1.5707963267948966 - (angle - 6.123233995736766e-17), angle)
    angle = where(copysign(1.0, x) < 0.0, 3.141592653589793 - (angle - 1.2246467991473532e-16), angle)
    return copysign(angle, y)


atan2 = by_precision(atan2_single, atan2_double)


def acos(x: Any) -> Any:
    """The arc cosine, from 0 to pi.

        2 atan2(sqrt(1 - x), sqrt(1 + x))

    which keeps its digits near x = 1. Relative error: 2.2e-7 in float32, 3.6e-16 in float64. NaN beyond [-1, 1]. [Kahan 1987]
    """
    return atan2(sqrt(1.0 - x), sqrt(1.0 + x)) * 2.0
