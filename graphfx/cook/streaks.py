"""From particles to streaks: the ways of a source's particles while a shutter is open, with how they look."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.particles import Particles
from graphfx.cook.paths import (
    STRAIGHT,
    Lives,
    Pieces,
    Ways,
    Window,
    are_straight,
    lives_of,
    pieces_of,
    ways_of,
    with_bends,
    within,
)
from graphfx.render.streaks import Streaks


@dataclass
class Shown:
    """Streaks, and whose they are: the row of each streak, and the number of the picture's stream."""

    streaks: Streaks
    particles: Particles
    rows: np.ndarray
    stream: int


def streaks_of(
    particles: Particles, selected: np.ndarray | None, look: dict[str, Any], window: Window, moving: bool, stream: int = 0
) -> list[Shown]:
    """Return the streaks of particles, or of the selected rows: straight ones, and those in pieces.

    `moving` says that the camera does not stand still, so that the streaks must tell their times.
    """
    lives = lives_of(particles, window)
    drawing = _Drawing(particles, look, window, lives, moving)
    rows = drawing.everyone if selected is None else selected
    if lives is not None:
        rows = rows[lives.share[rows] > 0]
    with np.errstate(invalid="ignore", over="ignore"):
        made = drawing.streaks(rows)
    return [Shown(streaks, particles, whose, stream) for streaks, whose in made]


@dataclass
class _Drawing:
    """The streaks of one source's particles in the making."""

    particles: Particles
    look: dict[str, Any]
    window: Window
    lives: Lives | None
    moving: bool
    everyone: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        """Number the rows."""
        self.everyone = np.arange(self.particles.store.count)

    def streaks(self, rows: np.ndarray) -> list[tuple[Streaks, np.ndarray]]:
        """Return streaks with the rows that they are of."""
        instants, window = self.particles.plan.exposure.instants, self.window
        now = window.closing >= window.time
        if not instants or (now and window.length <= 0):
            return [(self._whole(rows, self._column("position", rows), None), rows)]
        kept = now and window.is_kept(instants)
        bent = rows[np.isin(rows, self.particles.bends.rows)] if kept else rows
        ways = self._ways(bent)
        straight = are_straight(ways, self._radius(bent))
        if kept:
            plain = rows if straight.all() else rows[~np.isin(rows, bent[~straight])]
            made = [(self._whole(plain, self._column("position", plain), self._column(instants[-1].column, plain)), plain)]
        else:
            ends = [ways.places[:, end][:, straight] for end in (0, -1)]
            made = [(self._whole(bent[straight], *ends), bent[straight])]
        if straight.all():
            return made
        pieces = pieces_of(
            Ways(ways.times[:, ~straight], ways.places[:, :, ~straight]), STRAIGHT[self.look.get("streak", "exposed")]
        )
        return [*made, self._in_pieces(bent[~straight], self._seen(pieces))]

    def _ways(self, rows: np.ndarray) -> Ways:
        """Return the ways of rows while they are seen."""
        ways = ways_of(self.particles, rows, self.window)
        if len(self.particles.bends.rows) and len(rows):
            ways = with_bends(ways, self.particles.bends, rows)
        begin, end = self._begin(rows), self._end(rows)
        return within(ways, begin, end)

    def _begin(self, rows: np.ndarray) -> np.ndarray:
        return np.full(len(rows), self.window.opening) if self.lives is None else self.lives.begin[rows]

    def _end(self, rows: np.ndarray) -> np.ndarray:
        return np.full(len(rows), self.window.closing) if self.lives is None else self.lives.end[rows]

    def _seen(self, pieces: Pieces) -> Pieces:
        """Return the pieces that are seen: a stop on the way of a solid streak is within its caps."""
        if self.look.get("streak") != "solid":
            return pieces
        moves = (pieces.head != pieces.tail).any(axis=0)
        return pieces.chosen(moves | ~np.isin(pieces.owner, pieces.owner[moves]))

    def _column(self, name: str, rows: np.ndarray) -> Any:
        """Return an attribute of rows, or what it is for all."""
        store = self.particles.store
        if name not in store.columns:
            value = self.particles.value(name)
            return np.repeat(np.array(value, np.float32)[:, None], len(rows), axis=1) if name == "position" else value
        arrays = store.column(name)
        if rows is not self.everyone:
            arrays = tuple(array[rows] for array in arrays)
        return arrays if len(arrays) == 3 else arrays[0]

    def _radius(self, rows: np.ndarray) -> Any:
        return self._column("radius", rows) if self.particles.has("radius") else 0.0

    def _looks(self, rows: np.ndarray) -> dict[str, Any]:
        """Return how rows look at their heads and tails; what is the same at both is left out of the tails."""
        heads = {"radius": self._radius(rows), "color": self._column("color", rows), "opacity": self._column("opacity", rows)}
        tails = {name: self._column(f"tail.{name}", rows) for name in heads if f"tail.{name}" in self.particles.store.columns}
        return {f"head_{name}": value for name, value in heads.items()} | {f"tail_{name}": value for name, value in tails.items()}

    def _moments(self, head: Any, tail: Any, ends: tuple[str, str] = ("head", "tail")) -> dict[str, Any]:
        """Return when the ends of streaks are seen, if that matters."""
        if not self.moving or self.window.length <= 0:
            return {}
        moments = [((self.window.closing - time) / self.window.length).astype(np.float32) for time in (head, tail)]
        return {f"{end}_moment": moment for end, moment in zip(ends, moments, strict=True)}

    def _share(self, rows: np.ndarray) -> Any:
        return 1.0 if self.lives is None else self.lives.share[rows].astype(np.float32)

    def _whole(self, rows: np.ndarray, head: Any, tail: Any) -> Streaks:
        moments = {} if self.lives is None else self._moments(self.lives.end[rows], self.lives.begin[rows])
        return Streaks(head=head, tail=tail, **self._looks(rows), share=self._share(rows), **moments, **self.look)

    def _in_pieces(self, rows: np.ndarray, pieces: Pieces) -> tuple[Streaks, np.ndarray]:
        """Return pieces as streaks; what differs between head and tail of a way is even in time along it."""
        whose = rows[pieces.owner]
        begin, end = self._begin(whose), self._end(whose)
        length = end - begin
        looks = self._looks(whose)
        for name in ("radius", "color", "opacity"):
            if f"tail_{name}" in looks:
                first, last = np.asarray(looks[f"head_{name}"]), np.asarray(looks[f"tail_{name}"])
                if name == "color" and first.ndim == 1:
                    first = first[:, None]
                for side, time in (("head", pieces.head_time), ("tail", pieces.tail_time)):
                    looks[f"{side}_{name}"] = (first + (end - time) / length * (last - first)).astype(np.float32)
        part = (pieces.head_time - pieces.tail_time) / length
        return Streaks(
            head=pieces.head, tail=pieces.tail, **looks, share=self._share(whose), part=part.astype(np.float32),
            joined=pieces.joined, ahead=pieces.ahead, behind=pieces.behind,
            **self._moments(pieces.head_time, pieces.tail_time),
            **self._moments(pieces.ahead_time, pieces.behind_time, ("ahead", "behind")), **self.look,
        ), whose


def way_of(shown: Shown, window: Window) -> Streaks:
    """Return where particles that were drawn still went in a window, straight from its opening to its closing."""
    lives = lives_of(shown.particles, window)
    drawing = _Drawing(shown.particles, {}, window, lives, False)
    if not shown.particles.plan.exposure.instants:
        return drawing._whole(shown.rows, shown.streaks.head, None)
    ways = drawing._ways(shown.rows)
    return drawing._whole(shown.rows, ways.places[:, 0], ways.places[:, -1])
