"""When a particle at rest is let go: the way of a step from rest, and the search for the instant."""

from __future__ import annotations

from typing import Any

from graphfx.math import Vec3, absolute, dot, maximum, where
from graphfx.program import Bundle

WAKING = Bundle("waking")


@WAKING.function("vec3 vec3 vec3 vec3 vec3 float float", "vec3")
def whole_way(long: Any, after_long: Any, short: Any, after_short: Any, first: Any, step: Any, count: Any) -> Any:
    """V h + A h^2 / 2: where a step h leads from rest at the rates V and A of the instant at which it starts.

    They are 2 r(h / 2n) - r(h / n), by the means r of two short steps: what changes along the way in proportion to the
    time is not in them. [Richardson 1911]
    """

    def in_step(of_long: Vec3, of_short: Vec3) -> Vec3:
        return of_short * (count * 4.0) - of_long * count

    return in_step(long, short) + in_step(after_long - first, after_short - first) * (step * 0.5)


@WAKING.function("float vec3 vec3 float float", "bool")
def is_pressed(distance: Any, normal: Any, way: Any, tolerance: Any, count: Any) -> Any:
    """Whether a particle at rest is on the surface still, and its motion does not lead away from it: n times as rounded."""
    return (absolute(distance) <= tolerance * 16.0) & (dot(way, normal) <= tolerance * (count * 2.0))


@WAKING.function("float vec3 vec3 float float", "bool")
def is_glued(distance: Any, normal: Any, way: Any, tolerance: Any, count: Any) -> Any:
    """Whether a particle at rest is on the surface still; where its motion leads does not count."""
    return absolute(distance) <= tolerance * 16.0


@WAKING.function("vec3 vec3", "vec3")
def ahead(position: Any, way: Any) -> Any:
    """P + 8 way: beyond the hair's breadth by which it is kept off a sheet or a mesh, if that is where it is led."""
    return position + way * 8.0


@WAKING.function("float float", "float")
def middle(a: Any, b: Any) -> Any:
    """(a + b) / 2."""
    return a + (b - a) * 0.5


@WAKING.function("float float float bool", "float float")
def narrow(held_till: Any, instant: Any, between: Any, woken: Any) -> Any:
    """Return the half of the time in which it is let go."""
    return where(woken, held_till, between), where(woken, between, instant)


@WAKING.function("float float float float", "bool")
def is_open(held_till: Any, instant: Any, finish: Any, resolution: Any) -> Any:
    """Whether the instant is not known yet to a few units in the last place of the step's end."""
    return instant - held_till > maximum(absolute(finish), absolute(held_till)) * resolution
