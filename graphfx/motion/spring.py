"""The exact flow of linear motion with a spring: V' = g - d V + w x V - k P,    P' = V.

Along w, and everywhere if there is no turning, each coordinate is a real damped oscillator; across it, in the plane
turned by a x (a = w / |w|), the two are one complex oscillator, with d - i |w| for d:

    z'' = f - d z' - k z from rest at the start's place,    f = g - k P,    z'(0) = V

With x >= y in size the roots of r^2 + d h r + k h^2, all is made of e[x, y] = (e^x - e^y) / (x - y), as

    S = h e[x, y],   K = e^x + y S / h,   R = e^y - y S / h,   Q = h^2 (e[x, y] - phi1(y)) / x
    P' = P + V S + f Q = g/k + (P - g/k) R + V S,    V' = V K + f S

Of the two forms of P' the first is taken for k h^2 < 1 and the second beyond, so that none loses digits: not at
k = 0, not at d = 0, not where the roots are equal, and not where they are far apart. [Divided differences of the
exponential: McCurdy, Ng and Parlett 1984]
"""

from __future__ import annotations

import math
from typing import Any

from graphfx.math import (
    absolute,
    copysign,
    cos,
    cross,
    dot,
    exp,
    length,
    maximum,
    minimum,
    phi1,
    sinc,
    sincos,
    sqrt,
    where,
)
from graphfx.motion.linear import SERIES_TERMS, complex_phi, complex_series, growth
from graphfx.program import function

SCALES = tuple(1.0 / math.factorial(n + 2) for n in range(SERIES_TERMS + 2))
"""What the n-th of the symmetric polynomials counts for: 1 / (n + 2)!."""


@function("vec3 float vec3 vec3", "vec3")
def constant_carried(constant: Any, damping: Any, rate: Any, applied: Any) -> Any:
    """g + d u - w x u: the constant of the motion of W = V + u."""
    return constant + applied * damping - cross(rate, applied)


@function("float float float", "float float float float")
def spring_factors(damping: Any, stiffness: Any, dt: Any) -> Any:
    """(S, K, Q, R) of a real oscillator: what `damped_spring` takes. Roots are real, or a pair -d/2 +- i omega."""
    x_plus_y, xy = growth(-(damping * dt)), stiffness * dt * dt
    middle = x_plus_y * 0.5
    square = middle * middle - xy
    apart = square >= 0.0
    root = sqrt(absolute(square))
    x = where(apart, middle + copysign(root, middle), middle)
    y = where(x == 0.0, 0.0, xy / x)
    grown, swung = exp(where(apart, y, middle)), where(apart, phi1(x - y), sinc(root))
    slope = grown * swung
    circling = grown * cos(root)
    speed_kept = where(apart, exp(x) + y * slope, circling + middle * slope)
    place_kept = where(apart, grown - y * slope, circling - middle * slope)
    near = where(apart, absolute(x) < 1.0, xy < 1.0)
    pushed = where(near, _pushed_near(x_plus_y, xy), (slope - phi1(y)) / x)
    return slope * dt, speed_kept, pushed * dt * dt, place_kept


def _pushed_near(x_plus_y: Any, xy: Any) -> Any:
    """e[0, x, y] for |x|, |y| < 1: the sum of h_n / (n + 2)! for h_n the complete symmetric polynomials, which are real."""
    before, term, total = x_plus_y * 0.0, x_plus_y * 0.0 + 1.0, x_plus_y * 0.0 + 0.5
    for n in range(1, SERIES_TERMS + 2):
        before, term = term, x_plus_y * term - xy * before
        total = total + term * SCALES[n]
    return total


@function("vec3 vec3 vec3 float float float float float float", "vec3 vec3")
def damped_spring(
    position: Any, velocity: Any, constant: Any, stiffness: Any, dt: Any, slope: Any, kept: Any, pushed: Any, held: Any
) -> Any:
    """P + V S + f Q (or g/k + (P - g/k) R + V S), V K + f S for f = g - k P."""
    force = constant - position * stiffness
    near = stiffness * dt * dt < 1.0
    rest = constant * (1.0 / stiffness)
    start, arm = where(near, position, rest), where(near, force, position - rest)
    return start + arm * where(near, pushed, held) + velocity * slope, velocity * kept + force * slope


def _complex_exp(x: Any, y: Any) -> Any:
    """The real and the imaginary part of e^(x + i y)."""
    s, c = sincos(y)
    grown = exp(x)
    return grown * c, grown * s


def _complex_root(u: Any, v: Any) -> Any:
    """The square root of u + i v with a real part >= 0, with no square that overflows."""
    greater = maximum(absolute(u), absolute(v))
    share = minimum(absolute(u), absolute(v)) / where(greater > 0.0, greater, 1.0)
    size = greater * sqrt(1.0 + share * share)
    one = sqrt((size + absolute(u)) * 0.5)
    other = absolute(v) * 0.5 / where(one > 0.0, one, 1.0)
    return where(u >= 0.0, one, other), copysign(where(u >= 0.0, other, one), v)


def _complex_phi1(x: Any, y: Any, real: Any, imaginary: Any) -> Any:
    """phi1(z) for z = x + i y, where e^z is `real` + i `imaginary`."""
    near = x * x + y * y < 1.0
    far_r, far_i = complex_phi(x, y, real, imaginary, 1.0)
    near_r, near_i = complex_series(x, y, 1, SERIES_TERMS)
    return where(near, near_r, far_r), where(near, near_i, far_i)


def _complex_pushed_near(p_r: Any, p_i: Any, xy: Any) -> Any:
    """e[0, x, y] for |x|, |y| < 1, x + y = p_r + i p_i and x y real: as `_pushed_near`."""
    zero = p_r * 0.0
    before_r, before_i, term_r, term_i = zero, zero, zero + 1.0, zero
    total_r, total_i = zero + 0.5, zero
    for n in range(1, SERIES_TERMS + 2):
        next_r, next_i = p_r * term_r - p_i * term_i - xy * before_r, p_r * term_i + p_i * term_r - xy * before_i
        before_r, before_i, term_r, term_i = term_r, term_i, next_r, next_i
        total_r, total_i = total_r + term_r * SCALES[n], total_i + term_i * SCALES[n]
    return total_r, total_i


def _roots(damping: Any, speed: Any, stiffness: Any, dt: Any) -> Any:
    """The roots x and y, |x| >= |y|, of r^2 + (d - i s) h r + k h^2, and x + y and x y: (x_r, x_i, y_r, y_i, p_r, p_i, x y)."""
    p_r, p_i, xy = growth(-(damping * dt)), speed * dt, stiffness * dt * dt
    m_r, m_i = p_r * 0.5, p_i * 0.5
    root_r, root_i = _complex_root((m_r - m_i) * (m_r + m_i) - xy, m_r * m_i * 2.0)
    sign = where(m_r * root_r + m_i * root_i < 0.0, -1.0, m_r * 0.0 + 1.0)
    x_r, x_i = m_r + root_r * sign, m_i + root_i * sign
    size = x_r * x_r + x_i * x_i
    back = where(size > 0.0, xy / size, 0.0)
    return x_r, x_i, x_r * back, -(x_i * back), p_r, p_i, xy


@function("float vec3 float float", "float float float float float float float float")
def turned_factors(damping: Any, rate: Any, stiffness: Any, dt: Any) -> Any:
    """(S, K, Q, R) of the complex oscillator across the axis, each as real and imaginary part."""
    x_r, x_i, y_r, y_i, p_r, p_i, xy = _roots(damping, length(rate), stiffness, dt)
    grown_r, grown_i = _complex_exp(y_r, y_i)
    apart_r, apart_i = x_r - y_r, x_i - y_i
    ratio_r, ratio_i = _complex_exp(apart_r, apart_i)
    swung_r, swung_i = _complex_phi1(apart_r, apart_i, ratio_r, ratio_i)
    slope_r, slope_i = grown_r * swung_r - grown_i * swung_i, grown_r * swung_i + grown_i * swung_r
    back_r, back_i = y_r * slope_r - y_i * slope_i, y_r * slope_i + y_i * slope_r
    fast_r, fast_i = _complex_exp(x_r, x_i)
    first_r, first_i = _complex_phi1(y_r, y_i, grown_r, grown_i)
    far_r, far_i = complex_phi(x_r, x_i, slope_r - first_r, slope_i - first_i, 0.0)
    near_r, near_i = _complex_pushed_near(p_r, p_i, xy)
    near = x_r * x_r + x_i * x_i < 1.0
    pushed_r, pushed_i = where(near, near_r, far_r) * dt * dt, where(near, near_i, far_i) * dt * dt
    return (
        slope_r * dt, slope_i * dt, fast_r + back_r, fast_i + back_i, pushed_r, pushed_i, grown_r - back_r, grown_i - back_i,
    )  # fmt: skip


@function("vec3 vec3 vec3 vec3 float float float float float float float float float float float float float float", "vec3 vec3")
def spiral_spring(
    position: Any, velocity: Any, constant: Any, rate: Any, stiffness: Any, dt: Any,
    slope: Any, kept: Any, pushed: Any, held: Any,
    slope_r: Any, slope_i: Any, kept_r: Any, kept_i: Any, pushed_r: Any, pushed_i: Any, held_r: Any, held_i: Any,
) -> Any:  # fmt: skip
    """`damped_spring` along w, and across it with complex factors, i as a x."""
    speed = length(rate)
    axis = rate * where(speed > 0.0, 1.0 / speed, 0.0)
    force = constant - position * stiffness
    near = stiffness * dt * dt < 1.0
    rest = constant * (1.0 / stiffness)
    start, arm = where(near, position, rest), where(near, force, position - rest)
    arm_along, swing_along, force_along = axis * dot(axis, arm), axis * dot(axis, velocity), axis * dot(axis, force)
    along = arm_along * where(near, pushed, held) + swing_along * slope
    place = _turned(axis, arm - arm_along, where(near, pushed_r, held_r), where(near, pushed_i, held_i))
    swing = _turned(axis, velocity - swing_along, slope_r, slope_i)
    speeded = swing_along * kept + force_along * slope
    turned = _turned(axis, velocity - swing_along, kept_r, kept_i) + _turned(axis, force - force_along, slope_r, slope_i)
    return start + along + place + swing, speeded + turned


def _turned(axis: Any, across: Any, real: Any, imaginary: Any) -> Any:
    """A vector across the axis times a complex number."""
    return across * real + cross(axis, across) * imaginary
