"""Which of a pixel's sixteen samples a triangle covers.

    sample i lies at ((i + 1/2) / 16, (r(i) + 1/2) / 16) in its pixel      r: the four bits of i in reverse order

each row, column, and 4 x 4, 2 x 8, 8 x 2 part of the pixel holds its share of them [Hammersley 1960]. For the corners
a, b of an edge, a the one with the lesser x, then the lesser y, the pixel's corner p and the sample's offset o,

    E = (dx (p.y - a.y) - dy (p.x - a.x)) + (dx o.y - dy o.x),     (dx, dy) = b - a,     in float64

tells the side: E >= 0 or E < 0. Both triangles of an edge compute the same E, so each sample is in just one of them.
"""

from __future__ import annotations

import numpy as np

from graphfx.lanes import load, mask_bits
from graphfx.lanes.inner import inner
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH

PIXELS = TILE_WIDTH * TILE_HEIGHT
"""Pixels of a tile."""
SAMPLES = 16
SAMPLE_X = np.array([(i + 0.5) / SAMPLES for i in range(SAMPLES)])
SAMPLE_Y = np.array([(int(f"{i:04b}"[::-1], 2) + 0.5) / SAMPLES for i in range(SAMPLES)])
ALL = 0xFFFF


EDGE_X, EDGE_Y, EDGE_DX, EDGE_DY, INSIDE, LOW, HIGH = range(7)
"""Places in an edge's row: its first corner, the way to the other, 1 if E >= 0 is inside, and what E - E(p) lies between."""


@inner
def write_edge(edge, offsets, x0, y0, x1, y1, turn):
    """Write the edge of a triangle that turns so, and dx o.y - dy o.x of the samples."""
    swapped = x1 < x0 or (x1 == x0 and y1 < y0)
    x, y = (x1, y1) if swapped else (x0, y0)
    dx, dy = (x0 - x, y0 - y) if swapped else (x1 - x, y1 - y)
    low, high = np.inf, -np.inf
    for i in range(SAMPLES):
        value = dx * SAMPLE_Y[i] - dy * SAMPLE_X[i]
        offsets[i] = value
        low, high = min(low, value), max(high, value)
    edge[EDGE_X], edge[EDGE_Y], edge[EDGE_DX], edge[EDGE_DY] = x, y, dx, dy
    edge[INSIDE], edge[LOW], edge[HIGH] = 1.0 if (turn > 0.0) != swapped else 0.0, low, high


@inner
def _at_pixel(edge, x, y):
    """Return E at the pixel's corner."""
    return edge[EDGE_DX] * (y - edge[EDGE_Y]) - edge[EDGE_DY] * (x - edge[EDGE_X])


@inner
def contains_tile(edge, left, top):
    """Return whether all samples of a tile are inside: E is monotonous along rows and columns, rounding included."""
    right, bottom = left + (TILE_WIDTH - 1), top + (TILE_HEIGHT - 1)
    a, b = _at_pixel(edge, left, top), _at_pixel(edge, right, top)
    c, d = _at_pixel(edge, left, bottom), _at_pixel(edge, right, bottom)
    if edge[INSIDE]:
        return min(min(a, b), min(c, d)) + edge[LOW] >= 0.0
    return max(max(a, b), max(c, d)) + edge[HIGH] < 0.0


@inner
def samples_inside(edges, offsets, x, y):
    """Return the bits of a pixel's samples that are inside three edges."""
    bits = ALL
    for e in range(3):
        edge = edges[e]
        value, inside = _at_pixel(edge, x, y), edge[INSIDE] > 0.0
        least, most = value + edge[LOW] >= 0.0, value + edge[HIGH] < 0.0
        if (most and inside) or (least and not inside):
            return 0
        if not (least or most):
            behind = mask_bits(load(offsets[e], 0) + value >= 0.0) | mask_bits(load(offsets[e], 8) + value >= 0.0) << 8
            bits &= behind if inside else behind ^ ALL
    return bits
