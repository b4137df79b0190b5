"""From particles to streaks: the ways of a source's particles while a shutter is open, with how they look."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.particles import Particles
from graphfx.cook.paths import Lives, Window, lives_of, ways_of, with_bends
from graphfx.render.streaks import Streaks
from graphfx.render.ways import Chords, Pieces, chords_of, pieces_of, within


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
        has_bends = np.isin(rows, self.particles.bends.rows) if len(self.particles.bends.rows) else np.zeros(len(rows), bool)
        bent = rows[has_bends]
        if now and window.is_kept(instants):
            straight, _, in_pieces = self._ways(bent, True)
            rest = rows if straight.all() else rows[~np.isin(rows, bent[~straight])]
            tail = self._column(instants[-1].column, rest)
            return [(self._whole(rest, self._column("position", rest), tail), rest), *in_pieces]
        made: list[tuple[Streaks, np.ndarray]] = []
        for group, with_hits in ((rows if not len(bent) else rows[~has_bends], False), (bent, True)):
            straight, chords, in_pieces = self._ways(group, with_hits)
            whole = group if straight.all() else group[straight]
            made += [(self._whole(whole, chords.head[:, straight], chords.tail[:, straight]), whole), *in_pieces]
        return made

    def _ways(self, rows: np.ndarray, with_hits: bool) -> tuple[np.ndarray, Chords, list[tuple[Streaks, np.ndarray]]]:
        """Return which of rows have straight ways while they are seen, their chords, and the others in pieces.

        One that cannot be drawn is left whole, to be dropped and counted once.
        """
        ways = ways_of(self.particles, rows, self.window)
        if with_hits and len(rows):
            ways = with_bends(ways, self.particles.bends, rows)
        begin, end = self._begin(rows), self._end(rows)
        chords = chords_of(ways, begin, end, self._radius(rows), self.particles.store.threads)
        chords.straight[~chords.straight] = ~self._are_finite(rows[~chords.straight])
        bent = ~chords.straight
        if not bent.any():
            return chords.straight, chords, []
        ends = Chords(chords.head[:, bent], chords.tail[:, bent], chords.straight[bent])
        pieces = pieces_of(within(ways.chosen(bent), begin[bent], end[bent], ends), self.look.get("streak") == "solid")
        return chords.straight, chords, [self._in_pieces(rows[bent], pieces)]

    def _begin(self, rows: np.ndarray) -> np.ndarray:
        return np.full(len(rows), self.window.opening) if self.lives is None else self.lives.begin[rows]

    def _end(self, rows: np.ndarray) -> np.ndarray:
        return np.full(len(rows), self.window.closing) if self.lives is None else self.lives.end[rows]

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

    def _are_finite(self, rows: np.ndarray) -> np.ndarray:
        """Return which rows have looks that can be drawn."""
        finite = np.ones(len(rows), bool)
        for value in self._looks(rows).values():
            for part in value if isinstance(value, tuple) else (value,):
                finite &= np.isfinite(part)
        return finite

    def _moments(self, head: Any, tail: Any) -> dict[str, Any]:
        """Return when the ends of streaks are seen, if that matters."""
        if not self.moving or self.window.length <= 0:
            return {}
        moments = [((self.window.closing - time) / self.window.length).astype(np.float32) for time in (head, tail)]
        return {f"{end}_moment": moment for end, moment in zip(("head", "tail"), moments, strict=True)}

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
            joined=pieces.joined, **self._moments(pieces.head_time, pieces.tail_time), **self.look,
        ), whose


def way_of(shown: Shown, window: Window) -> Streaks:
    """Return where particles that were drawn still went in a window, straight from its opening to its closing."""
    rows, lives = shown.rows, lives_of(shown.particles, window)
    drawing = _Drawing(shown.particles, {}, window, lives, False)
    if not shown.particles.plan.exposure.instants:
        return drawing._whole(rows, shown.streaks.head, None)
    chords = chords_of(ways_of(shown.particles, rows, window), drawing._begin(rows), drawing._end(rows), 0.0)
    return drawing._whole(rows, chords.head, chords.tail)
