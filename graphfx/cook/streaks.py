"""From particles to streaks: the ways of a source's particles while a shutter is open, with how they look."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.cook.beginnings import numbers_of
from graphfx.cook.moments import pieces
from graphfx.cook.particles import Bends, Particles, flagged
from graphfx.cook.paths import Lives, Window, all_seen, lives_of, ways_of, with_bends
from graphfx.render.streaks import Streaks
from graphfx.render.ways import Chords, Pieces, chords_of, pieces_of, within


@dataclass
class Shown:
    """Streaks, and whose they are: some of the rows from `first` on; `owners` if not all, or those that the streaks pick.

    `stream` is the number of the picture's stream.
    """

    streaks: Streaks
    owners: np.ndarray | None
    particles: Particles
    first: int
    stream: int

    @property
    def rows(self) -> range | np.ndarray:
        """Return the row of each streak that is drawn."""
        if self.owners is not None:
            return self.owners
        chosen = self.streaks.rows
        return range(self.first, self.first + self.streaks.given) if chosen is None else self.first + chosen.astype(np.int64)


def streaks_of(
    particles: Particles, selected: np.ndarray | None, look: dict[str, Any], window: Window, moving: bool, stream: int = 0
) -> list[Shown]:
    """Return the streaks of particles, or of those selected, of which each row tells: straight ones, and those in pieces.

    `moving` says that the camera does not stand still, so that the streaks must tell their times. Some rows after others
    are looked at, and what is known of all of them is not copied.
    """
    made: list[list[Made]] = []
    starts: list[int] = []
    seen, bends = all_seen(particles, window), particles.bends.by_row()
    for start, stop in pieces(0, particles.store.count):
        lives = None if seen else _partial(lives_of(particles, window, np.arange(start, stop)), window)
        drawing = _Drawing(particles, look, window, moving, start, stop, bends.between(start, stop), lives)
        starts.append(start)
        with np.errstate(invalid="ignore", over="ignore"):
            made.append(drawing.made(None if selected is None else selected[start:stop]))
    return [
        Shown(streaks, owners, particles, start, stream)
        for step in zip(*made, strict=True) for start, some in zip(starts, step, strict=True) for streaks, owners in some
    ]


def _partial(lives: Lives, window: Window) -> Lives | None:
    """Return when some are seen, or None if all are, all the time."""
    whole = (lives.share == 1) & (lives.begin == window.opening) & (lives.end == window.closing)
    return None if whole.all() else lives


Made = list[tuple[Streaks, np.ndarray | None]]


@dataclass
class _Drawing:
    """The streaks of some rows of a source, start ... stop - 1, in the making."""

    particles: Particles
    look: dict[str, Any]
    window: Window
    moving: bool
    start: int
    stop: int
    bends: Bends
    lives: Lives | None

    def made(self, selected: np.ndarray | None) -> list[Made]:
        """Return streaks with the rows that they are of, in steps: what a step makes of any rows is before all of the next."""
        everyone = np.arange(self.start, self.stop)
        shown = np.ones(len(everyone), bool) if selected is None else selected.astype(bool)
        if self.lives is not None:
            shown &= self.lives.share > 0
        instants, window = self.particles.plan.exposure.instants, self.window
        now = window.closing >= window.time
        if not instants or (now and window.length <= 0):
            return [[self._as_stored(shown, None)]]
        has_bends = flagged(self.bends.rows - self.start, len(everyone))
        bent = everyone[shown & has_bends]
        if now and window.is_kept(instants):
            straight, _, in_pieces = self._ways(bent, True)
            shown[bent[~straight] - self.start] = False
            return [[self._as_stored(shown, instants[-1].column)], in_pieces]
        made: list[Made] = []
        for group, with_hits in ((everyone[shown & ~has_bends], False), (bent, True)):
            straight, chords, in_pieces = self._ways(group, with_hits)
            whole = group if straight.all() else group[straight]
            made += [[(self._whole(whole, chords.head[:, straight], chords.tail[:, straight]), whole)], in_pieces]
        return made

    def _ways(self, rows: np.ndarray, with_hits: bool) -> tuple[np.ndarray, Chords, Made]:
        """Return which of rows have straight ways while they are seen, their chords, and the others in pieces.

        One that cannot be drawn is left whole, to be dropped and counted once.
        """
        ways = ways_of(self.particles, rows, self.window)
        if with_hits and len(rows):
            ways = with_bends(ways, self.bends, rows)
        begin, end = self._begin(rows), self._end(rows)
        chords = chords_of(ways, begin, end, self._radius(rows), self.particles.store.threads)
        chords.straight[~chords.straight] = ~self._are_finite(rows[~chords.straight])
        bent = ~chords.straight
        if not bent.any():
            return chords.straight, chords, []
        ends = Chords(chords.head[:, bent], chords.tail[:, bent], chords.straight[bent])
        bits = pieces_of(within(ways.chosen(bent), begin[bent], end[bent], ends), self.look.get("streak") == "solid")
        return chords.straight, chords, [self._in_pieces(rows[bent], bits)]

    def _begin(self, rows: np.ndarray) -> np.ndarray:
        return np.full(len(rows), self.window.opening) if self.lives is None else self.lives.begin[rows - self.start]

    def _end(self, rows: np.ndarray) -> np.ndarray:
        return np.full(len(rows), self.window.closing) if self.lives is None else self.lives.end[rows - self.start]

    def _column(self, name: str, rows: slice | np.ndarray) -> Any:
        """Return an attribute of rows, or what it is for all; where rows follow one another, as it is stored."""
        store = self.particles.store
        if name not in store.columns:
            value = self.particles.value(name)
            count = rows.stop - rows.start if isinstance(rows, slice) else len(rows)
            return np.broadcast_to(np.array(value, np.float32)[:, None], (3, count)) if name == "position" else value
        arrays = tuple(array[rows] for array in store.column(name))
        return arrays if len(arrays) == 3 else arrays[0]

    def _radius(self, rows: slice | np.ndarray) -> Any:
        return self._column("radius", rows) if self.particles.has("radius") else 0.0

    def _looks(self, rows: slice | np.ndarray) -> dict[str, Any]:
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

    def _lived(self, rows: slice | np.ndarray) -> dict[str, Any]:
        """Return for how much of the shutter rows, counted from the first at hand, are seen, and when, if that matters."""
        if self.lives is None:
            return {}
        moments = self._moments(self.lives.end[rows], self.lives.begin[rows])
        return {"share": self.lives.share[rows].astype(np.float32), **moments}

    def _as_stored(self, shown: np.ndarray, tail: str | None) -> tuple[Streaks, None]:
        """Return streaks from a column of tails to where particles are, without a copy of what is stored."""
        rows, own = slice(self.start, self.stop), slice(0, self.stop - self.start)
        chosen = None if shown.all() else np.flatnonzero(shown).astype(np.int32)
        head, end = self._column("position", rows), None if tail is None else self._column(tail, rows)
        return Streaks(head=head, tail=end, **self._looks(rows), **self._lived(own), **self.look, rows=chosen), None

    def _whole(self, rows: np.ndarray, head: Any, tail: Any) -> Streaks:
        return Streaks(head=head, tail=tail, **self._looks(rows), **self._lived(rows - self.start), **self.look)

    def _share(self, rows: np.ndarray) -> Any:
        return 1.0 if self.lives is None else self.lives.share[rows - self.start].astype(np.float32)

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
    particles, rows, start = shown.particles, numbers_of(shown.rows), shown.first
    stop = start + shown.streaks.given
    lives = None if all_seen(particles, window) else lives_of(particles, window, np.arange(start, stop))
    drawing = _Drawing(particles, {}, window, False, start, stop, Bends(), lives)
    if not particles.plan.exposure.instants:
        return drawing._whole(rows, shown.streaks.drawn().head, None)
    chords = chords_of(ways_of(particles, rows, window), drawing._begin(rows), drawing._end(rows), 0.0)
    return drawing._whole(rows, chords.head, chords.tail)
