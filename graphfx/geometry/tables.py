"""The tables of a mesh: what functions of particles read of it, in single or double precision."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from graphfx.geometry.areas import alias_table
from graphfx.geometry.mesh import Mesh
from graphfx.geometry.tree import Tree

VERTICES, FACES, CHANCES, BOXES, LINKS, LEAVES, SCALE = range(7)
"""Tables, with their columns: position and normal of a vertex; corners and normal of a face; chance of a face and the
other (see `areas`); center and half size of a box of the tree; where to go on past the box, its first leaf and their
number; the tree's faces as in FACES and their place there; the skin, the least and the greatest corner of all."""
COLUMNS = (6, 12, 2, 6, 3, 13, 7)
SKIN = 64
"""The thickness of a surface in units in the last place of its greatest coordinate (1 m at least). A particle is kept
this far from a mesh, so that rounding, an eighth of it and less, takes none through."""


class Side:
    """The tables in one precision, as plain Python reads them; `address` is what compiled code does."""

    def __init__(self, kind: Any, parts: dict[int, np.ndarray]):
        """Round `parts` to `kind`; tables that are not there are one row of zeros."""
        self.kind = kind
        self.counts = [len(parts.get(table, ())) for table in range(len(COLUMNS))]
        self.tables = [
            np.ascontiguousarray(parts[table] if count else np.zeros((1, columns)), np.int32 if table == LINKS else kind)
            for table, (columns, count) in enumerate(zip(COLUMNS, self.counts, strict=True))
        ]
        lines = [(array.ctypes.data, count, array.shape[1]) for array, count in zip(self.tables, self.counts, strict=True)]
        self._list = np.array(lines, np.int64)

    @property
    def address(self) -> int:
        """Return where the list of the tables lies in memory, for as long as this object lives."""
        return int(self._list.ctypes.data)


class MeshTables:
    """The tables of one mesh where it stands at one time; a tree only where it is `searched`."""

    def __init__(self, mesh: Mesh, searched: bool = False):
        """Tables are made when they are first asked for."""
        self.mesh = mesh
        self.searched = searched
        self._sides: dict[Any, Side] = {}

    def of(self, kind: Any) -> Side:
        """Return the tables in np.float32 or np.float64."""
        if kind not in self._sides:
            self._sides[kind] = Side(kind, self._parts(kind))
        return self._sides[kind]

    def address(self, precision: int) -> int:
        """Return where the list of the tables of 32 or 64 bits lies."""
        return self.of(np.float32 if precision == 32 else np.float64).address

    @cached_property
    def _faces(self) -> np.ndarray:
        return np.concatenate([self.mesh.corners.reshape(-1, 9), self.mesh.face_normals], axis=1)

    @cached_property
    def _tree(self) -> Tree:
        return Tree.of(self.mesh.corners)

    def _parts(self, kind: Any) -> dict[int, np.ndarray]:
        mesh = self.mesh
        parts = {VERTICES: np.concatenate([mesh.vertices, mesh.vertex_normals()], axis=1)}
        if not len(mesh.triangles):
            return parts
        chances = np.stack(alias_table(mesh.areas), axis=1) if mesh.areas.sum() > 0 else np.zeros((0, 2))
        parts |= {FACES: self._faces, CHANCES: chances}
        low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
        skin = float(np.finfo(kind).eps) * SKIN * max(1.0, np.abs(low).max(), np.abs(high).max())
        parts[SCALE] = np.array([[skin, *low, *high]])
        if self.searched:
            tree = self._tree
            parts[BOXES] = tree.boxes + np.array([0, 0, 0, 4, 4, 4]) * skin
            parts[LINKS] = tree.links
            parts[LEAVES] = np.concatenate([self._faces[tree.order], tree.order[:, None]], axis=1)
        return parts
