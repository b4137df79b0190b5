"""Exact flows of linear motion: constant acceleration g, damping d, and a turning rate w of the velocity.

    V' = g - d V + w x V,    P' = V

The solution over any dt is a sum of V, w x V and w (w . V), and the same of g, with scalar factors that
have no cancellation: the functions named phi and sinc are accurate at 0 and far from it.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import by_precision, cosinc, cross, dot, exp, length, minimum, phi1, phi2, sin3, sinc, sincos, where
from graphfx.program import function


@function("vec3 vec3 vec3 float", "vec3 vec3")
def fall(position: Any, velocity: Any, gravity: Any, dt: Any) -> Any:
    """P + V dt + g dt^2 / 2, V + g dt."""
    return position + (velocity + gravity * (dt * 0.5)) * dt, velocity + gravity * dt


def _growth_single(x: Any) -> Any:
    """min(x, 68)."""
    return minimum(x, 68.0)


def _growth_double(x: Any) -> Any:
    """min(x, 680)."""
    return minimum(x, 680.0)


growth = by_precision(_growth_single, _growth_double)
"""An exponent, and in one step no more than e^68 (float64: e^680): what stands still then does so however long a step is."""


@function("vec3 vec3 vec3 float float", "vec3 vec3")
def damped_fall(position: Any, velocity: Any, gravity: Any, damping: Any, dt: Any) -> Any:
    """With x = -d dt: P + V dt phi1(x) + g dt^2 phi2(x), V e^x + g dt phi1(x)."""
    x = growth(-(damping * dt))
    first = phi1(x) * dt
    return position + velocity * first + gravity * (phi2(x) * dt * dt), velocity * exp(x) + gravity * first


@function("vec3 float", "float float float float")
def spin_factors(rate: Any, dt: Any) -> Any:
    """(cos t, sin t / t, (1 - cos t) / t^2, (t - sin t) / t^3) for t = |w| dt: what `spin` takes."""
    angle = length(rate) * dt
    _, c = sincos(angle)
    return c, sinc(angle), cosinc(angle), sin3(angle)


@function("vec3 vec3 vec3 float float float float float", "vec3 vec3")
def spin(position: Any, velocity: Any, rate: Any, dt: Any, c: Any, wave: Any, bow: Any, curl: Any) -> Any:
    """Turn the velocity about w by |w| dt while it carries the particle along: a helix. [Sims 1990, 3.4.2]

    With t = |w| dt, W = w x V dt and L = w (w . V) dt^2:
    V' = V cos t + W sin t / t + L (1 - cos t) / t^2, and P' the integral of it.
    """
    turned = cross(rate, velocity) * dt
    kept = rate * (dot(rate, velocity) * dt * dt)
    moved = position + (velocity * wave + turned * bow + kept * curl) * dt
    return moved, velocity * c + turned * wave + kept * bow


@function("vec3 float", "float float float")
def turn_factors(rate: Any, dt: Any) -> Any:
    """(cos t, sin t / t, (1 - cos t) / t^2) for t = |w| dt: what `turn` takes."""
    angle = length(rate) * dt
    _, c = sincos(angle)
    return c, sinc(angle), cosinc(angle)


@function("vec3 vec3 float float float float", "vec3")
def turn(velocity: Any, rate: Any, dt: Any, c: Any, wave: Any, bow: Any) -> Any:
    """Turn a vector about w by |w| dt: V cos t + W dt sin t / t + L dt^2 (1 - cos t) / t^2."""
    return velocity * c + cross(rate, velocity) * (wave * dt) + rate * (dot(rate, velocity) * dt * dt * bow)


SERIES_TERMS = 18
"""Enough for 1 / 18! < 2^-52 at |z| = 1."""
RECIPROCALS = (0.0, *(1.0 / n for n in range(1, SERIES_TERMS + 3)))


def complex_phi(x: Any, y: Any, real: Any, imaginary: Any, next_real: float) -> Any:
    """Return (f - next_real) / z for f = real + i imaginary and z = x + i y."""
    size = x * x + y * y
    a, b = real - next_real, imaginary
    return (a * x + b * y) / size, (b * x - a * y) / size


def complex_series(x: Any, y: Any, first: int, terms: int) -> Any:
    """Return the sum of z^k / (k + 1) ... (k + first), times 1 / first!... by Horner's rule, for |z| < 1."""
    real, imaginary = x * 0.0 + 1.0, y * 0.0
    for back in range(terms):
        scale = RECIPROCALS[first + terms - back]
        real, imaginary = 1.0 + (real * x - imaginary * y) * scale, (real * y + imaginary * x) * scale
    return real, imaginary


@function("vec3 vec3 vec3 float vec3 float", "vec3 vec3")
def spiral_fall(position: Any, velocity: Any, gravity: Any, damping: Any, rate: Any, dt: Any) -> Any:
    """Gravity, damping and turning together.

    Along w the motion is a damped fall with x = -d dt. Across it, in the plane turned by a x (a = w / |w|), it is the
    same with z = -d dt + i |w| dt in place of x: e^z, phi1(z) and phi2(z) act as complex numbers, i as a x.
    """
    speed = length(rate)
    axis = rate * where(speed > 0.0, 1.0 / speed, 0.0)
    x, y = growth(-(damping * dt)), speed * dt
    s, c = sincos(y)
    grown = exp(x)
    near = x * x + y * y < 1.0
    one_r, one_i = complex_phi(x, y, grown * c, grown * s, 1.0)
    two_r, two_i = complex_phi(x, y, one_r, one_i, 1.0)
    near_one_r, near_one_i = complex_series(x, y, 1, SERIES_TERMS)
    near_two_r, near_two_i = complex_series(x, y, 2, SERIES_TERMS)
    one_r, one_i = where(near, near_one_r, one_r), where(near, near_one_i, one_i)
    two_r, two_i = where(near, near_two_r * 0.5, two_r), where(near, near_two_i * 0.5, two_i)
    along, fall_along = axis * dot(axis, velocity), axis * dot(axis, gravity)
    across, fall_across = velocity - along, gravity - fall_along
    turned, fall_turned = cross(axis, velocity), cross(axis, gravity)
    first = phi1(x)
    moved = (along * first + across * one_r + turned * one_i) * dt
    fallen = (fall_along * phi2(x) + fall_across * two_r + fall_turned * two_i) * (dt * dt)
    speeded = along * grown + across * (grown * c) + turned * (grown * s)
    pulled = (fall_along * first + fall_across * one_r + fall_turned * one_i) * dt
    return position + moved + fallen, speeded + pulled
