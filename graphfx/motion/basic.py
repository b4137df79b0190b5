"""The small functions from which motion programs are put together; one kernel holds them all."""

from __future__ import annotations

from typing import Any

from graphfx.math import Vec3, absolute, dot, length, maximum, minimum, where
from graphfx.program import Bundle, Function

MOTION = Bundle("motion")
FAR = 2.0**60
"""Where a spring is evaluated to find its stiffness: beyond 2^24 times any place it may pull to, and its force no overflow."""


@MOTION.function("float", "float")
def copy_number(a: Any) -> Any:
    """a."""
    return a


@MOTION.function("vec3", "vec3")
def copy_vector(a: Any) -> Any:
    """a."""
    return a


def copy_of(type_: str) -> Function:
    """Return the instruction that copies a number or a vector."""
    return copy_vector if type_ == "vec3" else copy_number


@MOTION.function("float", "float")
def half(dt: Any) -> Any:
    """dt / 2."""
    return dt * 0.5


@MOTION.function("float float", "float")
def sum_of_numbers(a: Any, b: Any) -> Any:
    """a + b."""
    return a + b


@MOTION.function("vec3 vec3", "vec3")
def sum_of_vectors(a: Any, b: Any) -> Any:
    """a + b."""
    return a + b


@MOTION.function("float float", "float")
def difference(a: Any, b: Any) -> Any:
    """a - b."""
    return a - b


@MOTION.function("vec3 vec3", "vec3")
def difference_of_vectors(a: Any, b: Any) -> Any:
    """a - b."""
    return a - b


@MOTION.function("vec3 vec3 float", "vec3")
def advance(value: Any, rate: Any, dt: Any) -> Any:
    """value + rate dt."""
    return value + rate * dt


@MOTION.function("float float", "bool")
def is_less(a: Any, b: Any) -> Any:
    """a < b."""
    return a < b


@MOTION.function("float float", "bool")
def is_equal(a: Any, b: Any) -> Any:
    """a == b."""
    return a == b


@MOTION.function("bool bool", "bool")
def both(a: Any, b: Any) -> Any:
    """a and b."""
    return a & b


@MOTION.function("bool bool", "bool")
def either(a: Any, b: Any) -> Any:
    """a or b."""
    return a | b


@MOTION.function("bool bool", "bool")
def but_not(a: Any, b: Any) -> Any:
    """a and not b."""
    return a & ~b


@MOTION.function("float float", "float")
def earlier(a: Any, b: Any) -> Any:
    """The lesser of two times."""
    return minimum(a, b)


@MOTION.function("float float", "float")
def later(a: Any, b: Any) -> Any:
    """The greater of two times."""
    return maximum(a, b)


@MOTION.function("float float float", "bool")
def is_within(time: Any, start: Any, end: Any) -> Any:
    """start <= time < end."""
    return (time >= start) & (time < end)


@MOTION.function("vec3 vec3 vec3 float float float", "vec3")
def capture(tail: Any, first: Any, last: Any, begin: Any, end: Any, opening: Any) -> Any:
    """The place at the opening of the shutter, on the straight way from `first` to `last`; `tail` if that is not then."""
    share = where(end > begin, (opening - begin) / (end - begin), 0.0)
    return where((begin <= opening) & (opening <= end), first + (last - first) * share, tail)


@MOTION.function("float vec3 float float float vec3", "float vec3")
def kept_knot(then: Any, there: Any, count: Any, number: Any, time: Any, place: Any) -> Any:
    """(time, place) if count = number, else what is kept."""
    return where(count == number, time, then), where(count == number, place, there)


@MOTION.function("float vec3 float float float vec3", "float vec3")
def kept_last_knot(then: Any, there: Any, count: Any, number: Any, time: Any, place: Any) -> Any:
    """(time, place) if count >= number, else what is kept."""
    return where(count >= number, time, then), where(count >= number, place, there)


@MOTION.function("vec3 vec3 float", "vec3")
def advance_half(value: Any, rate: Any, dt: Any) -> Any:
    """value + rate dt / 2."""
    return value + rate * (dt * 0.5)


@MOTION.function("vec3 vec3", "vec3 vec3")
def joined(value: Any, remainder: Any) -> Any:
    """(s, r) with s = value + remainder as it is rounded, and r what that took: s + r is the sum. [Knuth 1969, 4.2.2 B]"""
    total = value + remainder
    added = total - value
    return total, (value - (total - added)) + (remainder - added)


def nought_below(least: Any, number: Any) -> Any:
    """The number, and 0 if it is less than `least` in size."""
    return where(absolute(number) < least, 0.0, number)


@MOTION.function("vec3 float", "vec3")
def settled(value: Any, least: Any) -> Any:
    """The value, its coordinates less than `least` in size as 0."""
    return Vec3(nought_below(least, value.x), nought_below(least, value.y), nought_below(least, value.z))


# The paper's scheme, `sims`.


@MOTION.function("vec3 float float", "vec3")
def sims_scale(velocity: Any, damping: Any, dt: Any) -> Any:
    """V' = V max(1 - d dt, 0). [Sims 1990, 3.4.1]"""
    return velocity * maximum(1.0 - damping * dt, 0.0)


@MOTION.function("vec3 vec3 vec3 float", "vec3")
def sims_limited(velocity: Any, rate: Any, end: Any, dt: Any) -> Any:
    """V' = V + rate dt along V, but not beyond `end`: V max(1 - d dt, min(1, threshold / |V|)) for damping. [Sims 1990, 3.4.1]"""
    square = dot(velocity, velocity)
    moved, last = square + dot(rate, velocity) * dt, dot(end, velocity)
    limited = where(moved < square, maximum(last, moved), minimum(last, moved))
    return velocity * where(square > 0.0, limited / square, 1.0)


@MOTION.function("vec3 vec3 float float", "vec3")
def sims_pull(velocity: Any, position: Any, stiffness: Any, dt: Any) -> Any:
    """V' = V - k P dt."""
    return velocity - position * (stiffness * dt)


@MOTION.function("vec3 vec3 vec3 float", "vec3")
def sims_move(position: Any, before: Any, velocity: Any, dt: Any) -> Any:
    """P' = P + (V + V') / 2 dt. [Sims 1990, 3]"""
    return position + (before + velocity) * (dt * 0.5)


@MOTION.function("vec3 vec3 float vec3 float float float", "vec3 vec3")
def sims_bounce(position: Any, velocity: Any, distance: Any, normal: Any, resilience: Any, friction: Any, threshold: Any) -> Any:
    """P' = P - 2 ((P - S) . N) N, V' = (1 - mu) Vt - eps Vn, for what has passed the surface. [Sims 1990, 3.4.3]

    Friction does not act below `threshold` [m/s].
    """
    along = normal * dot(velocity, normal)
    slowed = where(length(velocity) < threshold, 0.0, friction)
    return position - normal * (distance * 2.0), (velocity - along) * (1.0 - slowed) - along * resilience


@MOTION.function("vec3", "float")
def stiffness_of(first: Any) -> Any:
    """k of the matrix -k 1, from its action on 2^60 e_x."""
    return first.x * -8.673617379884035e-19


@MOTION.function("vec3", "float")
def damping_of(first: Any) -> Any:
    """d of the matrix -d 1 + [w]x, from its action on e_x."""
    return -first.x


@MOTION.function("vec3 vec3", "vec3")
def spin_of(first: Any, second: Any) -> Any:
    """w of the matrix -d 1 + [w]x, from its actions on e_x and e_y."""
    return Vec3(second.z, -first.z, first.y)
