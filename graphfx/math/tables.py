"""Read the tables of a mesh: each lane its own row, or in code that goes lane by lane one row.

A mesh that a function is given has `tables`, two-dimensional arrays, and `counts`, how many rows of each mean
something. A table is named by what `table_name` gives, and a column by its number, both written out, so that compiled
code knows them and how long a row is. On the block machine a mesh is the address of a list that says where the tables lie.
"""

from __future__ import annotations

from typing import Any

__all__ = ["entry", "gather", "link", "rows", "table_name", "turn"]


def table_name(number: int, columns: int) -> int:
    """The name of a table: its place in the list, and the columns of a row, of 63 at most."""
    return number * 64 + columns


def gather(mesh: Any, table: int, row: Any, column: int) -> Any:
    """Entry (row, column) of a table; `row` is a lane value, and 0 stands for a row that there is not."""
    values = mesh.tables[table >> 6]
    return values[int(row) if 0 <= row < mesh.counts[table >> 6] else 0, column]


def rows(mesh: Any, table: int) -> Any:
    """The number of rows of a table, as a lane value."""
    return mesh.kind(mesh.counts[table >> 6])


def turn(identity: Any, mesh: Any, table: int) -> Any:
    """id mod rows, in whole numbers: the row of a table that falls to a particle when all take them in turn."""
    return mesh.kind(int(identity) % max(mesh.counts[table >> 6], 1))


def entry(mesh: Any, table: int, row: int, column: int) -> Any:
    """Entry (row, column) of a table, for code that goes lane by lane: `row` is a whole number that there is."""
    return mesh.tables[table >> 6][row, column]


def link(mesh: Any, table: int, row: int, column: int) -> int:
    """The bits of entry (row, column) as a whole number, for code that goes lane by lane."""
    return int(mesh.words[table >> 6][row, column])
