"""Read meshes from files, by trimesh, which is imported only here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.errors import GraphError, LimitError, Problem, how_to_install
from graphfx.geometry.mesh import Mesh

FORMATS = (".obj", ".ply", ".stl", ".gltf", ".glb")
MOST_BYTES = 1 << 30
"""Size of the largest file that is read."""


def load_mesh(file: str) -> Mesh:
    """Return the mesh in a file, all its parts as one where they stand; raise GraphError for a file that is none."""
    path = Path(file)
    name = f"the file {path.name}"
    if path.suffix.lower() not in FORMATS:
        raise GraphError(Problem(f"{name} should be one of {', '.join(FORMATS)}"))
    if not path.is_file():
        raise GraphError(Problem(f"{name} is not there"))
    if path.stat().st_size > MOST_BYTES:
        raise LimitError(Problem(f"{name} has {path.stat().st_size:,} bytes; the most is {MOST_BYTES:,}"))
    try:
        import trimesh
    except ImportError as error:
        raise GraphError(Problem(f"files of meshes are read by trimesh, {how_to_install(error, 'mesh')}")) from error
    try:
        found = trimesh.load_scene(str(path), process=False, skip_materials=True)
        parts = [_part(part) for part in found.dump()]
    except Exception as error:  # a reader of hostile files may fail in any way
        raise GraphError(Problem(f"{name} cannot be read as {path.suffix[1:]}: {type(error).__name__}: {error}")) from error
    parts = [part for part in parts if len(part.vertices)]
    if not parts:
        raise GraphError(Problem(f"{name} has no points"))
    return _together(parts)


def _part(part: Any) -> Mesh:
    vertices = np.array(part.vertices, np.float64).reshape(-1, 3)
    faces = getattr(part, "faces", None)
    triangles = np.zeros((0, 3), np.int64) if faces is None else np.array(faces, np.int64).reshape(-1, 3)
    places = getattr(getattr(part, "visual", None), "uv", None)
    if places is None or len(places) != len(vertices) or not len(triangles):
        return Mesh(vertices, triangles)
    return Mesh(vertices, triangles, None, np.array(places, np.float64)[triangles, :2])


def _together(parts: list[Mesh]) -> Mesh:
    """Return one mesh of several; vertices that lie at one place, as in an STL, become one where triangles use them."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    vertices = np.concatenate([part.vertices for part in parts])
    triangles = np.concatenate([part.triangles + start for part, start in zip(parts, starts[:-1], strict=True)])
    if not len(triangles):
        return Mesh(vertices, triangles)
    places = [part.coordinates for part in parts if len(part.triangles) and part.coordinates is not None]
    whole = sum(map(len, places)) == len(triangles)
    coordinates = np.concatenate(places) if whole else None
    _, first, number = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    place = np.argsort(np.argsort(first))
    return Mesh(vertices[np.sort(first)], place[number.reshape(-1)][triangles], None, coordinates)
