"""The slopes of a spline through points: Catmull and Rom's cubic where the points are not evenly spaced."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

Point = Any
"""A number, or a tuple of numbers."""


def slopes(positions: Sequence[float], values: Sequence[Point]) -> list[Point]:
    """Return the slope of the spline at each point: that of the parabola through it and its neighbours.

        m = (d0 h1 + d1 h0) / (h0 + h1),    d = (v1 - v0) / h,  h = x1 - x0

    d0 and h0 are those of the interval before the point, d1 and h1 those of the one after it. The first and the last
    point have the slope of their only interval. [Catmull and Rom 1974; de Boor 1978, IV]
    """
    if isinstance(values[0], tuple):
        parts = [slopes(positions, component) for component in zip(*values, strict=True)]
        return list(zip(*parts, strict=True))
    steps = [x1 - x0 for x0, x1 in pairwise(positions)]
    rises = [(v1 - v0) / h for (v0, v1), h in zip(pairwise(values), steps, strict=True)]
    if not rises:
        return [0.0]
    inner = [(d0 * h1 + d1 * h0) / (h0 + h1) for (d0, d1), (h0, h1) in zip(pairwise(rises), pairwise(steps), strict=True)]
    return [rises[0], *inner, rises[-1]]
