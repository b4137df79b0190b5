"""What happens at moments: attributes set, faded and counted; who is reborn, and who ends. One kernel holds it all."""

from __future__ import annotations

from typing import Any

from graphfx.math import Vec3, absolute, exp, floor, on_unit_sphere, power, where
from graphfx.motion.basic import nought_below
from graphfx.program import Bundle

EVENTS = Bundle("events")

GOES_ON, DIES, REBORN, HELD = 0.0, 1.0, 2.0, 3.0
"""What becomes of a particle in its own time. One that is held stops at an event that others listen to; DIES is added
where it ends there as well."""


@EVENTS.function("float", "word")
def word_of(number: Any) -> Any:
    """A count as a word, for draws: whole, from 0 to 2^31 - 128."""
    return where(number > 0.0, where(number < 2147483520.0, number, number * 0.0 + 2147483520.0), number * 0.0)


@EVENTS.function("float", "float")
def one_more(count: Any) -> Any:
    """count + 1."""
    return count + 1.0


@EVENTS.function("float float float float float", "float")
def faded_number(value: Any, target: Any, rate: Any, dt: Any, least: Any) -> Any:
    """target + (value - target) exp(-rate dt), and 0 if that is less than `least`."""
    return nought_below(least, target + (value - target) * exp(rate * dt * -1.0))


@EVENTS.function("vec3 vec3 float float float", "vec3")
def faded_vector(value: Any, target: Any, rate: Any, dt: Any, least: Any) -> Any:
    """target + (value - target) exp(-rate dt), coordinates less than `least` in size as 0."""
    faded = target + (value - target) * exp(rate * dt * -1.0)
    return Vec3(nought_below(least, faded.x), nought_below(least, faded.y), nought_below(least, faded.z))


@EVENTS.function("vec3 draw float", "vec3")
def spread(velocity: Any, draw: Any, size: Any) -> Any:
    """velocity + a vector uniform in a ball of radius `size`."""
    return velocity + on_unit_sphere(draw[0], draw[1]) * (size * power(draw[2], 0.3333333333333333))


@EVENTS.function("float float draw", "float")
def offspring(count: Any, probability: Any, draw: Any) -> Any:
    """floor(count + u) with the given probability, else 0: a fraction of one is a chance of one."""
    return where((draw[0] < probability) & (count > 0.0), floor(count + draw[1]), count * 0.0)


@EVENTS.function("float float", "bool")
def is_by(time: Any, then: Any) -> Any:
    """time <= then."""
    return time <= then


@EVENTS.function("float float float float", "bool")
def is_there(step: Any, then: Any, finish: Any, resolution: Any) -> Any:
    """Whether a step has come to `finish`, or set out so near to it that rounding may let no part of the step count."""
    left = finish - then
    return (step == left) | (left <= absolute(finish) * resolution)


@EVENTS.function("float float", "bool")
def is_at_least(value: Any, least: Any) -> Any:
    """value >= least."""
    return value >= least


@EVENTS.function("float", "bool")
def is_going_on(fate: Any) -> Any:
    """fate == 0."""
    return fate == 0.0


@EVENTS.function("vec3 vec3", "float")
def approach(velocity: Any, normal: Any) -> Any:
    """The speed at which a particle comes to a surface [m/s]: max(0, -V . N)."""
    along = velocity.x * normal.x + velocity.y * normal.y + velocity.z * normal.z
    return where(along < 0.0, -along, along * 0.0)


@EVENTS.function("float", "float")
def ended(fate: Any) -> Any:
    """The fate of a particle that dies: DIES, or HELD + DIES."""
    return where(fate >= 3.0, fate * 0.0 + 4.0, fate * 0.0 + 1.0)


@EVENTS.function("float", "float")
def held(fate: Any) -> Any:
    """The fate of a particle at an event that others listen to: HELD, or HELD + DIES."""
    return where(fate >= 3.0, fate, fate + 3.0)


@EVENTS.function("float", "float")
def renewed(fate: Any) -> Any:
    """The fate of a particle that begins another life: REBORN, or HELD + REBORN; what has ended does not."""
    return where((fate == 0.0) | (fate == 3.0), fate + 2.0, fate)


@EVENTS.function("float", "float")
def at_least_nothing(rate: Any) -> Any:
    """max(rate, 0)."""
    return where(rate > 0.0, rate, rate * 0.0)


@EVENTS.function("vec3 vec3", "bool")
def differs(before: Any, after: Any) -> Any:
    """before != after, in any coordinate."""
    return (before.x != after.x) | (before.y != after.y) | (before.z != after.z)
