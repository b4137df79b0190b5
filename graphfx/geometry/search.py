"""Find things in the tree of a mesh: the first face on a segment, the nearest face, inside or outside.

These walk a tree, each particle its own way, so a node that calls them says `branches=True`. Boxes are wider than
what is in them by four skins, more than all rounding in the tests of boxes; so a box that is passed over holds
nothing that the tests of faces would find.
"""

from __future__ import annotations

from typing import Any

from graphfx.geometry.access import skin_near
from graphfx.geometry.tables import BOXES, LEAVES, SCALE
from graphfx.math import Vec3, absolute, cross, dot, maximum, minimum, where
from graphfx.math.tables import entry, link


def leaf_corner_a(mesh: Any, place: int) -> Any:
    """The first corner of the face at a place of the tree."""
    return Vec3(entry(mesh, LEAVES, place, 0), entry(mesh, LEAVES, place, 1), entry(mesh, LEAVES, place, 2))


def leaf_corner_b(mesh: Any, place: int) -> Any:
    """The second corner."""
    return Vec3(entry(mesh, LEAVES, place, 3), entry(mesh, LEAVES, place, 4), entry(mesh, LEAVES, place, 5))


def leaf_corner_c(mesh: Any, place: int) -> Any:
    """The third corner."""
    return Vec3(entry(mesh, LEAVES, place, 6), entry(mesh, LEAVES, place, 7), entry(mesh, LEAVES, place, 8))


def leaf_normal(mesh: Any, place: int) -> Any:
    """The unit normal of the face at a place of the tree."""
    return Vec3(entry(mesh, LEAVES, place, 9), entry(mesh, LEAVES, place, 10), entry(mesh, LEAVES, place, 11))


def skin_of(mesh: Any) -> Any:
    """The distance [m] at which a particle is kept from a mesh."""
    return entry(mesh, SCALE, 0, 0)


def slack_of(mesh: Any, start: Any, end: Any) -> Any:
    """What rounding may hide along a segment, many times over: a skin of its own coordinates, or of the mesh [m]."""
    return maximum(skin_of(mesh), maximum(skin_near(start), skin_near(end)))


def box_apart(mesh: Any, node: int, middle: Any, half: Any, size: Any, slack: Any) -> Any:
    """Whether a box of the tree and the segment middle +- half lie apart: the box's axes, then those across both.

    `size` holds the absolute values of half; boxes count as wider by `slack`. [Gottschalk, Lin and Manocha 1996, OBBTree]
    """
    x = middle.x - entry(mesh, BOXES, node, 0)
    y = middle.y - entry(mesh, BOXES, node, 1)
    z = middle.z - entry(mesh, BOXES, node, 2)
    width, height = entry(mesh, BOXES, node, 3) + slack, entry(mesh, BOXES, node, 4) + slack
    depth = entry(mesh, BOXES, node, 5) + slack
    if (absolute(x) > width + size.x) | (absolute(y) > height + size.y) | (absolute(z) > depth + size.z):
        return True
    return (
        (absolute(y * half.z - z * half.y) > height * size.z + depth * size.y)
        | (absolute(z * half.x - x * half.z) > depth * size.x + width * size.z)
        | (absolute(x * half.y - y * half.x) > width * size.y + height * size.x)
    )


def beyond_edge(point: Any, first: Any, second: Any, normal: Any, margin: Any) -> Any:
    """Whether a point of a face's plane lies outside an edge by more than a margin."""
    edge = second - first
    area = dot(normal, cross(edge, point - first))
    return (area < 0.0) & (area * area > margin * margin * dot(edge, edge))


def over_face(mesh: Any, place: int, point: Any, margin: Any) -> Any:
    """Whether a point lies over a face, or beside it by no more than a margin."""
    a, b, c, normal = leaf_corner_a(mesh, place), leaf_corner_b(mesh, place), leaf_corner_c(mesh, place), leaf_normal(mesh, place)
    if beyond_edge(point, a, b, normal, margin):
        return False
    return not (beyond_edge(point, b, c, normal, margin) | beyond_edge(point, c, a, normal, margin))


def meeting(mesh: Any, place: int, start: Any, end: Any, margin: Any) -> Any:
    """When a segment comes into the skin of a face, as a share of it; 2 if it does not.

    The face has a skin on the side where the segment starts; a start nearer than an eighth of a skin counts as in
    front. What ends inside the skin while going deeper, or passes the face, meets it, if it comes into the skin or
    leaves it (by passing, or by ending) over the face. Of the two places rounding can bring but one to the wrong side
    of an edge.
    """
    skin = skin_of(mesh)
    normal = leaf_normal(mesh, place)
    corner = leaf_corner_a(mesh, place)
    before, after = dot(normal, start - corner), dot(normal, end - corner)
    never = skin * 0.0 + 2.0
    if before < skin * -0.125:
        before, after = -before, -after
    if (after >= skin) | (after >= before):
        return never
    coming = maximum((before - skin) / (before - after), 0.0)
    if over_face(mesh, place, start + (end - start) * coming, margin):
        return coming
    passing = where(after >= 0.0, never * 0.5, where(before > 0.0, before / (before - after), never * 0.0))
    return coming if over_face(mesh, place, start + (end - start) * passing, margin) else never


def first_meeting(mesh: Any, start: Any, end: Any) -> Any:
    """(met, point, normal): the face that a segment first meets, as a plane one skin off it, facing the start.

    The normal points to the side of the start. A start inside the skin has the plane go through it: nothing is pushed
    about. Of faces met at once the one nearest to the tree's beginning is taken.
    """
    middle, half = (start + end) * 0.5, (end - start) * 0.5
    size = Vec3(absolute(half.x), absolute(half.y), absolute(half.z))
    skin, slack = skin_of(mesh), slack_of(mesh, start, end)
    earliest = skin * 0.0 + 1.5
    chosen = -1
    node, count = 0, link(mesh, BOXES, 0, 6)
    while node < count:
        if box_apart(mesh, node, middle, half, size, slack):
            node = link(mesh, BOXES, node, 6)
        else:
            leaf = link(mesh, BOXES, node, 7)
            for place in range(leaf >> 3, (leaf >> 3) + (leaf & 7)):
                time = meeting(mesh, place, start, end, slack * 0.125)
                if time < earliest:
                    earliest, chosen = time, place
            node += 1
    place = chosen if chosen >= 0 else 0
    normal, corner = leaf_normal(mesh, place), leaf_corner_a(mesh, place)
    before = dot(normal, start - corner)
    facing = where(before < skin * -0.125, -normal, normal)
    level = minimum(maximum(dot(facing, start - corner), 0.0), skin)
    return chosen >= 0, corner + facing * level, facing


def crosses_ahead(mesh: Any, place: int, position: Any) -> Any:
    """Whether the ray from a point along +x meets a face; rays through an edge meet just one of the faces beside it.

    Seen along x, a point is within a triangle if an odd number of its edges lie to its +z side. An edge that two
    faces share is taken from its lower end for both, so they agree to the last bit on which side of it the point is.
    """
    a, b, c = leaf_corner_a(mesh, place), leaf_corner_b(mesh, place), leaf_corner_c(mesh, place)
    if not (edge_aside(a, b, position) ^ edge_aside(b, c, position) ^ edge_aside(c, a, position)):
        return False
    normal = leaf_normal(mesh, place)
    return (dot(normal, position - a) < 0.0) == (normal.x > 0.0)


def edge_aside(first: Any, second: Any, position: Any) -> Any:
    """Whether an edge, seen along x, has the height y of a point and lies to its +z side there."""
    if (first.y <= position.y) == (second.y <= position.y):
        return False
    swap = second.y < first.y
    low, high = where(swap, second, first), where(swap, first, second)
    return (position.z - low.z) * (high.y - low.y) < (high.z - low.z) * (position.y - low.y)


def is_inside(mesh: Any, position: Any) -> Any:
    """Whether a point is inside a closed mesh: a ray along +x meets an odd number of faces."""
    inside = position.x > position.x
    node, count = 0, link(mesh, BOXES, 0, 6)
    while node < count:
        if (
            (position.x - entry(mesh, BOXES, node, 0) > entry(mesh, BOXES, node, 3))
            | (absolute(position.y - entry(mesh, BOXES, node, 1)) > entry(mesh, BOXES, node, 4))
            | (absolute(position.z - entry(mesh, BOXES, node, 2)) > entry(mesh, BOXES, node, 5))
        ):
            node = link(mesh, BOXES, node, 6)
        else:
            leaf = link(mesh, BOXES, node, 7)
            for place in range(leaf >> 3, (leaf >> 3) + (leaf & 7)):
                if crosses_ahead(mesh, place, position):
                    inside = not inside
            node += 1
    return inside


def nearest_on_face(mesh: Any, place: int, position: Any) -> Any:
    """The point of a face that is nearest to a point. [Ericson 2005, Real-time collision detection, 5.1.5]"""
    a, b, c, normal = leaf_corner_a(mesh, place), leaf_corner_b(mesh, place), leaf_corner_c(mesh, place), leaf_normal(mesh, place)
    within = (
        (dot(normal, cross(b - a, position - a)) >= 0.0)
        & (dot(normal, cross(c - b, position - b)) >= 0.0)
        & (dot(normal, cross(a - c, position - c)) >= 0.0)
        & (dot(normal, normal) > 0.5)
    )
    if within:
        return position - normal * dot(normal, position - a)
    first, second, third = nearest_on_edge(a, b, position), nearest_on_edge(b, c, position), nearest_on_edge(c, a, position)
    found = where(square_between(second, position) < square_between(first, position), second, first)
    return where(square_between(third, position) < square_between(found, position), third, found)


def nearest_on_edge(first: Any, second: Any, position: Any) -> Any:
    """The point of a segment that is nearest to a point."""
    edge = second - first
    square = dot(edge, edge)
    share = where(square > 0.0, dot(position - first, edge) / square, 0.0)
    return first + edge * minimum(maximum(share, 0.0), 1.0)


def square_between(a: Any, b: Any) -> Any:
    """The square of the distance between two points."""
    return dot(a - b, a - b)


def box_square(mesh: Any, node: int, position: Any) -> Any:
    """The square of the distance from a point to a box of the tree; 0 inside."""
    x = maximum(absolute(position.x - entry(mesh, BOXES, node, 0)) - entry(mesh, BOXES, node, 3), 0.0)
    y = maximum(absolute(position.y - entry(mesh, BOXES, node, 1)) - entry(mesh, BOXES, node, 4), 0.0)
    z = maximum(absolute(position.z - entry(mesh, BOXES, node, 2)) - entry(mesh, BOXES, node, 5), 0.0)
    return x * x + y * y + z * z


def likely_leaf(mesh: Any, position: Any) -> int:
    """The leaf that is reached by always going down to the nearer box."""
    node = 0
    while link(mesh, BOXES, node, 7) == 0:
        left = node + 1
        right = link(mesh, BOXES, left, 6)
        node = right if box_square(mesh, right, position) < box_square(mesh, left, position) else left
    return node


def nearest(mesh: Any, position: Any) -> Any:
    """(point, normal): the point of a mesh's surface that is nearest to a point, and the normal of the face there.

    A first guess keeps the walk short: boxes farther away than what was found are passed over.
    """
    at = link(mesh, BOXES, likely_leaf(mesh, position), 7) >> 3
    found = nearest_on_face(mesh, at, position)
    least = square_between(found, position)
    node, count = 0, link(mesh, BOXES, 0, 6)
    while node < count:
        if box_square(mesh, node, position) >= least:
            node = link(mesh, BOXES, node, 6)
        else:
            leaf = link(mesh, BOXES, node, 7)
            for place in range(leaf >> 3, (leaf >> 3) + (leaf & 7)):
                point = nearest_on_face(mesh, place, position)
                square = square_between(point, position)
                if square < least:
                    least, found, at = square, point, place
            node += 1
    return found, leaf_normal(mesh, at)
