"""Read the tables of a mesh: each lane its own row, or in code that goes lane by lane one row.

A mesh that a function is given has `tables`, two-dimensional arrays, and `counts`, how many rows of each mean
something. A table is named by a whole number and a column too, both written out, so that compiled code knows them.
On the block machine a mesh is the address of a list that says where the tables lie.
"""

from __future__ import annotations

from typing import Any

__all__ = ["entry", "gather", "link", "rows", "turn"]


def gather(mesh: Any, table: int, row: Any, column: int) -> Any:
    """Entry (row, column) of a table; `row` is a lane value, and 0 stands for a row that there is not."""
    values = mesh.tables[table]
    return values[int(row) if 0 <= row < mesh.counts[table] else 0, column]


def rows(mesh: Any, table: int) -> Any:
    """The number of rows of a table, as a lane value."""
    return mesh.kind(mesh.counts[table])


def turn(identity: Any, mesh: Any, table: int) -> Any:
    """id mod rows, in whole numbers: the row of a table that falls to a particle when all take them in turn."""
    return mesh.kind(int(identity) % max(mesh.counts[table], 1))


def entry(mesh: Any, table: int, row: int, column: int) -> Any:
    """Entry (row, column) of a table, for code that goes lane by lane: `row` is a whole number that there is."""
    return mesh.tables[table][row, column]


def link(mesh: Any, table: int, row: int, column: int) -> int:
    """Entry (row, column) of a table of whole numbers, for code that goes lane by lane."""
    return int(mesh.tables[table][row, column])
