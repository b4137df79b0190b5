"""Processor sets: one "virtual processor" per particle, its state in columns. [Sims 1990, section 2]

A column is one to three arrays (structure of arrays), each as long as the set's capacity, which is
a multiple of the block of 256 rows. Rows from `count` to `capacity` are padding and hold zeros
whenever `allocate`, `duplicate` or `compact` return, so that whole blocks can be computed harmlessly.
One thread at a time may change a set's rows.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.errors import LimitError
from graphfx.lanes.compile import compiled
from graphfx.store.growable import GrowableArray
from graphfx.store.primitives import GRAIN, UNSIGNED, gather, partition
from graphfx.store.threads import parallel

BLOCK = 256
"""Rows that are computed together."""
PIECE = 1 << 18
"""Rows that are looked at together where each takes memory for a while."""
GROWTH = 32
"""Spare room is 1/32 of the rows, plus up to a block: memory stays within 5 % of what the rows take."""

_ARRAYS = {"float": 1, "vec3": 3, "color": 3, "mask": 1, "id": 1, "time": 1, "count": 1}
_TYPES: dict[str, Any] = {"mask": np.uint8, "id": np.uint64, "time": np.float64, "count": np.int32}
_REALS: dict[int, Any] = {32: np.float32, 64: np.float64}


@dataclass(frozen=True)
class Column:
    """One typed column; new rows hold `default` (three numbers, or one for all three, for vec3 and color).

    float: a real of the set's precision. vec3, color: three of them. mask: uint8, 0 or 1.
    id: uint64. time: float64 seconds. count: int32.
    """

    type: str
    default: float | tuple[float, float, float] = 0

    def __post_init__(self) -> None:
        """Check the type and the number of defaults."""
        if self.type not in _ARRAYS:
            raise ValueError(f"no column type '{self.type}'; there are {', '.join(_ARRAYS)}")
        if isinstance(self.default, tuple) and len(self.default) != _ARRAYS[self.type]:
            raise ValueError(f"a {self.type} column takes {_ARRAYS[self.type]} numbers, not {self.default}")

    def dtype(self, precision: int) -> np.dtype:
        """Return the type of the column's arrays in a set of 32-bit or 64-bit reals."""
        return np.dtype(_TYPES.get(self.type, _REALS[precision]))

    def defaults(self) -> tuple[float, ...]:
        """Return the default of each array."""
        return self.default if isinstance(self.default, tuple) else (self.default,) * _ARRAYS[self.type]


@compiled
def _move_down(values: Any, rows: Any, first: int) -> None:
    """Set values[first + i] = values[rows[i]] in place; `rows` ascend and are not before `first`."""
    for i in range(len(rows)):
        values[np.uint64(first + i)] = values[np.uint64(rows[i])]


class ProcessorSet:
    """Rows of named columns; rows are added at the end, marked dead, and closed up in order.

    Arrays handed out are views: take them anew after anything that adds or removes rows. A view
    kept longer stays readable, but shows old state and makes the next growth copy its array.
    """

    def __init__(
        self,
        columns: Mapping[str, Column],
        precision: int = 32,
        limit_rows: int | None = None,
        threads: int = 1,
    ) -> None:
        """Make an empty set; no memory is taken before there are rows."""
        if precision not in _REALS:
            raise ValueError(f"precision is {precision}; it can be 32 or 64")
        self.columns = dict(columns)
        self.precision = precision
        self.limit_rows = limit_rows
        self.threads = threads
        self.count = 0
        self.capacity = 0
        self.next_ordinal = 0
        """The number of the next birth; never goes back, so that ids are never used again."""
        self._arrays = {
            name: [GrowableArray(column.dtype(precision)) for _ in column.defaults()]
            for name, column in self.columns.items()
        }
        self._dead: np.ndarray | None = None
        """Which of the rows that there were at the last kill are dead; None when none are."""

    def __len__(self) -> int:
        """Return the number of rows."""
        return self.count

    @property
    def bytes_by_column(self) -> dict[str, int]:
        """Bytes that a row takes in each column."""
        return {name: sum(array.dtype.itemsize for array in arrays) for name, arrays in self._arrays.items()}

    @property
    def bytes_per_row(self) -> int:
        """Bytes that a row takes."""
        return sum(self.bytes_by_column.values())

    def arrays(self, name: str) -> tuple[np.ndarray, ...]:
        """Return views of a column's arrays up to the capacity, padding included."""
        return tuple(growable.array[:] for growable in self._arrays[name])

    def column(self, name: str) -> tuple[np.ndarray, ...]:
        """Return views of a column's arrays without the padding."""
        return tuple(growable.array[: self.count] for growable in self._arrays[name])

    def take_ordinals(self, n: int) -> int:
        """Return the first of n birth numbers that nobody had before."""
        if n < 0:
            raise ValueError(f"cannot number {n} births")
        self.next_ordinal += n
        return self.next_ordinal - n

    def allocate(self, n: int) -> slice:
        """Add n rows that hold the columns' defaults; return where they are.

        Raises LimitError, and changes nothing, when the set would pass its limit.
        """
        added = self._make_rows(n)
        for name, column in self.columns.items():
            for growable, default in zip(self._arrays[name], column.defaults(), strict=True):
                if default != 0:
                    growable.array[added] = default
        return added

    def duplicate(self, rows: np.ndarray) -> slice:
        """Add a copy of each of the given rows, in their order; return where the copies are.

        A row may be given many times. Copies of dead rows live.
        """
        rows = np.asarray(rows)
        self._check_rows(rows)
        added = self._make_rows(len(rows))
        for growable in self._growables():
            gather(growable.array[: added.start], rows, out=growable.array[added], threads=self.threads)
        return added

    def kill(self, selected: np.ndarray) -> None:
        """Mark rows dead, for `compact` to remove: a mask (bool or uint8, one per row) or row numbers."""
        selected = np.asarray(selected)
        is_mask = selected.dtype in (np.bool_, np.uint8)
        if is_mask and len(selected) != self.count:
            raise ValueError(f"the mask has {len(selected)} rows, and the set {self.count}")
        if not is_mask:
            self._check_rows(selected)
        if not selected.any() if is_mask else not len(selected):
            return
        dead = np.zeros(self.count, np.bool_)
        if self._dead is not None:
            dead[: len(self._dead)] = self._dead
        dead[selected != 0 if is_mask else selected] = True
        self._dead = dead

    def compact(self) -> int:
        """Remove the dead rows, keeping the others in order; return how many there were.

        Nothing before the first dead row moves. Memory is given back when over a quarter is unused.
        """
        if self._dead is None:
            return 0
        at, growables = int(self._dead.argmax()), self._growables()
        for start in range(at, self.count, PIECE):
            alive = np.ones(min(PIECE, self.count - start), np.bool_)
            dead = self._dead[start : start + PIECE]
            np.logical_not(dead, out=alive[: len(dead)])
            rows = partition(alive) + start
            self._move(growables, rows, at)
            at += len(rows)
        for growable in growables:
            growable.array[at : self.count] = 0
        removed = self.count - at
        self.count -= removed
        self._dead = None
        if 4 * self.count < 3 * self.capacity:
            self._resize(self.count)
        return removed

    def _move(self, growables: list[GrowableArray], rows: np.ndarray, at: int) -> None:
        def move(piece: int) -> None:
            array = growables[piece].array
            _move_down(array.view(UNSIGNED[array.dtype.itemsize]), rows, at)

        parallel(move, len(growables), self.threads if len(rows) >= GRAIN else 1)

    def _growables(self) -> list[GrowableArray]:
        return [growable for arrays in self._arrays.values() for growable in arrays]

    def _check_rows(self, rows: np.ndarray) -> None:
        if len(rows) and (rows.min() < 0 or rows.max() >= self.count):
            asked = f"{rows.min()} to {rows.max()}"
            raise IndexError(f"rows {asked} are asked for, and there are 0 to {self.count - 1}")

    def _make_rows(self, n: int) -> slice:
        if n < 0:
            raise ValueError(f"cannot add {n} rows")
        needed = self.count + n
        if self.limit_rows is not None and needed > self.limit_rows:
            raise LimitError(
                f"there would be {needed:,} particles, and the limit is {self.limit_rows:,}: "
                "raise the limit, or make fewer (rate, life, count)"
            )
        if needed > self.capacity:
            self._resize(needed)
        added = slice(self.count, needed)
        self.count = needed
        return added

    def _resize(self, rows: int) -> None:
        """Set the capacity to `rows` and 1/32 more, in whole blocks."""
        capacity = -(-(rows + rows // GROWTH) // BLOCK) * BLOCK
        for growable in self._growables():
            growable.resize(capacity)
        self.capacity = capacity
