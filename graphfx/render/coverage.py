"""Which of a pixel's sixteen samples a triangle covers.

    sample i lies at ((i + 1/2) / 16, (r(i) + 1/2) / 16) in its pixel      r: the four bits of i in reverse order

each row, column, and 4 x 4, 2 x 8, 8 x 2 part of the pixel holds its share of them [Hammersley 1960]. For the corners
a, b of an edge, a the one with the lesser x, then the lesser y, the pixel's corner p and the sample's offset o,

    E = (dx (p.y - a.y) - dy (p.x - a.x)) + (dx o.y - dy o.x),     (dx, dy) = b - a,     in float64

tells the side: E >= 0 or E < 0. Both triangles of an edge compute the same E, so each sample is in just one of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from graphfx.lanes import load, mask_bits
from graphfx.lanes.inner import inner
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH

SAMPLES = 16
SAMPLE_X = np.array([(i + 0.5) / SAMPLES for i in range(SAMPLES)])
SAMPLE_Y = np.array([(int(f"{i:04b}"[::-1], 2) + 0.5) / SAMPLES for i in range(SAMPLES)])
ALL = 0xFFFF


class Edge(NamedTuple):
    """An edge from its first corner; `inside` says that E >= 0 is inside; all offsets of samples lie in low ... high."""

    x: np.float64
    y: np.float64
    dx: np.float64
    dy: np.float64
    inside: bool
    low: np.float64
    high: np.float64


@inner
def edge_between(x0, y0, x1, y1, turn, offsets, at):
    """Return the edge of a triangle that turns so, and write dx o.y - dy o.x of the samples to offsets[at:]."""
    swapped = x1 < x0 or (x1 == x0 and y1 < y0)
    x, y = (x1, y1) if swapped else (x0, y0)
    dx, dy = (x0 - x, y0 - y) if swapped else (x1 - x, y1 - y)
    low, high = np.inf, -np.inf
    for i in range(SAMPLES):
        value = dx * SAMPLE_Y[i] - dy * SAMPLE_X[i]
        offsets[at + i] = value
        low, high = min(low, value), max(high, value)
    return Edge(x, y, dx, dy, (turn > 0.0) != swapped, low, high)


@inner
def at_pixel(edge, x, y):
    """Return E at the pixel's corner."""
    return edge.dx * (y - edge.y) - edge.dy * (x - edge.x)


@inner
def contains_tile(edge, left, top):
    """Return whether all samples of a tile are inside: E is monotonous along rows and columns, rounding included."""
    right, bottom = left + (TILE_WIDTH - 1), top + (TILE_HEIGHT - 1)
    a, b = at_pixel(edge, left, top), at_pixel(edge, right, top)
    c, d = at_pixel(edge, left, bottom), at_pixel(edge, right, bottom)
    if edge.inside:
        return min(min(a, b), min(c, d)) + edge.low >= 0.0
    return max(max(a, b), max(c, d)) + edge.high < 0.0


@inner
def samples_inside(edge, offsets, at, x, y):
    """Return the bits of a pixel's samples that are inside the edge."""
    value = at_pixel(edge, x, y)
    least, most = value + edge.low >= 0.0, value + edge.high < 0.0
    if least or most:
        return ALL if least == edge.inside else 0
    behind = mask_bits(load(offsets, at) + value >= 0.0) | mask_bits(load(offsets, at + 8) + value >= 0.0) << 8
    return behind if edge.inside else behind ^ ALL
