"""Paths of several pieces: the reference's own account of where a piece goes on in the next, in float64."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .reference import Segment

TURN = {False: 0.7, True: -0.9}
"""Cosine of the sharpest turn of exposed and of solid streaks."""


def connect(stream, made, integrals) -> None:
    """Join the segments of a stream, of which some may be None or not finite; `integrals` are of its falloff."""
    bits = np.broadcast_to(np.asarray(stream.joined, np.float32), len(made)).astype(int)
    path: list[Segment] = []
    for i, segment in enumerate(made):
        visible = segment is not None and not isinstance(segment, str)
        goes_on = i + 1 < len(made) and bits[i] & 2 and bits[i + 1] & 1
        path.append(segment if visible else None)
        if not goes_on:
            _connect_path(path, integrals)
            path = []


def _connect_path(path, integrals) -> None:
    held = [_may(one, other, integrals) for one, other in pairwise(path)]
    normals = [_smooth_way(path, held, k) if may else None for k, may in enumerate(held)]
    broken = {
        joint for k in range(1, len(path) - 1) if held[k - 1] and held[k] and _crossed(path, normals, k) for joint in (k - 1, k)
    }
    joined = [may and k not in broken for k, may in enumerate(held)]
    chain: list[int] = []
    for k, segment in enumerate(path):
        chain.append(k)
        if k == len(joined) or not joined[k]:
            if segment is not None and len(chain) > 1:
                _connect_chain([path[j] for j in chain], [normals[j] for j in chain[:-1]], integrals)
            chain = []


def _may(one, other, integrals) -> bool:
    """Return whether two pieces are seen up to their joint, without too sharp a turn or too uneven a brightness."""
    if one is None or other is None or one.cut[1] < 1 or other.cut[0] > 0 or min(one.length, other.length) <= 1e-6:
        return False
    if not one.unit @ other.unit > TURN[one.solid]:
        return False
    if one.solid:
        return True
    if min(one.time, other.time) <= 0:
        return False
    radius, both = one.drawn(1.0), one.time + other.time
    across, area = integrals
    brightness = [1 / (1 + both * across / area / radius * each.speed(one.inverse_depth(1.0))) for each in (one, other)]
    return abs(brightness[0] - brightness[1]) <= 0.2


def _smooth_way(path, held, k):
    """Return the direction from the point a radius before the joint at k's tail, along the path, to that a radius after it."""
    radius = path[k].drawn(1.0)
    first, last = k, k + 1
    while first > 0 and held[first - 1]:
        first -= 1
    while last + 1 < len(path) and held[last]:
        last += 1
    run = path[first : last + 1]
    places = np.cumsum([np.zeros(2), *(each.way for each in run)], axis=0)
    lengths = np.cumsum([0.0, *(each.length for each in run)])
    there = lengths[k + 1 - first]
    after, before = (
        np.array([np.interp(there + side * radius, lengths, places[:, axis]) for axis in range(2)]) for side in (1, -1)
    )
    return (after - before) / (np.hypot(*(after - before)) or 1)


def _turned(one, other) -> float:
    """Return the angle from one direction to another."""
    return float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other))


def _crossed(path, normals, k) -> bool:
    """Return whether the planes at both ends of a piece cross within its body."""
    piece = path[k]
    radius = max(piece.drawn(0.0), piece.drawn(1.0))
    if not piece.solid:
        halves = (_turned(path[j].unit, path[j + 1].unit) / 2 for j in (k - 1, k))
        return abs(sum(np.tan(half) for half in halves)) * radius > piece.length
    turn, middle = _turned(normals[k - 1], normals[k]), normals[k - 1] + normals[k]
    forward = piece.way @ middle / np.hypot(*middle)
    return 2 * abs(np.tan(turn / 2)) * radius > forward + 0.5 * radius


def _connect_chain(chain, normals, integrals) -> None:
    """Tell the segments of a chain of each other."""
    length, time = sum(each.length for each in chain), sum(each.time for each in chain)
    light = 1.0
    if not chain[0].solid:
        across, area = integrals
        radius = sum(each.time * (each.drawn(0.0) + each.drawn(1.0)) / 2 for each in chain) / time
        paces = np.array([each.pace for each in chain])
        passed = across / area / radius * paces * length / paces.sum()
        ends = np.zeros(len(chain))
        ends[0] += 0.5
        ends[-1] += 0.5
        light = 1 / sum((passed + ends) / (1 + passed * time / [each.time for each in chain]))
    ahead = 0.0
    head, tail = chain[0], chain[-1]
    for k, each in enumerate(chain):
        each.straight = replace(
            each, head=each.head - each.unit * ahead, way=each.unit * length, radius=(head.radius[0], tail.radius[1]),
            key=(head.key[0], tail.key[1]), opacity=(head.opacity[0], tail.opacity[1]),
            confusion=(head.confusion[0], tail.confusion[1]), chain=None,
        )
        each.chain, each.light = (length, time), light
        each.planes = (normals[k - 1] if k else None, normals[k] if k < len(normals) else None)
        ahead += each.length
