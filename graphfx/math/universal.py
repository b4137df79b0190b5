"""The functions of s in which ellipses, parabolas and hyperbolas are one: G0, G1, G2, G3.

    Gn(s) = s^n cn(beta s^2),    cn(x) = 1/n! - x/(n+2)! + x^2/(n+4)! - ...

For beta > 0, with w = sqrt(beta): G0 = cos(w s), G1 = sin(w s)/w, G2 = (1 - cos(w s))/w^2, G3 = (w s - sin(w s))/w^3; for
beta < 0 the same with cosh and sinh; for beta = 0: 1, s, s^2/2, s^3/6. Each is the derivative of the next.
[Stumpff 1959; Danby 1988, 6.9]
"""

from __future__ import annotations

from typing import Any

from .exponential import exp
from .primitives import absolute, by_precision, copysign, fma, where
from .trigonometric import sincos

__all__ = ["period_in_two", "universal"]


def stumpff_single(x: Any) -> tuple[Any, Any]:
    """(c2, c3) for |x| <= 1, by their series.

    Relative error: 1.3e-7 in float32, 2.5e-16 in float64.
    """
    p = fma(x, fma(x, 2.7557319e-07, -2.4801587e-05), 0.0013888889)
    two = fma(x, fma(x, p, -0.041666668), 0.5)
    p = fma(x, fma(x, 2.5052108e-08, -2.7557319e-06), 0.0001984127)
    return two, fma(x, fma(x, p, -0.008333334), 0.16666667)


def stumpff_double(x: Any) -> tuple[Any, Any]:
    """(c2, c3) in float64."""
    p = fma(x, fma(x, 1.5619206968586225e-16, -4.779477332387385e-14), 1.1470745597729725e-11)
    p = fma(x, fma(x, p, -2.08767569878681e-09), 2.755731922398589e-07)
    p = fma(x, fma(x, p, -2.48015873015873e-05), 0.001388888888888889)
    two = fma(x, fma(x, p, -0.041666666666666664), 0.5)
    p = fma(x, fma(x, 8.22063524662433e-18, -2.8114572543455206e-15), 7.647163731819816e-13)
    p = fma(x, fma(x, p, -1.6059043836821613e-10), 2.505210838544172e-08)
    p = fma(x, fma(x, p, -2.7557319223985893e-06), 0.0001984126984126984)
    return two, fma(x, fma(x, p, -0.008333333333333333), 0.16666666666666666)


stumpff = by_precision(stumpff_single, stumpff_double)


def universal(s: Any, beta: Any, root: Any, per_root: Any) -> tuple[Any, Any, Any, Any]:
    """(G0, G1, G2, G3) of s, where root = sqrt(|beta|) and per_root = 1 / root, infinite for beta = 0.

    By series for |beta| s^2 < 1, else by sine and cosine or by e^(root s). G1, G2 and G3 keep their relative precision for
    all s of a parabola or hyperbola, and for |root s| <= pi of an ellipse. Infinite beyond root s = 88 (float64: 709).
    """
    x = beta * s * s
    near, closed = absolute(x) < 1.0, beta > 0.0
    two, three = stumpff(x)
    angle = root * s
    sine, cosine = sincos(angle * 0.5)
    grown = exp(absolute(angle))
    shrunk = 1.0 / grown
    one = where(closed, 2.0 * sine * cosine, copysign((grown - shrunk) * 0.5, s)) * per_root
    per_square = per_root * per_root
    raised = where(closed, 2.0 * sine * sine, (grown + shrunk) * 0.5 - 1.0)
    g3 = where(near, s * s * s * three, (s - one) * where(closed, per_square, -per_square))
    g2 = where(near, s * s * two, raised * per_square)
    g1 = where(near, s - beta * g3, one)
    return 1.0 - beta * g2, g1, g2, g3


def turn_times_single(x: Any) -> tuple[Any, Any]:
    """2 pi x in two numbers."""
    high = x * 6.2831855
    return high, fma(x, 6.2831855, -high) - x * 1.7484556e-07


def turn_times_double(x: Any) -> tuple[Any, Any]:
    """2 pi x in two numbers of float64."""
    high = x * 6.283185307179586
    return high, fma(x, 6.283185307179586, -high) + x * 2.4492935982947064e-16


turn_times = by_precision(turn_times_single, turn_times_double)


def period_in_two(mu: Any, beta: Any, beta_low: Any, root: Any) -> tuple[Any, Any]:
    """The period 2 pi mu / beta^(3/2) in two numbers, for beta in two numbers and root = sqrt(beta).

    x = mu / beta^(3/2), rounded, is mended by one step of Newton on x^2 beta^3 = mu^2, in which nothing is rounded that counts.
    """
    x = mu / (beta * root)
    square = beta * beta
    square_low = fma(beta, beta, -square) + 2.0 * beta * beta_low
    cube = square * beta
    cube_low = fma(square, beta, -cube) + (square * beta_low + square_low * beta)
    other = x * x
    other_low = fma(x, x, -other)
    product = cube * other
    product_low = fma(cube, other, -product) + (cube * other_low + cube_low * other)
    wanted = mu * mu
    lacking = (wanted - product) + (fma(mu, mu, -wanted) - product_low)
    high, low = turn_times(x)
    return high, low + 6.2831855 * (lacking / (2.0 * cube * x))
