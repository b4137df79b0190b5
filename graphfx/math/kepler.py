"""The orbit about a point that attracts, or repels, by the inverse square of the distance: exact for any time.

    P'' = -mu P / |P|^3,    beta = 2 mu / r - V^2,    eta = P . V,    zeta = mu - beta r,    r = |P|,    dt = r ds
    t = r0 s + eta0 G2(s) + zeta0 G3(s),    r = r0 + eta0 G1 + zeta0 G2
    P' = P0 + (r0 G1 + eta0 G2) V0 - (mu G2 / r0) P0,    V' = V0 - (mu G2 / r) V0 - (mu G1 / (r0 r)) P0

with Gn of universal.py; and with s and t from the nearest point of the orbit, q away from the point in the direction a,

    t = q s + c G3(s),    r = q + c G2(s),    c^2 = mu^2 - beta h^2,    h = P x V,    b = h x a
    P' = (q - mu G2) a + G1 b,    V' = (G0 b - mu G1 a) / r

From there t is convex for s > 0, so Newton's method, begun beyond the root, comes down to it without fail. Then s from the
start is found to its last digit by one step on the first equation, and the first form is taken, since it keeps what is small
in a short step; but the second where the particle is, or was on the way, much nearer than at the start. Whole periods are
left out, in two numbers. [universal variables: Danby 1988, 6.9; Wisdom and Hernandez 2015; Rein and Tamayo 2015]
"""

from __future__ import annotations

from typing import Any

from .compensated import moment, square_in_two, sum_in_two
from .logarithmic import log, power
from .primitives import absolute, by_precision, copysign, floor, fma, maximum, minimum, scale2, split2, sqrt, where
from .trigonometric import atan2
from .universal import period_in_two, universal
from .vec3 import Vec3, cross, dot, unit

__all__ = ["kepler"]

SINGLE = (2.0**-126, 126.0, 2.0**-30, 2.0**80, 2.0**-23, 2.0**-13)
DOUBLE = (2.0**-1022, 1022.0, 2.0**-80, 2.0**400, 2.0**-52, 2.0**-36)
"""The least size, the greatest exponent, the least strength that counts, the longest time in scaled units, the rounding unit,
and how near to the point a particle may end, as a share of its distance before."""
SINGLE_ROUNDS, DOUBLE_ROUNDS = 3, 4
"""Steps of Newton's method; one of Halley's follows."""


def energy_of(q: Any, v: Any, mu: Any) -> tuple[Any, Any, Any, Any]:
    """(r, beta r, beta in two numbers), with beta right to its last digits where 2 mu / r and V^2 nearly cancel."""
    r2, r2_low = square_in_two(q)
    v2, v2_low = square_in_two(v)
    r = sqrt(r2)
    r_low = (fma(-r, r, r2) + r2_low) / (2.0 * r)
    product = r * v2
    high, low = sum_in_two(2.0 * mu, -product)
    low = low - (fma(r, v2, -product) + (r * v2_low + r_low * v2))
    beta_r = high + low
    low = (high - beta_r) + low
    beta = beta_r / r
    return r, beta_r, beta, (fma(-beta, r, beta_r) + (low - beta * r_low)) / r


def since_nearest(eta: Any, zeta: Any, c: Any, closed: Any, root: Any, per_root: Any, tiny: float) -> Any:
    """s at which c G1(s) = eta and c G0(s) = zeta: the place on the orbit, from its nearest point on."""
    y = root * absolute(eta) / maximum(c, tiny)
    z = y + y * y / (1.0 + sqrt(1.0 + y * y))
    grown = 1.0 + z
    inverse_sine = copysign(where(grown > 1.0, log(grown) * (z / (grown - 1.0)), z), eta)
    angle = where(closed, atan2(root * eta, zeta), inverse_sine)
    return where(root > 0.0, angle * per_root, eta / maximum(c, tiny))


def not_below(time: Any, q: Any, c: Any, beta: Any, root: Any, per_root: Any, tiny: float) -> Any:
    """A bound for s, as near as can be had from what q s + c G3(s) = time is at least.

    For beta <= 0, G3(s) >= s^3/6; for beta > 0, G3(s) >= s^3/pi^2 and root s <= pi. In H = root s a hyperbola has
    sinh H = x + k H with k <= 1, so H <= max(2, log(1 + 4.48 x)), and again H <= asinh(x + k that).
    """
    cubic = maximum(c * where(beta > 0.0, 0.10132118, 0.16666666), tiny)
    s = minimum(time / q, power(time / cubic, 0.33333334))
    for _ in range(2):
        s = (2.0 * cubic * s * s * s + time) / maximum(q + 3.0 * cubic * s * s, tiny)
    x = time / maximum(c, tiny) * (root * root * root)
    k = maximum(1.0 - q * (root * root) / maximum(c, tiny), 0.0)
    x = x + k * maximum(log(1.0 + 4.48 * x), 2.0)
    bounded = minimum(x, 1e6)
    far = log(x + maximum(x, sqrt(1.0 + bounded * bounded)))
    return minimum(s, per_root * where(beta > 0.0, 3.1415927, far))


def reached(time: Any, q: Any, c: Any, beta: Any, root: Any, per_root: Any, tiny: float, rounds: int) -> Any:
    """s >= 0 with q s + c G3(s) = time >= 0: Newton's method from above, then one step of Halley's."""
    s = not_below(time, q, c, beta, root, per_root, tiny)
    for _ in range(rounds):
        _, _, g2, g3 = universal(s, beta, root, per_root)
        s = s - ((q * s - time) + c * g3) / maximum(q + c * g2, tiny)
    _, g1, g2, g3 = universal(s, beta, root, per_root)
    r = maximum(q + c * g2, tiny)
    step = ((q * s - time) + c * g3) / r
    return s - step / (1.0 - 0.5 * step * (c * g1 / r))


def without_periods(dt: Any, period: Any, period_low: Any, closed: Any, rounding: float) -> Any:
    """dt less whole periods; 0 where the digits of dt no longer tell the place on the orbit."""
    turns = where(closed, floor(dt / period + 0.5), 0.0)
    gone = turns * period
    left = (dt - gone) - (fma(turns, period, -gone) + turns * period_low)
    return where(turns > 0.0, where(turns * rounding < 1.0, left, 0.0), dt)


def orbit(q: Any, v: Any, mu: Any, dt: Any, limits: Any, rounds: int) -> Any:
    """(whether it is closed, whether the second form is taken, way or place, velocity) after dt, in scaled units.

    With the second form the place is given, else the way from the start.
    """
    tiny, rounding, nearest_share = limits[0], limits[4], limits[5]
    r0, beta_r0, beta, beta_low = energy_of(q, v, mu)
    closed = beta > 0.0
    root = sqrt(absolute(beta))
    per_root = 1.0 / root
    h = moment(q, v)
    h2 = dot(h, h)
    eta, zeta = dot(q, v), mu - beta_r0
    c = sqrt(where(closed, zeta * zeta + beta * eta * eta, mu * mu - beta * h2))
    nearest = where(mu > 0.0, h2 / (mu + c), (mu - c) / beta)
    s0 = since_nearest(eta, zeta, c, closed, root, per_root, tiny)
    _, _, _, g3 = universal(s0, beta, root, per_root)
    period, period_low = period_in_two(mu, beta, beta_low, root)
    dt = without_periods(dt, period, period_low, closed, rounding)
    time = (nearest * s0 + c * g3) + dt
    turns = where(closed, floor(time / period + 0.5), 0.0)
    time = where(turns == 0.0, time, time - turns * period)
    s = reached(absolute(time), nearest, c, beta, root, per_root, tiny, rounds)
    gap = maximum((r0 * nearest_share - nearest) / maximum(c, tiny), 0.0)
    s = copysign(maximum(s, sqrt(2.0 * minimum(gap, per_root * per_root))), time)
    g0, g1, g2, _ = universal(s, beta, root, per_root)
    r = maximum(nearest + c * g2, tiny)
    least = where((s0 * s < 0.0) & (turns == 0.0), nearest, minimum(r, r0))
    dives = least * 2.0 < r0
    axis = unit(cross(v, h) - q * (mu / r0))
    across = unit(cross(h, axis)) * sqrt(h2)
    place = axis * (nearest - mu * g2) + across * g1
    speed = (across * g0 - axis * (mu * g1)) * (1.0 / r)
    s = s - s0 + where(turns == 0.0, 0.0, turns * (6.283185307179586 * per_root))
    way, fast = from_start(q, v, mu, dt, s, (r0, eta, zeta, beta, root, per_root))
    return closed, dives, where(dives, place, way), where(dives, speed, fast)


def from_start(q: Any, v: Any, mu: Any, dt: Any, s: Any, start: Any) -> Any:
    """(way, velocity) by the first form, for an s that is nearly right."""
    r0, eta, zeta, beta, root, per_root = start
    _, g1, g2, g3 = universal(s, beta, root, per_root)
    r = maximum(r0 + (eta * g1 + zeta * g2), r0 * 0.125)
    s = s + (dt - (r0 * s + (eta * g2 + zeta * g3))) / r
    g0, g1, g2, _ = universal(s, beta, root, per_root)
    r = maximum(r0 + (eta * g1 + zeta * g2), r0 * 0.125)
    pulled = mu * g2
    kept = where(absolute(pulled) < 0.5 * r, 1.0 - pulled / r, (r0 * g0 + eta * g1) / r)
    return v * (r0 * g1 + eta * g2) - q * (pulled / r0), v * kept - q * (mu * g1 / (r0 * r))


def size_of(v: Any) -> Any:
    """The greatest of |x|, |y| and |z|."""
    return maximum(maximum(absolute(v.x), absolute(v.y)), absolute(v.z))


def scaled(v: Any, k: Any) -> Any:
    """v 2^k."""
    return Vec3(scale2(v.x, k), scale2(v.y, k), scale2(v.z, k))


def in_units(position: Any, velocity: Any, center: Any, strength: Any, dt: Any, limits: Any, rounds: int) -> Any:
    """(P', V') with lengths in the power of two near r, and speeds in that near sqrt(|mu| / r) or |V|, whichever is greater.

    A strength that is nothing beside r V^2 leaves the particle free, as does a place at the point itself. Beyond the longest
    time an open orbit goes straight on.
    """
    tiny, most, least, longest = limits[0], limits[1], limits[2], limits[3]
    offset = position - center
    size, forward = size_of(offset), copysign(1.0, dt)
    _, lengths = split2(maximum(size, tiny))
    _, own_speeds = split2(maximum(size_of(velocity), tiny))
    _, pulls = split2(maximum(absolute(strength), tiny))
    lengths = minimum(lengths, most)
    speeds = minimum(maximum(own_speeds, floor((pulls - lengths) * 0.5) + 1.0), most)
    mu = scale2(scale2(scale2(strength, -speeds), -lengths), -speeds)
    time = scale2(scale2(absolute(dt), speeds), -lengths)
    q, v = scaled(offset, -lengths), scaled(velocity * forward, -speeds)
    closed, dives, way, fast = orbit(q, v, mu, minimum(time, longest), limits, rounds)
    after = scaled(fast * forward, speeds)
    straight = where((time > longest) & ~closed, dt * (1.0 - longest / time), 0.0)
    moved = where(dives, center, position) + scaled(way, lengths) + after * straight
    free = (absolute(mu) < least) | (size < tiny)
    return where(free, position + velocity * dt, moved), where(free, velocity, after)


def kepler_single(position: Any, velocity: Any, center: Any, strength: Any, dt: Any) -> tuple[Any, Any]:
    """(P', V') after dt seconds on the orbit about `center` at which the pull is strength / r^2; negative repels.

    A particle that falls straight into the center comes back the way it came; one at the center itself flies on freely.

    The error is that of a start that is wrong by 4 units in the last place, in either precision, or less; the energy keeps to
    50 rounding units, relative to the greatest of its parts. Where the digits of dt do not tell the place on the orbit (turns
    beyond 8e6, float64: 4.5e15) it stays where it is. Finite for all distances from 1e-30 to 1e18 m, strengths to 1e12 and
    speeds and times to 1e6, and in float64 far beyond.
    """
    return in_units(position, velocity, center, strength, dt, SINGLE, SINGLE_ROUNDS)


def kepler_double(position: Any, velocity: Any, center: Any, strength: Any, dt: Any) -> tuple[Any, Any]:
    """kepler in float64."""
    return in_units(position, velocity, center, strength, dt, DOUBLE, DOUBLE_ROUNDS)


kepler = by_precision(kepler_single, kepler_double)
