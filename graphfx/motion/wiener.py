"""Random vectors of noise: held ones, and the increments of a Wiener process, found anywhere in a cell of 1/24 s.

    W(t + h) - W(t) ~ N(0, h) in each component, independent of all that was before

A cell has GRID places. W at its end is one draw; W at another place is found by halving the cell towards it, a draw for
each middle m of a piece [a, b] with W known at its ends:

    W(m) ~ N(W(a) + (W(b) - W(a)) s, (b - m) s),    s = (m - a) / (b - a)

So W at a place depends on nothing but the cell and the place: whoever asks, in whatever order and with whatever steps,
finds the same path. Times are taken at the nearest place, 25 ns at most from them. [Levy 1948; Gaines and Lyons 1997,
Variable step size control in the numerical solution of stochastic differential equations]
"""

from __future__ import annotations

from typing import Any

from graphfx.math import Vec3, floor, log, maximum, minimum, on_unit_sphere, power, sincos, sqrt, where
from graphfx.motion.clock import CELL_RATE, GRID
from graphfx.program import Bundle

WIENER = Bundle("wiener")

PIECE = GRID / 16
"""A cell is halved four times, so that 2, 4, 8 and 16 equal steps in it are found at once ..."""
PART = PIECE / 25
"""... then parted into 25, so that steps at 25, 30, 50 and 60 frames a second are found soon, and those are halved again."""
MOST_HALVINGS = 24
"""More than lead to any place: 4, then 5 for 25 parts, then 12."""
LIVES = 2.0**21
"""More than GRID. A place with the number of the life is exact as a float32: no two of 8 lives that follow share draws."""
PLACES = float(CELL_RATE * GRID)
VARIANCE = 1.0 / PLACES
"""Places in a second, and the variance of W over one [s]."""
TURN = 6.283185307179586


def normals(draw: Any) -> Any:
    """Three independent normal numbers from four uniform ones.

        sqrt(-2 ln(1 - u)) cos 2 pi v, sqrt(-2 ln(1 - u)) sin 2 pi v;    and the first of another pair

    [Box and Muller 1958]
    """
    first, second = sqrt(log(1.0 - draw[0]) * -2.0), sqrt(log(1.0 - draw[2]) * -2.0)
    sine, cosine = sincos(draw[1] * TURN)
    _, other = sincos(draw[3] * TURN)
    return Vec3(first * cosine, first * sine, second * other)


@WIENER.function("draw", "vec3")
def in_ball(draw: Any) -> Any:
    """A vector uniform in the unit ball."""
    return on_unit_sphere(draw[0], draw[1]) * power(draw[2], 0.3333333333333333)


@WIENER.function("float", "word")
def whole_word(lives: Any) -> Any:
    """The word that counts the draw of a whole cell: 2^21 (lives mod 8)."""
    return (lives - floor(lives * 0.125) * 8.0) * LIVES


@WIENER.function("draw", "vec3")
def whole(draw: Any) -> Any:
    """W at the end of a cell, 0 at its begin [sqrt(s)]."""
    return normals(draw) * sqrt(draw[0] * 0.0 + GRID * VARIANCE)


@WIENER.function("float float float", "float word")
def middle(low: Any, high: Any, lives: Any) -> Any:
    """The place that parts [low, high], and the word that counts its draw: the place + 2^21 (lives mod 8)."""
    width = high - low
    parted = floor(width * (0.5 / PART)) * PART
    place = low + where((width > PART) & (width <= PIECE), parted, width * 0.5)
    return place, (lives - floor(lives * 0.125) * 8.0) * LIVES + place


@WIENER.function("float float vec3 vec3 float draw float", "float float vec3 vec3")
def halve(low: Any, high: Any, below: Any, above: Any, parted: Any, draw: Any, place: Any) -> Any:
    """Find W where [low, high] is parted, with W = below and above at its ends; return the part that `place` is in."""
    share = (parted - low) / (high - low)
    there = below + (above - below) * share + normals(draw) * sqrt((high - parted) * share * VARIANCE)
    left = place < parted
    return where(left, low, parted), where(left, parted, high), where(left, below, there), where(left, there, above)


@WIENER.function("float float", "bool")
def is_inside(place: Any, end: Any) -> Any:
    """0 < place < end."""
    return (place > 0.0) & (place < end)


@WIENER.function("float vec3 vec3 float", "vec3")
def found(place: Any, inside: Any, at_end: Any, end: Any) -> Any:
    """W at a place: what was found inside the cell, or at its end."""
    return where(place < end, inside, at_end)


@WIENER.function("float float float float float", "float")
def place_of_birth(born: Any, begin: Any, start: Any, first: Any, last: Any) -> Any:
    """Where in a cell that starts at `start` noise begins to move a particle: at `first`, or where it is born after `begin`."""
    place = floor((born - start) * PLACES + 0.5)
    return where(born > begin, maximum(first, minimum(last, place)), first)


@WIENER.function("vec3 vec3 float float", "vec3")
def white(after: Any, before: Any, begin: Any, end: Any) -> Any:
    """(W(end) - W(begin)) / (end - begin): white noise, held from begin to end [1 / sqrt(s)]."""
    time = end - begin
    return (after - before) * where(time > 0.0, 1.0 / time, 0.0)
