"""See whether the way of a step goes through a surface though both its ends are outside: scalar functions for one particle.

The way is taken to be the cubic through both ends with the velocities there (Hermite): exact for a constant
acceleration, of fourth order for others. Its points of control are P0, P0 + T0 / 3, P1 - T1 / 3 and P1, where T = V h, and
it nowhere goes faster than reach / h. A signed distance changes no faster than the particle moves, so
distance(P0) + distance(P1) > reach means that it stays outside; where the solid, or the hollow, is known to be convex, less
does. Only who may have crossed is followed along its way:
in strides as long as its distance from the surface (Hart 1996, Sphere tracing), and where that is short, through the
least distance, found as the root of d/ds distance^2 / 2, which is linear for what is small.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import absolute, dot, maximum, minimum, sqrt, where
from graphfx.program import Bundle

CROSSING = Bundle("crossing")
LEAST_STRIDE = 0.03125
"""The shortest stride along a way, as a share of its reach."""


@CROSSING.function("vec3 vec3", "vec3 vec3")
def start(position: Any, velocity: Any) -> Any:
    """(P, V)."""
    return position, velocity


@CROSSING.function("vec3 vec3 vec3 vec3 float", "vec3 vec3")
def carried_tangents(first: Any, velocity: Any, last: Any, final: Any, dt: Any) -> Any:
    """(V0 h + D, V1 h + D), D = P1 - P0 - (V0 + V1) h / 2: where other motion carries a particle too, all the way alike."""
    carried = last - first - (velocity + final) * (dt * 0.5)
    return velocity * dt + carried, final * dt + carried


def greatest(first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """The square of `reach`."""
    middle = (last - first) * 3.0 - (begin + end) * h
    return maximum(maximum(dot(begin, begin), dot(end, end)) * (h * h), dot(middle, middle))


@CROSSING.function("vec3 vec3 vec3 vec3 float", "float")
def reach(first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """max(|T0|, |3 (P1 - P0) - T0 - T1|, |T1|): no way is longer [m]."""
    return sqrt(greatest(first, begin, last, end, h))


@CROSSING.function("float float float", "float")
def widened(reach: Any, distance: Any, later: Any) -> Any:
    """reach + 2 |distance - later|: how far a particle gets from a surface that moves too, by two distances of one place."""
    return reach + absolute(distance - later) * 2.0


def lowest(distance: Any, normal: Any, place: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """The least height of the points of control above the plane that is so far below a place, square to a normal."""
    start, stop = dot(first - place, normal), dot(last - place, normal)
    third = h * 0.3333333333333333
    inner = minimum(start + dot(begin, normal) * third, stop - dot(end, normal) * third)
    return distance + minimum(minimum(start, stop), inner)


def off_thirds(first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """The squares of how far the points of control are off the thirds of the chord."""
    chord, third = (last - first) * 0.3333333333333333, h * 0.3333333333333333
    early, late = begin * third - chord, end * third - chord
    return dot(early, early), dot(late, late)


# Whether a way that ends outside may come near: `near_...` by its end alone, for all; `meets_...` by both ends, for the others.


@CROSSING.function("float vec3 vec3 vec3 vec3 vec3 float", "bool")
def near(distance: Any, normal: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """Any surface: its end is no farther from it than the way is long."""
    return (distance >= 0.0) & (distance * distance <= greatest(first, begin, last, end, h))


@CROSSING.function("float float", "bool")
def near_by(distance: Any, reach: Any) -> Any:
    """A surface that moves: 0 <= distance <= reach."""
    return (distance >= 0.0) & (distance <= reach)


@CROSSING.function("float float float", "bool")
def meets(before: Any, after: Any, reach: Any) -> Any:
    """Any surface: distance(P0) + distance(P1) <= reach."""
    return before + after <= reach


@CROSSING.function("float vec3 vec3 vec3 vec3 vec3 float", "bool")
def near_plane(distance: Any, normal: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """A plane: a point of control is below it."""
    third = h * 0.3333333333333333
    early = distance + dot(first - last + begin * third, normal)
    return (distance >= 0.0) & (minimum(early, distance - dot(end, normal) * third) < 0.0)


@CROSSING.function("float vec3 vec3 vec3 vec3 vec3 float", "bool")
def near_convex(distance: Any, normal: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """A convex solid, distance(P) >= distance(P1) + (P - P1) . N(P1): a point of control is below that plane."""
    return (distance >= 0.0) & (lowest(distance, normal, last, first, begin, last, end, h) <= 0.0)


@CROSSING.function("float vec3 vec3 vec3 vec3 vec3 float", "bool")
def meets_convex(before: Any, normal: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """A convex solid, distance(P) >= distance(P0) + (P - P0) . N(P0): a point of control is below that plane."""
    return lowest(before, normal, first, first, begin, last, end, h) <= 0.0


@CROSSING.function("float vec3 vec3 vec3 vec3 vec3 float", "bool")
def near_hollow(distance: Any, normal: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """A convex hollow: its chord may be as near to the wall as the points of control are off it, if the way begins there."""
    early, late = off_thirds(first, begin, last, end, h)
    return (distance >= 0.0) & (distance * distance <= maximum(early * 9.0, late * 2.25))


@CROSSING.function("float float vec3 vec3 vec3 vec3 float", "bool")
def meets_hollow(before: Any, after: Any, first: Any, begin: Any, last: Any, end: Any, h: Any) -> Any:
    """A convex hollow: its chord is as near to the wall as the points of control are off it."""
    early, late = off_thirds(first, begin, last, end, h)
    a, b = (before * 2.0 + after) * 0.3333333333333333, (before + after * 2.0) * 0.3333333333333333
    return (a * a <= early) | (b * b <= late)


@CROSSING.function("vec3 vec3 vec3 vec3 float float", "vec3 vec3")
def on_way(first: Any, begin: Any, last: Any, end: Any, h: Any, share: Any) -> Any:
    """The place at a share s of the way, and dP/ds there."""
    left = 1.0 - share
    chord = last - first
    place = first + chord * (share * share * (3.0 - share * 2.0)) + (begin * left - end * share) * (share * left * h)
    turned = begin * (left * (1.0 - share * 3.0)) + end * (share * (share * 3.0 - 2.0))
    return place, chord * (share * left * 6.0) + turned * h


@CROSSING.function("vec3 vec3", "float")
def change(normal: Any, across: Any) -> Any:
    """How fast the distance changes along the way: N . dP/ds."""
    return dot(normal, across)


@CROSSING.function("float float float", "float float")
def stride(share: Any, distance: Any, reach: Any) -> Any:
    """The next place to look at, min(1, s + max(distance / reach, 1/32)); and 1 where the stride is not surely free, else 0."""
    free = maximum(distance, 0.0) >= reach * LEAST_STRIDE
    ahead = share + where(free, distance / reach, LEAST_STRIDE)
    return minimum(ahead, 1.0), where(free, share * 0.0, share * 0.0 + 1.0)


@CROSSING.function("float float", "bool")
def is_deep(distance: Any, tolerance: Any) -> Any:
    """distance < -tolerance: inside, whatever rounding says."""
    return distance < -tolerance


@CROSSING.function("float float float", "bool")
def is_dip(before: Any, after: Any, doubtful: Any) -> Any:
    """Whether the least distance of a stride that is not surely free lies between its ends."""
    return (before < 0.0) & (after > 0.0) & (doubtful > 0.0)


@CROSSING.function("float float float", "float")
def falling(distance: Any, change: Any, reach: Any) -> Any:
    """-distance d(distance)/ds: above 0 before the least distance, below it after; a distance counts as reach / 2^20 at least."""
    return -(maximum(distance, reach * 9.5367431640625e-07) * change)


@CROSSING.function("float float float float float", "bool")
def is_undecided(a: Any, b: Any, distance: Any, change: Any, tolerance: Any) -> Any:
    """Whether the distance may be less than at a place within [a, b] by its change, and the bracket wider than 2^-30."""
    return (distance - absolute(change) * (b - a) < -tolerance) & (b - a > 9.313225746154785e-10)


@CROSSING.function("float", "bool")
def is_on_the_way(share: Any) -> Any:
    """s < 1."""
    return share < 1.0


@CROSSING.function("float float", "float")
def share_of(share: Any, dt: Any) -> Any:
    """s h."""
    return share * dt


@CROSSING.function("float float float float", "float")
def change_with(change: Any, distance: Any, later: Any, share: Any) -> Any:
    """change + (later - distance) / share: how fast the distance changes where the surface moves too."""
    return change + (later - distance) / share
