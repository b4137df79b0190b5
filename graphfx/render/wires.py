"""Polygons as lines, for quick pictures: their edges, without those that only divide a flat face."""

from __future__ import annotations

import numpy as np

from graphfx.render.polygons import Polygons
from graphfx.render.streaks import Streaks

FLAT = 1.0 - 1e-6
"""Cosine of the angle between two triangles from which on they are one face."""
FAINT = 0.5
"""How opaque an edge of an opaque polygon is, so that particles behind it are seen."""


def wires_of(polygons: Polygons) -> Streaks:
    """Return a line for each edge, seen as the shutter closes; vertices at one place count as one."""
    vertices = np.asarray(polygons.vertices, np.float64)
    _, first, number = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    edges = _edges(vertices, first[number.reshape(-1)][np.asarray(polygons.triangles, np.int64)])
    color, opacity = np.asarray(polygons.color, np.float32), np.asarray(polygons.opacity, np.float32)
    places = vertices[edges].astype(np.float32)
    return Streaks(
        head=np.ascontiguousarray(places[:, 0].T),
        tail=np.ascontiguousarray(places[:, 1].T),
        head_color=color[edges[:, 0]].T if color.ndim == 2 else (float(color[0]), float(color[1]), float(color[2])),
        head_opacity=FAINT * (opacity[edges[:, 0]] if opacity.ndim else float(opacity)),
        head_moment=0.0,
        tail_moment=0.0,
    )


def _edges(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return (n, 2): the vertices of each edge, once, without those between two triangles in one plane."""
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    edges, first, number, count = np.unique(sides, axis=0, return_index=True, return_inverse=True, return_counts=True)
    total = np.zeros((len(edges), 3))
    np.add.at(total, number.reshape(-1), np.tile(normals, (3, 1)))
    own = np.tile(normals, (3, 1))[first]
    other = total - own
    flat = (count == 2) & ((own * other).sum(axis=1) > FLAT)
    return np.asarray(edges[~flat])
