"""Ways of particles through known places: straight where that will do, in pieces where they bend.

Between its places a way is straight and even in time. It is drawn as one streak, its chord, if at all these times the
straight and even way from its first place to its last is within half a radius of it; and else as a piece from each place
to the next.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.store.threads import parallel_ranges, ranges

NEAR = 0.5
"""Radii within which a straight way will do."""
GRAIN = 4096
"""Fewest ways worth a thread of their own."""


@dataclass
class Ways:
    """Ways of n particles: `times` (m, n) [s], the latest first, and `places` (3, m, n)."""

    times: np.ndarray
    places: np.ndarray

    def chosen(self, which: np.ndarray) -> Ways:
        """Return some of them."""
        return Ways(self.times[:, which], self.places[:, :, which])


class Chords(NamedTuple):
    """The straight ways from where particles are at first to where they are at last: (3, n), and whether those will do."""

    head: np.ndarray
    tail: np.ndarray
    straight: np.ndarray


def chords_of(ways: Ways, begin: np.ndarray, end: np.ndarray, radius: np.ndarray | float, threads: int = 1) -> Chords:
    """Return where ways are at the times `begin` and `end` of each; `radius` [m] says what is straight enough."""
    count = len(begin)
    made = Chords(np.empty((3, count)), np.empty((3, count)), np.empty(count, np.bool_))
    radii = np.atleast_1d(np.asarray(radius, np.float64))
    bounds = ranges(count, threads, GRAIN)

    def work(_: int, start: int, stop: int) -> None:
        _chords(ways.times, ways.places, begin, end, radii, start, stop, made)

    parallel_ranges(work, bounds, threads)
    return made


@compiled
def _chords(times, places, begin, end, radii, start, stop, made):
    """Find the chords of ways start ... stop - 1."""
    for i in range(start, stop):
        _put(times, places, i, end[i], made.head)
        _put(times, places, i, begin[i], made.tail)
        near = NEAR * max(radii[i if len(radii) > 1 else 0], 0.0)
        farthest, length = 0.0, end[i] - begin[i]
        for k in range(len(times)):
            if begin[i] < times[k, i] < end[i]:
                share, away = (end[i] - times[k, i]) / length, 0.0
                for c in range(3):
                    there = made.head[c, i] + share * (made.tail[c, i] - made.head[c, i])
                    away += (places[c, k, i] - there) ** 2
                farthest = max(farthest, away)
        made.straight[i] = not farthest > near * near


@compiled
def _put(times, places, i, time, found):
    """Put the place of way i at a time; before the first and after the last it stays where it is."""
    k = 0
    while k + 1 < len(times) and time < times[k, i]:
        k += 1
    for c in range(3):
        found[c, i] = places[c, k, i]
        if k > 0 and time > times[k, i]:
            share = (times[k - 1, i] - time) / (times[k - 1, i] - times[k, i])
            found[c, i] = places[c, k - 1, i] + share * (places[c, k, i] - places[c, k - 1, i])


def within(ways: Ways, begin: np.ndarray, end: np.ndarray, chords: Chords) -> Ways:
    """Return what lies between two times of each: what is outside is moved to the nearer end."""
    after, before = ways.times > end, ways.times < begin
    head, tail = chords.head[:, None], chords.tail[:, None]
    times = np.where(after, end, np.where(before, begin, ways.times))
    places = np.where(after, head, np.where(before, tail, ways.places))
    return Ways(np.concatenate([end[None], times, begin[None]]), np.concatenate([head, places, tail], axis=1))


class Pieces(NamedTuple):
    """Pieces of ways: whose they are, by place among the ways; their ends (3, n), when these are [s], and where they go on."""

    owner: np.ndarray
    head: np.ndarray
    tail: np.ndarray
    head_time: np.ndarray
    tail_time: np.ndarray
    joined: np.ndarray


def pieces_of(ways: Ways, solid: bool) -> Pieces:
    """Return the pieces of ways, those of one after another, the latest first; what takes no time is left out.

    So are stops on a solid way: they are within it.
    """
    taken = ways.times[:-1] > ways.times[1:]
    if solid:
        moving = taken & (ways.places[:, :-1] != ways.places[:, 1:]).any(axis=0)
        taken = np.where(moving.any(axis=0), moving, taken)
    owner, number = np.nonzero(taken.T)
    follows = owner[1:] == owner[:-1]
    joined = np.zeros(len(owner), np.float32)
    joined[1:] += follows
    joined[:-1] += 2 * follows
    head, tail = ways.places[:, number, owner], ways.places[:, number + 1, owner]
    return Pieces(owner, head, tail, ways.times[number, owner], ways.times[number + 1, owner], joined)
