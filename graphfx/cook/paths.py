"""The ways of particles while the shutter is open: straight where that will do, in pieces where they bend.

A way goes through the places of a particle at known times: now, at the instants that are kept, at its hits; from its
birth or the shutter's opening to its end or the shutter's closing. Between them it is straight and even. It is drawn
as one streak if at all these times the straight, even way from its first place to its last is within half a radius
of it, and else as a piece from each place to the next. Where two pieces go on without a sharp turn they are joined.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphfx.cook.particles import Bends, Particles
from graphfx.plan.shutter import EDGE, Instant

NEAR = 0.5
"""Radii within which a straight way will do."""
STRAIGHT = {"exposed": 0.7, "solid": -0.9}
"""Cosine of the angle up to which a piece goes on in the next: where a way turns back, its light is seen twice, but a solid
streak is one body."""


class Window(NamedTuple):
    """The time for which a shutter is open [s], in the picture of a `frame` that shows `time`; nothing was before `start`."""

    opening: float
    closing: float
    time: float
    start: float
    fps: float

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


def lives_of(particles: Particles, window: Window) -> Lives | None:
    """Return when particles are seen; None if all are, all the time."""
    store = particles.store
    born = np.full(store.count, -np.inf)
    if particles.plan.exposure.deep:
        born[:] = store.column("birth")[0]
    elif not (len(particles.dying) or (particles.born_at > window.opening).any()):
        return None
    born[particles.born] = particles.born_at
    death = np.full(store.count, np.inf)
    death[particles.dying] = particles.ended_at
    begin, end = np.maximum(born, window.opening), np.minimum(death, window.closing)
    if window.length > 0:
        return Lives(begin, end, (end - begin) / window.length)
    return Lives(begin, end, ((born <= window.closing) & (death > window.closing)).astype(float))


@dataclass
class Ways:
    """Ways of n particles: `times` (m, n) [s], the latest first, and `places` (3, m, n)."""

    times: np.ndarray
    places: np.ndarray

    def at(self, times: np.ndarray) -> np.ndarray:
        """Return the places (3, n) at a time of each; before the first and after the last it stays where it is."""
        found = self.places[:, 0].copy()
        for k in range(1, len(self.times)):
            before = times < self.times[k - 1]
            found[:, before] = _between(self, k, times)[:, before]
        return found


def _between(ways: Ways, k: int, times: np.ndarray) -> np.ndarray:
    """Return the places at times, on the way from point k to the one after it in time."""
    late, early = ways.times[k - 1], ways.times[k]
    length = late - early
    share = np.divide(late - times, length, out=np.zeros(len(times)), where=length > 0)
    return ways.places[:, k - 1] + np.clip(share, 0.0, 1.0) * (ways.places[:, k] - ways.places[:, k - 1])


def ways_of(particles: Particles, rows: np.ndarray, window: Window) -> Ways:
    """Return the ways of rows through the instants that are kept."""
    store, exposure = particles.store, particles.plan.exposure
    last = exposure.instants[-1]
    instants = [instant for instant in exposure.instants if window.uses(instant, instant is last)]
    born, died = np.full(store.count, -np.inf), np.full(store.count, np.inf)
    if exposure.deep:
        born[:] = store.column("birth")[0]
    born[particles.born] = particles.born_at
    died[particles.dying] = particles.ended_at
    born, died = born[rows], died[rows]
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


def within(ways: Ways, begin: np.ndarray, end: np.ndarray) -> Ways:
    """Return what lies between two times of each: what is outside is moved to the nearer end."""
    head, tail = ways.at(end), ways.at(begin)
    after, before = ways.times > end, ways.times < begin
    times = np.where(after, end, np.where(before, begin, ways.times))
    places = np.where(after, head[:, None], np.where(before, tail[:, None], ways.places))
    times = np.concatenate([end[None], times, begin[None]])
    return Ways(times, np.concatenate([head[:, None], places, tail[:, None]], axis=1))


def are_straight(ways: Ways, radius: np.ndarray | float) -> np.ndarray:
    """Return which ways a straight and even one will do for."""
    head, tail = ways.places[:, :1], ways.places[:, -1:]
    length = ways.times[0] - ways.times[-1]
    share = np.divide(ways.times[0] - ways.times, length, out=np.zeros_like(ways.times), where=length > 0)
    away = ways.places - (head + share * (tail - head))
    return ~(np.sqrt((away**2).sum(axis=0)).max(axis=0) > NEAR * np.maximum(radius, 0.0))


class Pieces(NamedTuple):
    """Pieces of ways: whose they are, by place among the ways; their ends (3, n), and when these are [s]; and their joints.

    `ahead` and `behind` are the other ends of the pieces in which a piece goes on, at its head and at its tail.
    """

    owner: np.ndarray
    head: np.ndarray
    tail: np.ndarray
    head_time: np.ndarray
    tail_time: np.ndarray
    joined: np.ndarray
    ahead: np.ndarray
    behind: np.ndarray
    ahead_time: np.ndarray
    behind_time: np.ndarray

    def chosen(self, which: np.ndarray) -> Pieces:
        """Return some of them."""
        return Pieces(*(column[..., which] for column in self))


def pieces_of(ways: Ways, straight: float) -> Pieces:
    """Return the pieces of ways, those of one after another, the latest first; what takes no time is left out.

    Two go on in each other if the cosine of the angle between them is more than `straight`.
    """
    taken = ways.times[:-1] > ways.times[1:]
    owner, number = np.nonzero(taken.T)
    head, tail = ways.places[:, number, owner], ways.places[:, number + 1, owner]
    way = tail - head
    length = np.sqrt((way**2).sum(axis=0))
    follows = owner[1:] == owner[:-1]
    joint = follows & ((way[:, 1:] * way[:, :-1]).sum(axis=0) > straight * length[1:] * length[:-1])
    joint &= (length[1:] > 0) & (length[:-1] > 0)
    joined = np.zeros(len(owner), np.float32)
    joined[1:] += joint
    joined[:-1] += 2 * joint
    head_time, tail_time = ways.times[number, owner], ways.times[number + 1, owner]
    last = len(owner) - 1
    before, after = np.maximum(np.arange(last + 1) - 1, 0), np.minimum(np.arange(last + 1) + 1, last)
    return Pieces(
        owner, head, tail, head_time, tail_time, joined, head[:, before], tail[:, after], head_time[before], tail_time[after]
    )
