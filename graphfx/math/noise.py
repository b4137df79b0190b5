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

from .primitives import floor, fma, maximum, minimum, where
from .vec3 import Vec3, cross, dot

__all__ = ["curl_noise"]

PERIOD = 289.0
SHARE = 0.0034602076124567475
"""1 / 289."""
HALF = 0.0017301038062283738
"""1 / 578: what keeps a quotient of whole numbers from the edge of a whole one."""
EVEN = 0.84
"""Weight of n, with which u is as fast on the lattice points as between them."""
UNIT = 0.5
"""Brings the root of the mean of u . u to 1."""


def permuted(x: Any) -> Any:
    """(34 x + 10) x modulo 289 for whole x from 0 to 288: a permutation of them, exact in float32 too."""
    product = fma(x, 34.0, 10.0) * x
    return fma(floor(fma(product, SHARE, HALF)), -PERIOD, product)


def wrapped(x: Any) -> Any:
    """x modulo 289 for 0 <= x < 578."""
    return where(x >= PERIOD, x - PERIOD, x)


def whole(x: Any) -> Any:
    """A whole x modulo 289; for an |x| above 2e6 still a number from 0 to 288."""
    return minimum(maximum(fma(floor(fma(x, SHARE, HALF)), -PERIOD, x), 0.0), 288.0)


def fade(t: Any) -> Any:
    """6 t^5 - 15 t^4 + 10 t^3."""
    return t * t * t * fma(t, fma(t, 6.0, -15.0), 10.0)


def fade_slope(t: Any) -> Any:
    """The derivative of `fade`: 30 t^2 (t - 1)^2."""
    return t * t * ((t - 1.0) * (t - 1.0) * 30.0)


def part_of(h: Any, later: Any, step: float, rest: Any, share: Any) -> Any:
    """rest f(h) + share f(later), f(h) = h step mod 1: the step h-th of 289 numbers from 0 to 1."""
    x, y = h * step, later * step
    return fma(x - floor(x), rest, (y - floor(y)) * share)


def corner(h: Any, time: Any, r: Vec3, w: Vec3, slope: Vec3) -> Vec3:
    """curl of w(r) (m x r + n): what one lattice point adds, with the fades along x, y and z and their slopes.

    m and n are the h-th of 289 points that fill the six-dimensional cube from -1 to 1 evenly, 42^0 h, 42^1 h, ... modulo 289
    [Korobov 1959]. They go smoothly from one to the next, each lattice point at its own times, with weights of which the
    squares add up to 1 within 1 %.
    """
    own = fma(h, SHARE, time)
    past = floor(own)
    t = own - past
    blend = t * t * fma(t, -2.0, 3.0)
    both = blend * (1.0 - blend)
    scale = fma(both, fma(both, 3.354, 0.8184), 1.0) * 2.0
    share, rest = blend * scale, (1.0 - blend) * scale
    index = whole(past)
    first = permuted(wrapped(h + index)) - 144.0
    second = permuted(wrapped(h + wrapped(index + 1.0))) - 144.0
    middle = (share + rest) * 0.4982698961937716
    m = Vec3(
        part_of(first, second, 0.0034602076124567475, rest, share) - middle,
        part_of(first, second, 0.1453287197231834, rest, share) - middle,
        part_of(first, second, 0.10380622837370242, rest, share) - middle,
    )
    n = Vec3(
        part_of(first, second, 0.35986159169550175, rest, share) - middle,
        part_of(first, second, 0.11418685121107267, rest, share) - middle,
        part_of(first, second, -0.2041522491349481, rest, share) - middle,
    )
    grad = Vec3(slope.x * (w.y * w.z), slope.y * (w.x * w.z), slope.z * (w.x * w.y))
    return m * fma(w.x * w.y * w.z, 2.0, dot(grad, r)) - r * dot(grad, m) + cross(grad, n) * EVEN


def curl_noise(point: Vec3, time: Any, seed: Any) -> Vec3:
    """The field at a point (in cells) and a time (in changes of mind): no divergence, a mean square of 1, smooth.

    `seed` is a whole number; 83521 of them give different fields.
    """
    base = Vec3(floor(point.x), floor(point.y), floor(point.z))
    t = point - base
    faded, slope = Vec3(fade(t.x), fade(t.y), fade(t.z)), Vec3(fade_slope(t.x), fade_slope(t.y), fade_slope(t.z))
    first = permuted(whole(floor(fma(seed, SHARE, HALF))))
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
