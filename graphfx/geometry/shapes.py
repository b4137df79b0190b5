"""Simple shapes as meshes. Those that close are closed meshes, with their outside out.

Seen from outside, a picture is put on upright: once on each face of a box, cap and sheet, once around all else.
"""

from __future__ import annotations

import numpy as np

from graphfx.errors import GraphError, Problem
from graphfx.geometry.mesh import Mesh, polygons, unit_rows
from graphfx.math import sincos

TURN = 6.283185307179586
GOLDEN = 1.618033988749895
BOX_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
BOX_SIDES = ((2, False, 1, False), (2, True, 1, False), (0, False, 2, False), (0, False, 2, True), (0, True, 1, False),
             (0, False, 1, False))
"""The axes of u and v on each face, and whether they run the other way."""


def box(size: tuple[float, float, float]) -> Mesh:
    """Return a box about the origin."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * np.asarray(size, np.float64)
    return polygons(corners, BOX_FACES, [[_on_side(corner, *side) for corner in face]
                                         for face, side in zip(BOX_FACES, BOX_SIDES, strict=True)])


def _on_side(corner: int, u: int, u_turned: bool, v: int, v_turned: bool) -> tuple[int, int]:
    """Return (u, v) of a corner of a box, numbered 4 x + 2 y + z, along two axes, either of them turned round."""
    place = corner >> 2 & 1, corner >> 1 & 1, corner & 1
    return place[u] ^ u_turned, place[v] ^ v_turned


def sphere(radius: float, subdivisions: int) -> Mesh:
    """Return a sphere about the origin: an icosahedron whose triangles are cut in four so many times."""
    points = [(0, a, b) for a in (-1, 1) for b in (-GOLDEN, GOLDEN)]
    vertices = unit_rows(np.array([np.roll(point, k) for k in range(3) for point in points], np.float64))
    faces = _hull_of_icosahedron(vertices)
    for _ in range(subdivisions):
        edges = np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        ends, number = np.unique(edges, axis=0, return_inverse=True)
        middle = number.reshape(3, -1).T + len(vertices)
        vertices = np.concatenate([vertices, unit_rows(vertices[ends].sum(axis=1))])
        a, b, c = faces.T
        ab, bc, ca = middle.T
        faces = np.concatenate([np.stack(part, axis=1) for part in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return Mesh(vertices * radius, faces, vertices, _longitudes(vertices[faces]))


def _longitudes(corners: np.ndarray) -> np.ndarray:
    """Return (u, v) of corners (m, 3, 3) on the unit sphere: longitude about y, 0.5 at +z, and latitude.

    A triangle across the seam goes on beyond 0 or 1; a corner at a pole has the longitude of the middle of the others.
    """
    x, y, z = np.moveaxis(corners, 2, 0)
    middle = corners.mean(axis=1)
    centre = 0.5 + np.arctan2(middle[:, 0], middle[:, 2])[:, None] / TURN
    u = 0.5 + np.arctan2(x, z) / TURN
    u += np.round(centre - u)
    pole = np.hypot(x, z) < 1e-9
    others = np.where(pole, 0.0, u).sum(axis=1, keepdims=True) / np.maximum((~pole).sum(axis=1, keepdims=True), 1)
    return np.stack([np.where(pole, others, u), 0.5 + np.arcsin(np.clip(y, -1.0, 1.0)) * 2.0 / TURN], axis=2)


def _hull_of_icosahedron(vertices: np.ndarray) -> np.ndarray:
    """Return the twenty faces: all triples of neighbours, turned so that they look outward."""
    near = vertices @ vertices.T > 0.4
    found = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                if near[a, b] and near[b, c] and near[a, c]:
                    out = np.dot(np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a]), vertices[a]) > 0
                    found.append((a, b, c) if out else (a, c, b))
    return np.array(found, np.int64)


def grid(width: float, depth: float, columns: int, rows: int) -> Mesh:
    """Return a flat sheet about the origin, in the plane of x and z, that looks up."""
    x, z = np.meshgrid(np.linspace(-0.5, 0.5, columns + 1) * width, np.linspace(-0.5, 0.5, rows + 1) * depth)
    vertices = np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1)
    return Mesh(vertices, _patches(rows, columns, columns + 1), None, _patch_coordinates(rows, columns))


def _patch_coordinates(rows: int, columns: int) -> np.ndarray:
    """Return (u, v) of the corners of the triangles of `_patches`: u along a row, v from the last row to the first."""
    i, j = (part.ravel() for part in np.mgrid[0:rows, 0:columns])
    a, b, c, d = (np.stack([(j + q) / columns, 1.0 - (i + p) / rows], axis=1) for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def _patches(rows: int, columns: int, stride: int, wrap_columns: bool = False, wrap_rows: bool = False) -> np.ndarray:
    """Return two triangles for each patch of a net of vertices, `stride` to a row."""
    i, j = (part.ravel() for part in np.mgrid[0:rows, 0:columns])
    after_i = (i + 1) % rows if wrap_rows else i + 1
    after_j = (j + 1) % columns if wrap_columns else j + 1
    a, b, c, d = (p * stride + q for p, q in ((i, j), (after_i, j), (after_i, after_j), (i, after_j)))
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]).astype(np.int64)


def _circle(segments: int) -> tuple[np.ndarray, np.ndarray]:
    """Return sines and cosines of equal angles, one turn."""
    turns = [sincos(np.float64(TURN * k / segments)) for k in range(segments)]
    return np.array([s for s, _ in turns], np.float64), np.array([c for _, c in turns], np.float64)


def _cap_coordinates(s: np.ndarray, c: np.ndarray, below: bool) -> np.ndarray:
    """Return (u, v) of a cap's triangles: its middle, then two neighbours on its circle, the later first if seen from below."""
    rim = np.stack([0.5 + 0.5 * c, 0.5 - 0.5 * s if below else 0.5 + 0.5 * s], axis=1)
    after = np.roll(rim, -1, axis=0)
    pair = (after, rim) if below else (rim, after)
    return np.stack([np.full_like(rim, 0.5), *pair], axis=1)


def cylinder(radius: float, height: float, segments: int, caps: bool) -> Mesh:
    """Return a cylinder about the y axis, its middle at the origin; without caps it is a tube."""
    s, c = _circle(segments)
    rings = [np.stack([radius * c, np.full(segments, y), -radius * s], axis=1) for y in (height / 2, -height / 2)]
    sides = _patches(1, segments, segments, wrap_columns=True)
    around = _patch_coordinates(1, segments)
    if not caps:
        return Mesh(np.concatenate(rings), sides, None, around)
    ends = [(0, height / 2, 0), (0, -height / 2, 0)]
    ring = np.arange(segments)
    after = (ring + 1) % segments
    top = np.stack([np.full(segments, 2 * segments), ring, after], axis=1)
    bottom = np.stack([np.full(segments, 2 * segments + 1), after + segments, ring + segments], axis=1)
    coordinates = np.concatenate([around, _cap_coordinates(s, c, below=False), _cap_coordinates(s, c, below=True)])
    vertices = np.concatenate([*rings, np.array(ends, np.float64)])
    return Mesh(vertices, np.concatenate([sides, top, bottom]).astype(np.int64), None, coordinates)


def cone(radius: float, height: float, segments: int, caps: bool) -> Mesh:
    """Return a cone about the y axis: its base below the origin, its tip above, each by half the height."""
    s, c = _circle(segments)
    ring = np.stack([radius * c, np.full(segments, -height / 2), -radius * s], axis=1)
    number = np.arange(segments)
    after = (number + 1) % segments
    faces = [np.stack([np.full(segments, segments), number, after], axis=1)]
    tip = np.stack([(number + 0.5) / segments, np.ones(segments)], axis=1)
    rim = [np.stack([(number + k) / segments, np.zeros(segments)], axis=1) for k in (0, 1)]
    coordinates = [np.stack([tip, *rim], axis=1)]
    if caps:
        coordinates.append(_cap_coordinates(s, c, below=True))
        faces.append(np.stack([np.full(segments, segments + 1), after, number], axis=1))
    ends = np.array([(0, height / 2, 0), (0, -height / 2, 0)][: 2 if caps else 1], np.float64)
    vertices, triangles = np.concatenate([ring, ends]), np.concatenate(faces).astype(np.int64)
    return Mesh(vertices, triangles, None, np.concatenate(coordinates))


def torus(radius: float, tube: float, segments: int, sides: int) -> Mesh:
    """Return a torus about the y axis: a tube whose middle goes round at `radius`."""
    (s, c), (q, p) = _circle(segments), _circle(sides)
    away = radius + tube * p
    x, z = np.outer(c, away), np.outer(-s, away)
    vertices = np.stack([x, np.broadcast_to(tube * q, x.shape), z], axis=-1).reshape(-1, 3)
    out = np.stack([np.outer(c, p), np.broadcast_to(q, x.shape), np.outer(-s, p)], axis=-1).reshape(-1, 3)
    around = _patch_coordinates(segments, sides)
    coordinates = np.stack([1.0 - around[..., 1], around[..., 0]], axis=2)
    return Mesh(vertices, _patches(segments, sides, sides, wrap_columns=True, wrap_rows=True), out, coordinates)


def points(numbers: tuple[float, ...]) -> Mesh:
    """Return a cloud of points from x, y, z of the first, x, y, z of the second, and so on."""
    if len(numbers) % 3:
        raise GraphError(Problem(f"points takes x, y, z for each point, and has {len(numbers)} numbers"))
    return Mesh(np.array(numbers, np.float64).reshape(-1, 3), np.zeros((0, 3), np.int64))
