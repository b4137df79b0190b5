"""End infinitely many bounces in finite time: scalar functions for one particle that has just left a flat surface.

With the constant acceleration a, g = -a . N > 0, and the speed u away from the surface, the k-th flight from here lasts

    tau_k = tau r^k,    tau = 2 u / g,    r the resilience,    all of them tau / (1 - r)

and with friction mu, q = 1 - mu, the speed along the surface at its start and the way of the first n flights are

    V_k = q^k V + a q K_k tau,                       K_k = (q^k - r^k) / (q - r)
    X_n = V tau S(q r) + a tau^2 (q r D + S(r^2) / 2),    S(x) = (1 - x^n) / (1 - x)
    D = (1 - P_n + q r^3 P_(n-1)) / ((1 - q r) (1 - r^2)),    P_n = r^(n-1) K_n

where V and a are the parts along the surface. With n without end x^n and P_n are 0, and q^n is 1 without friction.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import absolute, dot, exp, expm1, floor, length, log, maximum, minimum, sqrt, where
from graphfx.program import Bundle

SETTLING = Bundle("settling")
FEW = 4.0
"""A series is looked for where at least so many flights fit in what is left of the step."""
BRIEF = 0.00048828125
"""A flight that lasts so small a share of a step (1/2048) is not flown if there is no series."""


@SETTLING.function("vec3 vec3 float", "vec3")
def mean(velocity: Any, final: Any, dt: Any) -> Any:
    """(V1 - V0) / dt: the mean acceleration [m/s^2]."""
    return (final - velocity) * (1.0 / dt)


@SETTLING.function("vec3 vec3 vec3 float float float", "float")
def least_speed(velocity: Any, normal: Any, mean: Any, rest_speed: Any, resolution: Any, tolerance: Any) -> Any:
    """The speed below which no particle leaves a surface: `rest_speed`, or what rounding may make of its velocity, or of the
    height u^2 / (2 g) of its flight (16 tolerances of contacts). Where it is driven away from the surface there is none.
    """
    g = -dot(mean, normal)
    hidden = maximum(length(velocity) * resolution * 128.0, sqrt(maximum(g, 0.0) * tolerance * 32.0))
    driven = (g < length(mean) * resolution * -128.0) & (rest_speed < 1e30)
    return where(driven, -1.0, maximum(rest_speed, hidden))


@SETTLING.function("float float vec3 vec3 vec3 float float float float", "bool bool")
def hops(
    distance: Any, tolerance: Any, normal: Any, velocity: Any, mean: Any, step: Any, longest: Any, event: Any, least: Any
) -> Any:
    """Whether a particle leaves a surface only to be back soon, slower than an event; and whether its flight is brief.

    It lasts no longer than a fourth of what is left of the step; brief is 1/2048 of the `longest` step. `event` is the speed
    of an event, `least` the one below which a particle does not leave at all.
    """
    u, g = dot(velocity, normal), -dot(mean, normal)
    hop = (absolute(distance) <= tolerance * 4.0) & (u > least) & (u * (2.0 * FEW) <= g * step)
    brief = hop & (u * 2.0 <= g * longest * BRIEF)
    return (hop & (u < event)) | brief, brief


@SETTLING.function("vec3 vec3 vec3 float float", "float float")
def duration(velocity: Any, normal: Any, mean: Any, resilience: Any, step: Any) -> Any:
    """How long all flights last, at most the step; and 1/16 of that."""
    u, g = dot(velocity, normal), -dot(mean, normal)
    most = minimum(u * 2.0 / (g * (1.0 - resilience)), step)
    return most, most * 0.0625


def kernel(q: Any, r: Any, n: Any) -> Any:
    """K_n = (q^n - r^n) / (q - r) for n >= 0, q and r in [0, 1]: n q^(n-1) where they are the same."""
    greater, lesser = maximum(q, r), minimum(q, r)
    ratio = where(lesser > 0.0, log(where(lesser > 0.0, lesser / greater, 1.0)), -1e30)
    same = ratio >= 0.0
    share = expm1(ratio * n) / where(same, 1.0, expm1(ratio))
    return where(n > 0.0, exp(log(greater) * (n - 1.0)) * where(same, n, share), 0.0)


def all_flights(q: Any, r: Any) -> Any:
    """(sum of (q r)^k, of the factor of a, of r^k) without end."""
    first, second = 1.0 / (1.0 - q * r), 1.0 / (1.0 - r * r)
    return first, second * (q * r * first + 0.5), 1.0 / (1.0 - r)


def some_flights(q: Any, r: Any, n: Any) -> Any:
    """(S(q r), the factor of a, S(r)) of n flights, r > 0."""
    log_r, qr = log(r), q * r
    product = where(q > 0.0, expm1((log(where(q > 0.0, q, 1.0)) + log_r) * n), -1.0)
    first, second = -product / (1.0 - qr), -expm1(log_r * (n * 2.0)) / (1.0 - r * r)
    last, previous = exp(log_r * (n - 1.0)) * kernel(q, r, n), exp(log_r * (n - 2.0)) * kernel(q, r, n - 1.0)
    divided = (1.0 - last + qr * r * r * previous) / ((1.0 - qr) * (1.0 - r * r))
    return first, qr * divided + second * 0.5, -expm1(log_r * n) / (1.0 - r)


def count(u: Any, tau: Any, r: Any, step: Any, rest_speed: Any) -> Any:
    """How many flights end within the step, or leave the particle faster than `rest_speed`: 0 or more."""
    left = 1.0 - step * (1.0 - r) / tau
    n = where(left > 0.0, floor(log(where(left > 0.0, left, 1.0)) / log(r)), 1e9)
    slow = where(rest_speed > 0.0, floor(log(where(rest_speed > 0.0, minimum(rest_speed / u, 1.0), 1.0)) / log(r)), n)
    return maximum(minimum(n, slow), 0.0)


@SETTLING.function("vec3 vec3 vec3 float float float float float", "float vec3 vec3 bool")
def series(
    velocity: Any, normal: Any, mean: Any, resilience: Any, friction: Any, threshold: Any, rest_speed: Any, step: Any
) -> Any:
    """Return (time, way, V', whether there is one) of all flights if they end within the step, else of those that do.

    Friction that does not act below a speed fits no series, unless the particle stays slower.
    """
    u, g = dot(velocity, normal), -dot(mean, normal)
    along, pull = velocity - normal * u, mean + normal * g
    r, tau = resilience, u * 2.0 / g
    total = tau / (1.0 - r)
    slow = length(along) + u + length(pull) * total < threshold
    q = where(slow, 1.0, 1.0 - friction)
    ends = (total <= step) & (rest_speed <= 0.0)
    safe = where(r > 0.0, r, 0.5)
    n = count(u, tau, safe, step, rest_speed)
    n = where(some_flights(q, safe, n)[2] * tau > step, n - 1.0, n)
    first, second, third = all_flights(q, r)
    some_first, some_second, some_third = some_flights(q, safe, n)
    way = along * (where(ends, first, some_first) * tau) + pull * (where(ends, second, some_second) * (tau * tau))
    log_q = log(where(q > 0.0, q, 1.0))
    kept = where(ends, where(q < 1.0, 0.0, 1.0), where(q > 0.0, exp(log_q * n), 0.0))
    gained = where(ends, where(q < 1.0, 0.0, total), q * kernel(q, safe, n) * tau)
    up = where(ends, 0.0, u * exp(log(safe) * n))
    fits = (g > 0.0) & ((friction <= 0.0) | (threshold <= 0.0) | slow) & (ends | ((n >= 1.0) & (r > 0.0))) & (r < 1.0)
    return where(ends, third, some_third) * tau, way, along * kept + pull * gained + normal * up, fits


@SETTLING.function("vec3 vec3 vec3 vec3 float float", "bool")
def is_constant(mean: Any, early: Any, velocity: Any, normal: Any, time: Any, tolerance: Any) -> Any:
    """Whether two accelerations make no difference to where a particle is after a time, or to when it rests."""
    change = mean - early
    g = -dot(mean, normal)
    late = absolute(dot(change, normal)) * length(velocity)
    return (length(change) * time * time <= tolerance) & (late * time <= tolerance * g)


@SETTLING.function("vec3 vec3 float vec3 float float", "bool")
def is_level(normal: Any, there: Any, distance: Any, velocity: Any, time: Any, tolerance: Any) -> Any:
    """Whether the surface is as flat as it was thought to be, from where the flights began to where they end."""
    return (absolute(distance) <= tolerance) & (length(there - normal) * length(velocity) * time <= tolerance)


@SETTLING.function("vec3 vec3 float", "float")
def extent(velocity: Any, mean: Any, time: Any) -> Any:
    """(|V| + |a| t) t: no particle gets farther."""
    return (length(velocity) + length(mean) * time) * time


@SETTLING.function("vec3 vec3 float float", "vec3")
def slowed_down(velocity: Any, normal: Any, friction: Any, threshold: Any) -> Any:
    """Vt min(1 - mu, threshold / |Vt|) where friction acts, else Vt: after infinitely many bounces within no time.

    Where there is no `threshold` [m/s] the contact that comes next stops it.
    """
    along = velocity - normal * dot(velocity, normal)
    pace = length(along)
    acts = (threshold > 0.0) & (friction > 0.0) & (pace >= threshold)
    return along * where(acts, minimum(1.0 - friction, threshold / where(pace > 0.0, pace, 1.0)), 1.0)


@SETTLING.function("vec3 vec3 float", "vec3")
def put_back(position: Any, normal: Any, distance: Any) -> Any:
    """P - distance N: on the surface."""
    return position - normal * distance
