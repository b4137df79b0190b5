"""The tables of a mesh: what functions of particles read of it, in single or double precision."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from graphfx.geometry.areas import alias_table
from graphfx.geometry.mesh import Mesh
from graphfx.geometry.tree import Tree
from graphfx.math.tables import table_name

VERTICES, FACES, CHANCES = table_name(0, 6), table_name(1, 12), table_name(2, 2)
BOXES, LEAVES, SCALE = table_name(3, 8), table_name(4, 16), table_name(5, 8)
"""Tables with their columns: position and normal of a vertex; corners and normal of a face; chance of a face and the
other (see `areas`); center and half size of a box of the tree, and as whole numbers where to go on past it, and its
first leaf times 8 plus their number; the tree's faces as in FACES; the skin, the least and the greatest corner."""
TABLES = (VERTICES, FACES, CHANCES, BOXES, LEAVES, SCALE)
LINE = 64
"""Bytes of a line of the processor's cache: a box and a face lie in one."""
SKIN = 64
"""The thickness of a surface in units in the last place of its greatest coordinate (1 m at least). A particle is kept
this far from a mesh, so that rounding, an eighth of it and less, takes none through."""


class Side:
    """The tables in one precision, as plain Python reads them; `address` is what compiled code does."""

    def __init__(self, kind: Any, parts: dict[int, np.ndarray], links: np.ndarray):
        """Round `parts` to `kind`; tables that are not there are one row of zeros. `links` are the whole numbers of BOXES."""
        self.kind = kind
        self.counts = [len(parts.get(table, ())) for table in TABLES]
        self.tables = [_aligned(max(count, 1), table & 63, kind) for table, count in zip(TABLES, self.counts, strict=True)]
        self.words = [table.view(np.int32 if kind is np.float32 else np.int64) for table in self.tables]
        for table, values in parts.items():
            self.tables[table >> 6][:, : values.shape[1]] = values
        self.words[BOXES >> 6][: len(links), 6:] = links
        lines = [(array.ctypes.data, count) for array, count in zip(self.tables, self.counts, strict=True)]
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
            links = self._tree.links if self.searched and len(self.mesh.triangles) else np.zeros((0, 3), np.int32)
            self._sides[kind] = Side(kind, self._parts(kind), np.stack([links[:, 0], links[:, 1] * 8 + links[:, 2]], axis=1))
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
            parts |= {BOXES: tree.boxes + np.array([0, 0, 0, 4, 4, 4]) * skin, LEAVES: self._faces[tree.order]}
        return parts


def _aligned(rows: int, columns: int, kind: Any) -> np.ndarray:
    """Return zeros that begin at a line of the cache."""
    size = rows * columns * np.dtype(kind).itemsize
    room = np.zeros(size + LINE, np.uint8)
    begin = -room.ctypes.data % LINE
    return room[begin : begin + size].view(kind).reshape(rows, columns)
