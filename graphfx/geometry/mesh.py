"""A mesh: points, the triangles between them, and where it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.errors import GraphError, LimitError, Problem
from graphfx.math import sincos

MOST = 4_000_000
"""Vertices, and triangles, of one mesh: row numbers must be exact in float32."""
RADIANS = 0.017453292519943295


@dataclass(frozen=True)
class Mesh:
    """Vertices (n, 3) [m], triangles (m, 3) of their numbers, counter-clockwise seen from outside.

    `normals` are the vertices' own where they have any, `coordinates` (m, 3 corners, 2) the places of the triangles'
    corners in pictures, u to the right, v upwards; without triangles the mesh is a cloud of points.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray | None = None
    coordinates: np.ndarray | None = None

    @property
    def corners(self) -> np.ndarray:
        """Return the corners of all triangles (m, 3 corners, 3)."""
        return self.vertices[self.triangles]

    @property
    def crosses(self) -> np.ndarray:
        """Return (b - a) x (c - a) of all triangles: their normals, twice their area long."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        return np.cross(b - a, c - a)

    @property
    def areas(self) -> np.ndarray:
        """Return the areas of all triangles [m^2]."""
        return np.sqrt((self.crosses**2).sum(axis=1)) / 2

    @property
    def face_normals(self) -> np.ndarray:
        """Return the unit normals of all triangles; 0 where a triangle has no area."""
        return unit_rows(self.crosses)

    @property
    def corner_angles(self) -> np.ndarray:
        """Return the angles (m, 3 corners) of all triangles [rad]."""
        corners = self.corners
        there, before = (unit_rows(np.roll(corners, way, axis=1) - corners) for way in (-1, 1))
        return np.arccos(np.clip((there * before).sum(axis=2), -1, 1))

    def vertex_normals(self) -> np.ndarray:
        """Return unit normals of the vertices: their own, or the mean of the faces about them weighted by the angle there.

        [Thuermer and Wuethrich 1998, Computing vertex normals from polygonal facets]
        """
        if self.normals is not None:
            return unit_rows(self.normals)
        total = np.zeros_like(self.vertices)
        faces, angles = self.face_normals, self.corner_angles
        for k in range(3):
            for axis in range(3):
                total[:, axis] += np.bincount(self.triangles[:, k], faces[:, axis] * angles[:, k], len(total))
        return unit_rows(total)

    def shading_normals(self) -> np.ndarray:
        """Return the vertices' normals, all turned round if they point, taken together, to the triangles' backs."""
        normals = self.vertex_normals()
        together = (normals[self.triangles].sum(axis=1) * self.crosses).sum()
        return -normals if together < 0.0 else normals

    def moved(self, matrix: np.ndarray, shift: np.ndarray) -> Mesh:
        """Return the mesh with all points p at matrix p + shift; what mirrors it keeps its outside out."""
        flips = np.linalg.det(matrix) < 0
        triangles = self.triangles[:, ::-1] if flips else self.triangles
        normals = None if self.normals is None else self.normals @ _cofactors(matrix).T * (-1 if flips else 1)
        coordinates = self.coordinates[:, ::-1] if flips and self.coordinates is not None else self.coordinates
        return Mesh(self.vertices @ matrix.T + shift, triangles, normals, coordinates)

    def open_edges(self) -> int:
        """Return how many edges do not lie between just two triangles that run along them in opposite ways.

        0 for a closed mesh, which has an inside. Vertices at one place count as one.
        """
        _, number = np.unique(self.vertices, axis=0, return_inverse=True)
        joined = number.reshape(-1)[self.triangles]
        joined = joined[(joined != np.roll(joined, 1, axis=1)).all(axis=1)]
        edges = np.concatenate([joined[:, [k, (k + 1) % 3]] for k in range(3)])
        ways = np.where(edges[:, 0] < edges[:, 1], 1, -1)
        _, which, uses = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
        balance = np.bincount(which.reshape(-1), ways, len(uses))
        return int(((balance != 0) | (uses % 2 == 1)).sum())


def unit_rows(vectors: np.ndarray) -> np.ndarray:
    """Return vectors at unit length; 0 for 0."""
    size = np.sqrt((vectors**2).sum(axis=-1, keepdims=True))
    return vectors / np.where(size > 0, size, 1)


def _cofactors(matrix: np.ndarray) -> np.ndarray:
    """Return det(matrix) times its inverse transposed: how a matrix turns cross products."""
    return np.stack([np.cross(matrix[1], matrix[2]), np.cross(matrix[2], matrix[0]), np.cross(matrix[0], matrix[1])])


def rotation(degrees: Sequence[float]) -> np.ndarray:
    """Return the matrix that turns about x, then y, then z, by angles in degrees."""
    made = np.eye(3)
    for axis, angle in enumerate(degrees):
        s, c = (float(part) for part in sincos(np.float64(angle) * RADIANS))
        turn = np.eye(3)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn[i, i], turn[i, j], turn[j, i], turn[j, j] = c, -s, s, c
        made = turn @ made
    return made


def transform(translate: Sequence[float], rotate: Sequence[float], scale: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """Return (matrix, shift) that scales, then rotates (degrees, about x, y, z in this order), then translates."""
    return rotation(rotate) * np.asarray(scale, np.float64), np.asarray(translate, np.float64)


def polygons(vertices: Any, faces: Any, coordinates: Any = None) -> Mesh:
    """Return a mesh from points and polygons, each cut into the triangles of a fan about its first corner.

    `coordinates` holds (u, v) of the corners of each polygon.
    """
    triangles = np.array(_fans(faces), np.int64).reshape(-1, 3)
    places = None if coordinates is None else np.array(_fans(coordinates), np.float64).reshape(-1, 3, 2)
    return Mesh(np.asarray(vertices, np.float64), triangles, None, places)


def _fans(faces: Any) -> list[tuple[Any, Any, Any]]:
    return [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]


def checked(mesh: Mesh, name: str) -> Mesh:
    """Return a mesh that is sound; raise GraphError or LimitError, which name it `name`, for one that is not."""
    if len(mesh.vertices) == 0:
        raise GraphError(Problem(f"{name} has no points"))
    if max(len(mesh.vertices), len(mesh.triangles)) > MOST:
        raise LimitError(Problem(f"{name} has {len(mesh.vertices):,} vertices and {len(mesh.triangles):,} triangles; the most "
                                 f"of either is {MOST:,}; make it coarser"))
    wrong = ~np.isfinite(mesh.vertices).all(axis=1)
    if wrong.any():
        raise GraphError(Problem(f"{name} has {int(wrong.sum())} vertices that are not finite, the first at number "
                                 f"{int(np.flatnonzero(wrong)[0])}"))
    if mesh.triangles.size and not (mesh.triangles.min() >= 0 and mesh.triangles.max() < len(mesh.vertices)):
        raise GraphError(Problem(f"{name} has triangles with corners that are not there: vertices count from 0 to "
                                 f"{len(mesh.vertices) - 1}"))
    return mesh
