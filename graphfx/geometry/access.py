"""What a function of particles can ask of a mesh: the same text in plain Python and on lanes.

Numbers of vertices and faces are lane values that hold whole numbers.
"""

from __future__ import annotations

from typing import Any

from graphfx.geometry.tables import CHANCES, FACES, VERTICES
from graphfx.math import Vec3, absolute, by_precision, dot, floor, fma, maximum, minimum, sqrt, where
from graphfx.math.tables import gather, rows, turn

HORIZONTAL = 1e-6
"""A face whose normal is off the vertical by less than this [rad] counts as horizontal."""


def vertex(mesh: Any, number: Any) -> Any:
    """The position of a vertex [m]."""
    return Vec3(gather(mesh, VERTICES, number, 0), gather(mesh, VERTICES, number, 1), gather(mesh, VERTICES, number, 2))


def vertex_normal(mesh: Any, number: Any) -> Any:
    """The unit normal at a vertex."""
    return Vec3(gather(mesh, VERTICES, number, 3), gather(mesh, VERTICES, number, 4), gather(mesh, VERTICES, number, 5))


def vertex_count(mesh: Any) -> Any:
    """How many vertices there are."""
    return rows(mesh, VERTICES)


def along_vertices(mesh: Any, progress: Any) -> tuple[Any, Any]:
    """A smooth way through all vertices in turn: the point at a share of it, and the way on from there.

        Catmull-Rom: (2 P1 + (P2 - P0) s + (2 P0 - 5 P1 + 4 P2 - P3) s^2 + (3 P1 - P0 - 3 P2 + P3) s^3) / 2

    Vertices stand at equal shares, 0 the first and 1 the last, beyond which it stays. [Catmull and Rom 1974]
    """
    last = vertex_count(mesh) - 1.0
    place = minimum(maximum(progress, 0.0), 1.0) * last
    before = minimum(floor(place), maximum(last - 1.0, 0.0))
    s = place - before
    p0, p1 = vertex(mesh, maximum(before - 1.0, 0.0)), vertex(mesh, before)
    p2, p3 = vertex(mesh, minimum(before + 1.0, last)), vertex(mesh, minimum(before + 2.0, last))
    a, b, c = p2 - p0, p0 * 2.0 - p1 * 5.0 + p2 * 4.0 - p3, p1 * 3.0 - p0 - p2 * 3.0 + p3
    return p1 + (a + (b + c * s) * s) * (s * 0.5), (a + (b * 2.0 + c * (s * 3.0)) * s) * (last * 0.5)


def vertex_in_turn(mesh: Any, identity: Any) -> Any:
    """id mod number of vertices: the vertex that falls to a particle when all take them in turn."""
    return turn(identity, mesh, VERTICES)


def face_normal(mesh: Any, number: Any) -> Any:
    """The unit normal of a face."""
    return Vec3(gather(mesh, FACES, number, 9), gather(mesh, FACES, number, 10), gather(mesh, FACES, number, 11))


def face_point(mesh: Any, number: Any, u: Any, v: Any) -> Any:
    """A point of a face, uniform for uniform u and v.

        A + (B - A) u + (C - A) v, and u, v -> 1 - u, 1 - v where u + v > 1

    The half of the unit square beyond its diagonal is turned onto the half within.
    """
    a = Vec3(gather(mesh, FACES, number, 0), gather(mesh, FACES, number, 1), gather(mesh, FACES, number, 2))
    b = Vec3(gather(mesh, FACES, number, 3), gather(mesh, FACES, number, 4), gather(mesh, FACES, number, 5))
    c = Vec3(gather(mesh, FACES, number, 6), gather(mesh, FACES, number, 7), gather(mesh, FACES, number, 8))
    beyond = u + v > 1.0
    return a + (b - a) * where(beyond, 1.0 - u, u) + (c - a) * where(beyond, 1.0 - v, v)


def split_even(count: Any, u: Any, v: Any) -> Any:
    """(n, f): a whole number 0 <= n < count, each as likely, and f uniform in [0, 1), from uniform u and v.

        n + f = count (u + v 2^-24)

    Of u only 24 bits count, so that both precisions agree; v gives those below. The product is held in two parts.
    """
    top = floor(u * 16777216.0) * 5.9604644775390625e-8
    product = count * top
    whole = floor(product)
    rest = (product - whole) + fma(count, top, -product) + count * (v * 5.9604644775390625e-8)
    carry = floor(rest)
    return minimum(whole + carry, count - 1.0), rest - carry


def choose_vertex(mesh: Any, u: Any, v: Any) -> Any:
    """The number of a vertex, each as likely, for uniform u and v."""
    return split_even(rows(mesh, VERTICES), u, v)[0]


def choose_face(mesh: Any, u: Any, v: Any) -> Any:
    """The number of a face, as likely as its area, for uniform u and v."""
    place, rest = split_even(rows(mesh, CHANCES), u, v)
    return where(rest < gather(mesh, CHANCES, place, 0), place, gather(mesh, CHANCES, place, 1))


def upmost_tangent(normal: Any) -> Any:
    """The unit tangent of a surface that points most nearly up (+y); +x on a horizontal one. [Sims 1990, 5.3]

        T = (up - N (N . up)) / |up - N (N . up)|
    """
    slope = sqrt(normal.x * normal.x + normal.z * normal.z)
    flat = slope < HORIZONTAL
    run = where(flat, 0.0, normal.y / slope)
    return Vec3(where(flat, 1.0, -normal.x * run), where(flat, 0.0, slope), where(flat, 0.0, -normal.z * run))


def _skin_single(size: Any) -> Any:
    return size * 7.62939453125e-6


def _skin_double(size: Any) -> Any:
    return size * 1.4210854715202004e-14


skin = by_precision(_skin_single, _skin_double)
"""64 eps of a size: the distance at which particles are kept from thin surfaces, well above all rounding (1/8 of it)."""


def skin_near(point: Any) -> Any:
    """The skin at a place: of its greatest coordinate, or of 1 m [m]."""
    return skin(maximum(maximum(absolute(point.x), absolute(point.y)), maximum(absolute(point.z), 1.0)))


def meets_plane(start: Any, end: Any, point: Any, normal: Any, thickness: Any) -> Any:
    """(met, passing, level, facing): whether a segment comes into the skin of a two-sided plane, and where.

    `passing` is where it goes through the plane, or ends if it ends in the skin; `facing` the normal to the side of the
    start, and `level` the height at which it stops: one skin, or that of a start inside the skin. A start nearer than
    an eighth of a skin counts as in front of the plane.
    """
    before, after = dot(normal, start - point), dot(normal, end - point)
    behind = before < thickness * -0.125
    before, after = where(behind, -before, before), where(behind, -after, after)
    met = (after < thickness) & (after < before)
    through = where(before > 0.0, before / (before - after), before * 0.0)
    share = where(after >= 0.0, before * 0.0 + 1.0, through)
    level = minimum(maximum(before, 0.0), thickness)
    return met, start + (end - start) * share, level, where(behind, -normal, normal)
