"""What is rendered: the particles of one stream with their streaks, as columns."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphfx.render.falloff import FALLOFFS, Points, curve_table

Column = np.ndarray | float
Color = np.ndarray | tuple[float, float, float]
Vectors = np.ndarray | tuple[np.ndarray, ...]
"""(3, n), or three arrays of n values."""
COLUMNS = (
    "head", "tail", "head_radius", "tail_radius", "head_color", "tail_color", "head_opacity", "tail_opacity", "share", "part",
    "joined", "head_moment", "tail_moment",
)
"""The fields that hold a value of each particle, or one for all."""
BLENDS = ("over", "add")
MODES = ("exposed", "solid")


@dataclass
class Streaks:
    """The particles of one stream: each is a streak from its tail to its head.

    | field | unit | meaning |
    |---|---|---|
    | `head`, `tail` | m | positions (3, n), at the end and at the opening of the shutter; no tail: a disc |
    | `head_radius`, `tail_radius` | m | (n,) or one number for all; the tail's is the head's unless given, as below |
    | `head_color`, `tail_color` | linear RGB | (3, n) or one (r, g, b); values above 1 are allowed |
    | `head_opacity`, `tail_opacity` | 0 to 1 | at the centre |
    | `share` | 0 to 1 | the part of the shutter for which the particle lives (`exposed` only) |
    | `part` | 0 to 1 | the part of that time that this streak takes, which is a piece of the particle's whole |
    | `joined` | | 1: at its head the particle goes on in the streak before, 2: at its tail in the one after, 3: both |
    | `head_moment`, `tail_moment` | 0 to 1 | when head and tail are seen: 0 by the head camera, 1 by the tail camera |
    | `blend` | | `over`, or `add`: shines without hiding what is behind |
    | `falloff` | | how opacity falls from the centre to the edge: `linear`, `gaussian`, `disc`, or points (q, opacity) |
    | `rows` | | the numbers of those that are drawn, in their order; all if not given |
    | `streak` | | `exposed`: each point has the opacity of the time spent over it; `solid`: full opacity all along |

    Fragments of the same depth are in the order of streams and of particles within them.
    """

    head: Vectors
    tail: Vectors | None = None
    head_radius: Column = 0.01
    tail_radius: Column | None = None
    head_color: Color = (1.0, 1.0, 1.0)
    tail_color: Color | None = None
    head_opacity: Column = 1.0
    tail_opacity: Column | None = None
    share: Column = 1.0
    part: Column = 1.0
    joined: Column = 0.0
    head_moment: Column = 0.0
    tail_moment: Column = 1.0
    blend: str = "over"
    falloff: str | Points = "linear"
    streak: str = "exposed"
    rows: np.ndarray | None = None

    def __post_init__(self) -> None:
        """Refuse a name that is not known."""
        for name, known in (("blend", BLENDS), ("falloff", tuple(FALLOFFS)), ("streak", MODES)):
            if getattr(self, name) not in known and (name != "falloff" or isinstance(self.falloff, str)):
                raise ValueError(f"{name} is {getattr(self, name)!r}; it must be one of {', '.join(known)}")
        self.curve = None if isinstance(self.falloff, str) else curve_table(self.falloff)

    @property
    def given(self) -> int:
        """Return the number of particles of which columns tell."""
        return len(self.head[0])

    @property
    def count(self) -> int:
        """Return the number of particles that are drawn."""
        return self.given if self.rows is None else len(self.rows)

    @property
    def varies(self) -> bool:
        """Return whether colour or opacity may differ between head and tail."""
        return self.tail_color is not None or self.tail_opacity is not None

    @property
    def is_joined(self) -> bool:
        """Return whether any streak goes on in another."""
        return bool(np.any(self.joined))

    def path_starts(self) -> np.ndarray:
        """Return where in the order of drawn particles each path begins, and where the last ends."""
        joined = self._column(np.asarray(self.joined).reshape(-1), slice(None) if self.rows is None else self.rows)
        bits = np.broadcast_to(joined.astype(np.int64), self.count)
        alone = (bits[:-1] & 2 == 0) | (bits[1:] & 1 == 0)
        return np.concatenate([[0], np.flatnonzero(alone) + 1, [self.count]])

    def columns(self, start: int, stop: int) -> list[np.ndarray]:
        """Return the 21 columns of drawn particles start ... stop - 1 as float32, each of one value where that serves all.

        Order: head x y z, tail x y z, head and tail radius, head r g b, tail r g b, head and tail opacity, share, part,
        joined, head and tail moment.
        """
        tail = self.head if self.tail is None else self.tail
        tail_radius = self.head_radius if self.tail_radius is None else self.tail_radius
        tail_color = self.head_color if self.tail_color is None else self.tail_color
        tail_opacity = self.head_opacity if self.tail_opacity is None else self.tail_opacity
        given = [*self.head, *tail, self.head_radius, tail_radius, *self.head_color, *tail_color,
                 self.head_opacity, tail_opacity, self.share, self.part, self.joined, self.head_moment, self.tail_moment]
        rows = slice(start, stop) if self.rows is None else self.rows[start:stop]
        return [self._column(np.asarray(column).reshape(-1), rows) for column in given]

    def drawn(self) -> Streaks:
        """Return those that are drawn, in their order, as all that there are."""
        if self.rows is None:
            return self
        picked: dict[str, Any] = {"rows": None}
        for name in COLUMNS:
            value = getattr(self, name)
            if isinstance(value, np.ndarray) and value.shape == (self.given,):
                picked[name] = value[self.rows]
            elif value is not None and not isinstance(value, float) and np.shape(value)[1:] == (self.given,):
                picked[name] = np.stack([part[self.rows] for part in value])
        return replace(self, **picked)

    def _column(self, column: np.ndarray, rows: slice | np.ndarray) -> np.ndarray:
        if column.size not in (1, self.given):
            raise ValueError(f"a column holds {column.size} values for {self.given} particles")
        return np.ascontiguousarray(column if column.size == 1 else column[rows], np.float32)


def addresses(columns: list[np.ndarray]) -> np.ndarray:
    """Return (2, columns): where each column lies, and the mask of its index, -1, or 0 where one number serves all."""
    return np.array([[column.ctypes.data for column in columns], [0 if column.size == 1 else -1 for column in columns]])
