"""Project polygons to the screen: what of each triangle lies between the planes, as triangles in pixels.

Vertices are brought to (x w, y w, w) as particles are. A triangle that crosses the near or the far plane is cut
there into a polygon, an edge always from its kept end on, so that two triangles cut the edge that they share at
one point; what the vertices have is interpolated there, where it is linear. The polygon becomes a fan. On the screen

    key k(x, y) = -1 / w in perspective, w in orthographic: linear
    weight of corner i = b_i k_i / sum_j b_j k_j           b: barycentric on the screen; orthographic: b_i

Triangles in which a number is not finite are dropped and counted; those without area on the screen are not seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner
from graphfx.render.camera import Camera
from graphfx.render.polygons import Polygons
from graphfx.store.threads import parallel, ranges

CORNERS = 9
"""Most corners of a triangle that two planes have cut, with room to spare."""
LOOK = 7
"""Normal, colour and opacity of a corner."""
GREATEST = 1e30
"""Pixels and colours beyond which nothing is drawn, so that products stay finite."""
GRAIN = 2048
"""Fewest triangles worth a thread of their own."""


class Triangles(NamedTuple):
    """Triangles on the screen, by rows, in the order of polygons: the earlier goes before the later at equal keys.

    `places` are x, y of the corners in pixels, then their keys, `looks` the corners' normals (towards the viewer),
    colours and opacities, `coordinates` (u, v) of the corners. `look` is the number of the polygons.
    """

    places: np.ndarray
    looks: np.ndarray
    coordinates: np.ndarray
    look: np.ndarray
    opaque: np.ndarray


class _Source(NamedTuple):
    """One look's triangles as they come: normals of vertices or, if flat, of triangles; masks 0 where one value serves all."""

    points: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    flat: bool
    colors: np.ndarray
    color_mask: int
    opacities: np.ndarray
    opacity_mask: int
    coordinates: np.ndarray
    double_sided: bool
    opaque: bool
    look: int


class _View(NamedTuple):
    near: float
    far: float
    perspective: bool
    width: int
    height: int


class _Cut(NamedTuple):
    """Room to cut one triangle: corners (x w, y w, w, three weights) twice, then screen corners (x, y, key)."""

    corners: np.ndarray
    spare: np.ndarray
    screen: np.ndarray


@inner
def _cut_at(corners, count, plane, sign, made):
    """Keep what has sign (w - plane) >= 0 of a polygon, by way of `made`; return its number of corners."""
    kept = 0
    for i in range(count):
        j = (i + 1) % count
        here, there = sign * (corners[i, 2] - plane), sign * (corners[j, 2] - plane)
        if here >= 0.0:
            for c in range(6):
                made[kept, c] = corners[i, c]
            kept += 1
        if (here >= 0.0) != (there >= 0.0):
            a, b = (i, j) if here >= 0.0 else (j, i)
            t = (plane - corners[a, 2]) / (corners[b, 2] - corners[a, 2])
            for c in range(6):
                made[kept, c] = corners[a, c] + t * (corners[b, c] - corners[a, c])
            made[kept, 2] = plane
            kept += 1
    for i in range(kept):
        for c in range(6):
            corners[i, c] = made[i, c]
    return kept


@inner
def _corners(source, t, view, cut):
    """Write the screen corners of what is seen of triangle t; return how many, or -1 if it is to be dropped."""
    total, low, high = 0.0, np.inf, -np.inf
    for k in range(3):
        v = source.triangles[t, k]
        for c in range(3):
            cut.corners[k, c] = source.points[v, c]
            cut.corners[k, 3 + c] = 1.0 if c == k else 0.0
            total += source.points[v, c] + source.normals[t if source.flat else v, c]
            total += source.colors[v & source.color_mask, c]
        total += source.opacities[v & source.opacity_mask]
        if source.coordinates.shape[0]:
            total += source.coordinates[t, k, 0] + source.coordinates[t, k, 1]
        low, high = min(low, cut.corners[k, 2]), max(high, cut.corners[k, 2])
    if total - total != 0.0:
        return -1
    if high < view.near or low > view.far:
        return 0
    count = 3
    for plane, sign in ((view.near, 1.0), (view.far, -1.0)):
        if (low < plane if sign > 0.0 else high > plane):
            count = _cut_at(cut.corners, count, plane, sign, cut.spare)
    for i in range(count):
        x, y, w = cut.corners[i, 0], cut.corners[i, 1], cut.corners[i, 2]
        inverse = 1.0 / w if view.perspective else 1.0
        cut.screen[i, 0], cut.screen[i, 1], cut.screen[i, 2] = x * inverse, y * inverse, -inverse if view.perspective else w
    return count


@inner
def _turn(screen, j):
    """Return twice the area of the fan's triangle (0, j, j + 1): above 0 where it turns clockwise on the screen."""
    x, y = screen[0, 0], screen[0, 1]
    return (screen[j, 0] - x) * (screen[j + 1, 1] - y) - (screen[j + 1, 0] - x) * (screen[j, 1] - y)


@inner
def _seen(screen, j, turn, double_sided, view):
    """Return whether the triangle (0, j, j + 1) can cover a sample of the picture."""
    left = min(screen[0, 0], min(screen[j, 0], screen[j + 1, 0]))
    right = max(screen[0, 0], max(screen[j, 0], screen[j + 1, 0]))
    top = min(screen[0, 1], min(screen[j, 1], screen[j + 1, 1]))
    bottom = max(screen[0, 1], max(screen[j, 1], screen[j + 1, 1]))
    inside = left < view.width and right > 0.0 and top < view.height and bottom > 0.0
    sized = left > -GREATEST and right < GREATEST and top > -GREATEST and bottom < GREATEST and turn != 0.0
    return inside and sized and (double_sided or turn < 0.0)


@inner
def _mixed(weights, a, b, c):
    return weights[3] * a + weights[4] * b + weights[5] * c


@inner
def _bounded(value):
    return np.float32(min(max(value, -GREATEST), GREATEST))


@inner
def _write_corner(source, t, corner, facing, made, at, k):
    """Write what a corner of triangle t looks like; its weights are those of `corner`. Return whether it is opaque."""
    a, b, c = source.triangles[t, 0], source.triangles[t, 1], source.triangles[t, 2]
    m = source.color_mask
    for axis in range(3):
        normal = source.normals[t, axis] if source.flat else _mixed(
            corner, source.normals[a, axis], source.normals[b, axis], source.normals[c, axis])
        made.looks[at, LOOK * k + axis] = _bounded(facing * normal)
        made.looks[at, LOOK * k + 3 + axis] = _bounded(_mixed(
            corner, source.colors[a & m, axis], source.colors[b & m, axis], source.colors[c & m, axis]))
    m = source.opacity_mask
    opacity = _mixed(corner, source.opacities[a & m], source.opacities[b & m], source.opacities[c & m])
    made.looks[at, LOOK * k + 6] = np.float32(opacity)
    if source.coordinates.shape[0]:
        for axis in range(2):
            made.coordinates[at, 2 * k + axis] = _mixed(
                corner, source.coordinates[t, 0, axis], source.coordinates[t, 1, axis], source.coordinates[t, 2, axis])
    return made.looks[at, LOOK * k + 6] == 1.0


@inner
def _write(source, t, cut, j, turn, made, at):
    """Write the fan's triangle (0, j, j + 1) of triangle t to row `at`."""
    facing = 1.0 if turn < 0.0 else -1.0
    opaque = source.opaque
    for k in range(3):
        i = 0 if k == 0 else j + k - 1
        made.places[at, 2 * k], made.places[at, 2 * k + 1] = cut.screen[i, 0], cut.screen[i, 1]
        made.places[at, 6 + k] = cut.screen[i, 2] + 0.0
        opaque = _write_corner(source, t, cut.corners[i], facing, made, at, k) and opaque
    made.look[at] = source.look
    made.opaque[at] = opaque


@compiled
def _project(source, view, start, stop, made, at):
    """Write what is seen of triangles start ... stop from row `at` on, if there are rows; return (rows, how many are dropped)."""
    cut = _Cut(np.zeros((CORNERS, 6)), np.zeros((CORNERS, 6)), np.zeros((CORNERS, 3)))
    first, dropped = at, 0
    for t in range(start, stop):
        count = _corners(source, t, view, cut)
        if count < 0:
            dropped += 1
        for j in range(1, count - 1):
            turn = _turn(cut.screen, j)
            if _seen(cut.screen, j, turn, source.double_sided, view):
                if made.look.shape[0]:
                    _write(source, t, cut, j, turn, made, at)
                at += 1
    return at - first, dropped


def _empty(count: int, mapped: bool) -> Triangles:
    return Triangles(
        np.empty((count, 9)), np.empty((count, 3 * LOOK), np.float32), np.zeros((count, 6 if mapped else 0)),
        np.empty(count, np.int32), np.empty(count, np.bool_),
    )


def _source(polygons: Polygons, matrix: np.ndarray, number: int) -> _Source:
    """Return a look's triangles with their points on the way to the screen."""
    vertices = np.ascontiguousarray(polygons.vertices, np.float64).reshape(-1, 3)
    triangles = np.ascontiguousarray(polygons.triangles, np.int64).reshape(-1, 3)
    x, y, z = vertices.T
    with np.errstate(all="ignore"):
        points = np.stack([row[0] * x + row[1] * y + row[2] * z + row[3] for row in matrix], axis=1)
        if polygons.shading == "smooth":
            normals = np.ascontiguousarray(polygons.normals, np.float64)
        else:
            normals = face_normals(vertices[triangles])
    colors = np.ascontiguousarray(polygons.color, np.float64).reshape(-1, 3)
    opacities = np.ascontiguousarray(polygons.opacity, np.float64).reshape(-1).clip(0.0, 1.0)
    given = polygons.coordinates if polygons.color_map is not None or polygons.opacity_map is not None else None
    coordinates = np.zeros((0, 3, 2)) if given is None else np.ascontiguousarray(given, np.float64)
    return _Source(
        points, triangles, normals, polygons.shading != "smooth", colors, 0 if len(colors) == 1 else -1,
        opacities, 0 if len(opacities) == 1 else -1, coordinates, polygons.double_sided, polygons.opaque, number,
    )


def face_normals(corners: np.ndarray) -> np.ndarray:
    """Return the unit normals (m, 3) of triangles (m, 3 corners, 3); 0 where there is no area."""
    sides = corners[:, 1:] - corners[:, :1]
    size = np.abs(sides).max(axis=(1, 2), initial=0.0)[:, None, None]
    sides = sides / np.where(size > 0.0, size, 1.0)
    normals = np.cross(sides[:, 0], sides[:, 1])
    length = np.sqrt((normals**2).sum(axis=1, keepdims=True))
    return normals / np.where(length > 0.0, length, 1.0)


def project_polygons(
    given: Sequence[Polygons], camera: Camera, width: int, height: int, threads: int
) -> tuple[Triangles, int]:
    """Return the triangles of all polygons that the picture may show, and how many were dropped."""
    view = _View(*camera.planes, camera.perspective, width, height)
    matrix = camera.screen_matrix(width, height)
    sources = [_source(polygons, matrix, number) for number, polygons in enumerate(given)]
    pieces = [(source, *bounds) for source in sources for bounds in ranges(len(source.triangles), threads, GRAIN)]
    nothing = _empty(0, False)
    found = [(0, 0)] * len(pieces)

    def count(piece: int) -> None:
        source, start, stop = pieces[piece]
        found[piece] = _project(source, view, start, stop, nothing, 0)

    parallel(count, len(pieces), threads)
    starts = np.cumsum([0, *(rows for rows, _ in found)])
    made = _empty(int(starts[-1]), any(len(source.coordinates) for source in sources))

    def write(piece: int) -> None:
        source, start, stop = pieces[piece]
        _project(source, view, start, stop, made, int(starts[piece]))

    if starts[-1]:
        parallel(write, len(pieces), threads)
    return made, sum(dropped for _, dropped in found)
