"""The ways of particles while the shutter is open: through their places now, at the instants that are kept, and at their hits.

A way begins at the particle's birth or the shutter's opening, and ends at its death or the shutter's closing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphfx.cook.particles import Bends, Particles
from graphfx.plan.shutter import EDGE, Instant
from graphfx.render.ways import Ways


class Window(NamedTuple):
    """The time for which a shutter is open [s], in the picture of the frame that shows `time`; nothing was before `start`.

    `begun` says whether it closes no earlier than that: else there are no particles to be seen.
    """

    opening: float
    closing: float
    time: float
    start: float
    fps: float
    begun: bool = True

    @property
    def length(self) -> float:
        """Return how long the shutter is open [s]."""
        return self.closing - self.opening

    def is_kept(self, instants: tuple[Instant, ...]) -> bool:
        """Return whether a way is one from the only instant kept, at which the shutter opens, to now."""
        opening = max(self.time - instants[-1].back / self.fps, self.start)
        return len(instants) == 1 and abs(opening - self.opening) * self.fps < 1e-6

    def uses(self, instant: Instant, last: bool) -> bool:
        """Return whether a way goes through an instant: a whole frame ago, at one of the window's ends, or the last kept."""
        ends = (self.time - self.closing, self.time - self.opening)
        whole = abs(instant.back - round(instant.back)) < EDGE
        return last or whole or any(abs(instant.back - end * self.fps) < 1e-6 for end in ends)


@dataclass
class Lives:
    """When particles are seen in a window, from `begin` to `end` [s]; `share` is the part of the shutter that is."""

    begin: np.ndarray
    end: np.ndarray
    share: np.ndarray
    """Less than or equal to 0 for those who are not seen."""


def all_seen(particles: Particles, window: Window) -> bool:
    """Return whether all are seen, all the time."""
    return not (particles.plan.exposure.deep or len(particles.dying) or particles.beginnings.any_after(window.opening))


def lives_of(particles: Particles, window: Window, rows: np.ndarray) -> Lives:
    """Return when rows are seen."""
    born, died = _lifetimes(particles, rows)
    begin, end = np.maximum(born, window.opening), np.minimum(died, window.closing)
    if window.length > 0:
        return Lives(begin, end, (end - begin) / window.length)
    return Lives(begin, end, ((born <= window.closing) & (died > window.closing)).astype(float))


def _lifetimes(particles: Particles, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return when rows were born and died [s], as far as pictures can see; -infinity and infinity beyond that."""
    born, died = particles.beginnings.of(rows), particles.endings.of(rows)
    if particles.plan.exposure.deep:
        born = np.where(born > -np.inf, born, particles.store.column("birth")[0][rows])
    return born, died


def ways_of(particles: Particles, rows: np.ndarray, window: Window) -> Ways:
    """Return the ways of rows through the instants that are kept."""
    kept = particles.plan.exposure.instants
    instants = [instant for instant in kept if window.uses(instant, instant is kept[-1])]
    born, died = _lifetimes(particles, rows)
    times, places = [np.minimum(died, window.time)], [_places(particles, "position", rows)]
    for instant in instants:
        time = np.maximum(max(window.time - instant.back / window.fps, window.start), born)
        gone = time >= times[-1]
        times.append(np.where(gone, times[-1], time))
        places.append(np.where(gone, places[-1], _places(particles, instant.column, rows)))
    return Ways(np.stack(times), np.stack(places, axis=1))


def _places(particles: Particles, name: str, rows: np.ndarray) -> np.ndarray:
    return np.stack([part[rows].astype(np.float64) for part in particles.store.column(name)])


def with_bends(ways: Ways, bends: Bends, rows: np.ndarray) -> Ways:
    """Return the ways of rows through their hits as well."""
    place = np.searchsorted(rows, bends.rows)
    which = np.flatnonzero(rows[np.minimum(place, len(rows) - 1)] == bends.rows)
    which = which[np.argsort(place[which], kind="stable")]
    place = place[which]
    counts = np.bincount(place, minlength=len(rows))
    number = np.arange(len(place)) - np.repeat(np.cumsum(counts) - counts, counts)
    most = int(counts.max(initial=0))
    times, places = np.repeat(ways.times[-1:], most, axis=0), np.repeat(ways.places[:, -1:], most, axis=1)
    times[number, place], places[:, number, place] = bends.times[which], bends.places[:, which]
    times, places = np.concatenate([ways.times, times]), np.concatenate([ways.places, places], axis=1)
    order = np.argsort(-times, axis=0, kind="stable")
    return Ways(np.take_along_axis(times, order, 0), np.take_along_axis(places, order[None], 1))
