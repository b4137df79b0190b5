"""Normals for smooth light on meshes with sharp edges: light goes round an edge only where it is blunt.

    normal of a corner = mean of the faces about its vertex whose normals are within CREASE of its own face's,
                         weighted by their angles there
"""

from __future__ import annotations

import math

import numpy as np

from graphfx.geometry.mesh import Mesh, unit_rows

CREASE = 50.0
"""Degrees between the normals of two faces beyond which the edge between them is sharp: a prism of eight sides is round."""
MOST_MEETING = 5000
"""Faces about a vertex that are compared with each other; where more meet, as no cone's do, all count as near."""


def creased(mesh: Mesh) -> tuple[Mesh, np.ndarray]:
    """Return a mesh and its vertices' normals for smooth light; if it has creases, no two triangles share a vertex.

    Normals of its own stay; vertices at one place count as one.
    """
    if mesh.normals is not None:
        return mesh, mesh.shading_normals()
    number, places = _places(mesh.vertices)
    normals, sharp = _corner_normals(mesh, number[mesh.triangles])
    if not sharp and places == len(mesh.vertices):
        return mesh, mesh.shading_normals()
    triangles = np.arange(mesh.triangles.size).reshape(-1, 3)
    return Mesh(mesh.corners.reshape(-1, 3), triangles, normals, mesh.coordinates), normals


def _places(vertices: np.ndarray) -> tuple[np.ndarray, int]:
    """Return the number of each vertex's place, and how many places there are."""
    order = np.lexsort(vertices.T)
    starts = (np.diff(vertices[order], axis=0) != 0.0).any(axis=1)
    number = np.zeros(len(vertices), np.int64)
    number[order[1:]] = np.cumsum(starts)
    return number, 1 + int(starts.sum())


def _corner_normals(mesh: Mesh, places: np.ndarray) -> tuple[np.ndarray, bool]:
    """Return unit normals (3 m, 3) of the triangles' corners, at numbered places (m, 3), and whether any edge is sharp."""
    faces = mesh.face_normals.repeat(3, axis=0)
    weighted = faces * mesh.corner_angles.reshape(-1, 1)
    order = np.argsort(places.reshape(-1), kind="stable")
    order = order[faces[order].any(axis=1)]
    place = places.reshape(-1)[order]
    ends = np.searchsorted(place, place, side="right")
    crowd = ends - np.searchsorted(place, place) > MOST_MEETING
    faces, shares = faces[order], weighted[order]
    total, sharp = shares.copy(), False
    if crowd.any():
        total[crowd] = np.stack([np.bincount(place, axis) for axis in shares.T], axis=1)[place[crowd]]
    first = np.flatnonzero(~crowd)
    for step in range(1, MOST_MEETING):
        first = first[first + step < ends[first]]
        if not len(first):
            break
        near = (faces[first] * faces[first + step]).sum(axis=1) > math.cos(math.radians(CREASE))
        sharp = sharp or not near.all()
        one, other = first[near], first[near] + step
        total[one] += shares[other]
        total[other] += shares[one]
    normals = np.zeros_like(weighted)
    normals[order] = unit_rows(total)
    return normals, sharp
