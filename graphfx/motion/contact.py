"""Find the instant of contact, and what happens there: scalar functions for one particle.

Within a step the signed distance f runs from f(0) to f(h) < 0. The search keeps a bracket [a, b] with
g(a) > 0 >= g(b) and halves a stale end's value (Illinois), so it converges faster than linearly. For a
particle that starts on the surface g(t) = f(t) / t, whose limit at 0 is its speed away from the
surface: the contact at 0 that is over is divided out.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import absolute, dot, length, maximum, minimum, where
from graphfx.motion.basic import MOTION


@MOTION.function("float", "bool")
def is_inside(distance: Any) -> Any:
    """Signed distance < 0."""
    return distance < 0.0


@MOTION.function("vec3 float", "float")
def contact_tolerance(position: Any, resolution: Any) -> Any:
    """The distance that rounding hides at a place: `resolution` (8 eps) of its greatest coordinate, and 1 m at least [m]."""
    size = maximum(maximum(absolute(position.x), absolute(position.y)), maximum(absolute(position.z), 1.0))
    return size * resolution


@MOTION.function("float float vec3 vec3 float float", "float float float float float bool")
def start_search(before: Any, after: Any, normal: Any, velocity: Any, step: Any, tolerance: Any) -> Any:
    """Return (a, g(a), b, g(b), touching, at_once) for f(0) = before, f(h) = after < 0.

    `touching` is 1 for a particle that starts on the surface. `at_once`: it is under the surface already, or on it
    and not leaving, or so slowly that rounding hides how far in a step; contact is at 0.
    """
    leaving = dot(velocity, normal)
    touching = before <= tolerance
    at_once = touching & ((leaving * step <= tolerance) | (before < -tolerance))
    first = where(touching, leaving, before)
    last = where(touching, after / step, after)
    return step * 0.0, first, step, last, where(touching, step * 0.0 + 1.0, step * 0.0), at_once


@MOTION.function("float float float float", "float")
def propose(a: Any, at_a: Any, b: Any, at_b: Any) -> Any:
    """Return where the chord of the bracket crosses 0, or the middle if that is not inside."""
    crossing = b - at_b * ((b - a) / (at_b - at_a))
    return where((crossing > a) & (crossing < b), crossing, a + (b - a) * 0.5)


@MOTION.function("float float float float float float float float", "float float float float float")
def narrow(a: Any, at_a: Any, b: Any, at_b: Any, side: Any, t: Any, distance: Any, touching: Any) -> Any:
    """Return the bracket (a, g(a), b, g(b), side) after f(t) = distance; `side` is the end that moved last."""
    value = where(touching > 0.0, distance / t, distance)
    below = value <= 0.0
    stale_a = below & (side < 0.0)
    stale_b = (side > 0.0) & ~below
    new_a, value_a = where(below, a, t), where(below, where(stale_a, at_a * 0.5, at_a), value)
    new_b, value_b = where(below, t, b), where(below, value, where(stale_b, at_b * 0.5, at_b))
    return new_a, value_a, new_b, value_b, where(below, t * 0.0 - 1.0, t * 0.0 + 1.0)


@MOTION.function("float float float float float float", "bool")
def is_open(a: Any, b: Any, distance: Any, step: Any, tolerance: Any, resolution: Any) -> Any:
    """Whether to search on: the bracket is wider than rounding and the distance greater than it."""
    return (b - a > step * resolution) & (absolute(distance) > tolerance)


@MOTION.function("vec3 vec3 float vec3 float float float float", "vec3 vec3 bool bool")
def respond(
    position: Any, velocity: Any, distance: Any, normal: Any, resilience: Any, friction: Any, threshold: Any, rest_speed: Any
) -> Any:
    """V' = (1 - mu) Vt - eps Vn at the contact, and the position put on the surface. [Sims 1990, 3.4.3]

    Friction does not act on a particle slower than `threshold` [m/s]. One that would leave more slowly than
    `rest_speed` [m/s] does not leave: with friction it stops there (third result), without it slides (fourth). Where there
    is a threshold it slides too: its infinitely many bounces end with Vt min(1 - mu, threshold / |Vt|), and no friction acts on
    who slides.
    One whose own velocity leaves the surface while an applied one drives it in keeps its velocity, and slides.
    """
    approach = dot(velocity, normal)
    driven = approach > 0.0
    along = normal * minimum(approach, 0.0)
    across = velocity - along
    slowed = where(length(velocity) < threshold, 0.0, friction)
    settled = (-approach * resilience <= rest_speed) & ~driven
    stopped = settled & (slowed > 0.0) & (threshold <= 0.0)
    pace = length(across)
    arrives = (slowed > 0.0) & (-approach > rest_speed)
    limited = minimum(1.0 - slowed, threshold / where(pace > threshold, pace, threshold))
    bounced = where(settled, across * where(arrives, limited, 1.0), across * (1.0 - slowed) - along * resilience)
    still = velocity - velocity
    answered = where(driven, velocity, where(stopped, still, bounced))
    return position - normal * distance, answered, stopped, driven | (settled & ~stopped)


@MOTION.function("float float", "bool")
def is_instant(time: Any, step: Any) -> Any:
    """Whether a contact came so soon (1/1024 of a whole step) that there is no getting on but along the surface."""
    return time <= step * 0.0009765625


@MOTION.function("vec3 vec3 vec3 float vec3 vec3", "vec3 vec3")
def slide(first: Any, position: Any, velocity: Any, distance: Any, start: Any, normal: Any) -> Any:
    """Put a particle that has sunk below a surface back on it, and turn its velocity from V0 to V with the surface.

    Vt' = R (M - (M . N0) N0) + D - (D . N) N,    M = (V0 + V) / 2,    D = (V - V0) / 2

    R turns the normal `start` N0 into `normal` N, and keeps lengths: half of what the velocity gained counts where the step
    began, half where it ends, so that the way along a curved surface is of second order. What leads out of it stays.
    """
    mean, half = (first + velocity) * 0.5, (velocity - first) * 0.5
    level = mean - start * dot(mean, start)
    turned = level - (start + normal) * (dot(level, normal) / maximum(dot(start, normal) + 1.0, 0.001))
    along = turned + half - normal * dot(half, normal)
    sunk = distance < 0.0
    outward = normal * maximum(dot(velocity, normal), 0.0)
    return position - normal * minimum(distance, 0.0), where(sunk, along + outward, velocity)


@MOTION.function("vec3 vec3 float vec3", "vec3 vec3")
def slide_on_face(position: Any, velocity: Any, distance: Any, normal: Any) -> Any:
    """Put a particle that has sunk below a flat face back on it, and take from its velocity what points into it."""
    return (
        position - normal * minimum(distance, 0.0),
        velocity - normal * where(distance < 0.0, minimum(dot(velocity, normal), 0.0), 0.0),
    )
