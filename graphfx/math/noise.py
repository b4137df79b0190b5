"""A smooth random field without sources: curl noise, which stirs and never gathers or thins out.

Every point of the lattice of whole numbers has random vectors m and n, from a hash that is the same in both precisions. In
a cell the field is the curl of the vector potential

    A(p) = sum over the 8 corners c of  w(p - c) (m_c x (p - c) + n_c),    u = curl A

with w the product of the fades 1 - (6 t^5 - 15 t^4 + 10 t^3) along x, y and z. The divergence of a curl is zero, and
of this one it is zero but for rounding, since the formula is derived and not taken by differences:

    u = sum of  m (2 w + grad w . r) - r (grad w . m) + grad w x n,    r = p - c

The vectors wander with time. Space repeats after 289 cells, time after 289 units. [Perlin 2002 for the fade; Bridson,
Hourihan and Nordenstam 2007 for the curl; McEwan, Sheets, Gustavson and Richardson 2012 for a hash without integers]
"""

from __future__ import annotations

from typing import Any

from .primitives import floor, maximum, minimum, sqrt, where
from .vec3 import Vec3, cross, dot

__all__ = ["curl_noise"]

PERIOD = 289.0
SHARE = 0.0034602076124567475
"""1 / 289."""
EVEN = 0.84
"""Weight of n, with which u is as fast on the lattice points as between them."""
UNIT = 0.5
"""Brings the root of the mean of u . u to 1."""


def permuted(x: Any) -> Any:
    """(34 x + 10) x modulo 289 for whole x from 0 to 288: a permutation of them, exact in float32 too."""
    product = (x * 34.0 + 10.0) * x
    return product - floor((product + 0.5) * SHARE) * PERIOD


def wrapped(x: Any) -> Any:
    """x modulo 289 for 0 <= x < 578."""
    return where(x >= PERIOD, x - PERIOD, x)


def whole(x: Any) -> Any:
    """A whole x modulo 289; for an |x| above 2e6 still a number from 0 to 288."""
    return minimum(maximum(x - floor((x + 0.5) * SHARE) * PERIOD, 0.0), 288.0)


def fade(t: Any) -> Any:
    """6 t^5 - 15 t^4 + 10 t^3."""
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0)


def fade_slope(t: Any) -> Any:
    """The derivative of `fade`: 30 t^2 (t - 1)^2."""
    return t * t * ((t - 1.0) * (t - 1.0) * 30.0)


def part_of(h: Any, step: float) -> Any:
    """The step h-th of 289 numbers from -1 to 1, modulo 289: exact until its last multiplication."""
    x = h * step
    return (x - floor((x + 0.5) * SHARE) * PERIOD) * 0.006920415224913495 - 0.9965397923875432


def vectors_of(h: Any) -> tuple[Vec3, Vec3]:
    """The h-th of 289 points that fill the six-dimensional cube from -1 to 1 evenly: 42^0 h, 42^1 h, ... [Korobov 1959]"""
    return Vec3(part_of(h, 1.0), part_of(h, 42.0), part_of(h, 30.0)), Vec3(part_of(h, 104.0), part_of(h, 33.0), part_of(h, 230.0))


def corner(h: Any, time: Any, r: Vec3, w: Vec3, slope: Vec3) -> Vec3:
    """curl of w(r) (m x r + n): what one lattice point adds, with the fades along x, y and z and their slopes.

    m and n go smoothly from one random pair to the next, each lattice point at its own times.
    """
    own = time + h * SHARE
    past = floor(own)
    share = (own - past) * (own - past) * (3.0 - 2.0 * (own - past))
    scale = 1.0 / sqrt(share * share + (1.0 - share) * (1.0 - share))
    index = whole(past)
    m, n = vectors_of(permuted(wrapped(h + index)))
    later_m, later_n = vectors_of(permuted(wrapped(h + wrapped(index + 1.0))))
    m = m * ((1.0 - share) * scale) + later_m * (share * scale)
    n = n * ((1.0 - share) * scale) + later_n * (share * scale)
    grad = Vec3(slope.x * w.y * w.z, w.x * slope.y * w.z, w.x * w.y * slope.z)
    return m * (w.x * w.y * w.z * 2.0 + dot(grad, r)) - r * dot(grad, m) + cross(grad, n) * EVEN


def curl_noise(point: Vec3, time: Any, seed: Any) -> Vec3:
    """The field at a point (in cells) and a time (in changes of mind): no divergence, a mean square of 1, smooth.

    `seed` is a whole number; 83521 of them give different fields.
    """
    base = Vec3(floor(point.x), floor(point.y), floor(point.z))
    t = point - base
    faded, slope = Vec3(fade(t.x), fade(t.y), fade(t.z)), Vec3(fade_slope(t.x), fade_slope(t.y), fade_slope(t.z))
    first = permuted(whole(floor((seed + 0.5) * SHARE)))
    second = permuted(whole(seed))
    i, j, k = whole(base.x), whole(base.y), whole(base.z)
    near = plane(permuted(wrapped(k + first)), i, j, second, time, t, 0.0, faded, slope)
    far = plane(permuted(wrapped(wrapped(k + 1.0) + first)), i, j, second, time, t, 1.0, faded, slope)
    return (near + far) * UNIT


def plane(h: Any, i: Any, j: Any, seed: Any, time: Any, t: Vec3, z: float, faded: Vec3, slope: Vec3) -> Vec3:
    """What the four lattice points at one height add."""
    low = row(permuted(wrapped(h + j)), i, seed, time, t, 0.0, z, faded, slope)
    high = row(permuted(wrapped(h + wrapped(j + 1.0))), i, seed, time, t, 1.0, z, faded, slope)
    return low + high


def row(h: Any, i: Any, seed: Any, time: Any, t: Vec3, y: float, z: float, faded: Vec3, slope: Vec3) -> Vec3:
    """What the two lattice points of one row add."""
    wy, sy = blend(faded.y, slope.y, y)
    wz, sz = blend(faded.z, slope.z, z)
    left = permuted(wrapped(permuted(wrapped(h + i)) + seed))
    right = permuted(wrapped(permuted(wrapped(h + wrapped(i + 1.0))) + seed))
    first = corner(left, time, Vec3(t.x, t.y - y, t.z - z), Vec3(1.0 - faded.x, wy, wz), Vec3(-slope.x, sy, sz))
    return first + corner(right, time, Vec3(t.x - 1.0, t.y - y, t.z - z), Vec3(faded.x, wy, wz), Vec3(slope.x, sy, sz))


def blend(faded: Any, slope: Any, side: float) -> tuple[Any, Any]:
    """The weight of the near (0) or the far (1) side, and its slope."""
    return (1.0 - side) + faded * (2.0 * side - 1.0), slope * (2.0 * side - 1.0)
