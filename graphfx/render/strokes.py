"""The pixels of lines that are placed already: see lines.py for what each gets."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes import compiled
from graphfx.lanes.inner import inner

MARGIN = 2
"""Pixels around the picture, and around a band of its rows, that a line may touch and nobody sees."""


class Lines(NamedTuple):
    """Lines on the screen: `ends` are x, y of both ends in pixels, `looks` red, green, blue and alpha, negative if they add.

    `rows` are the first row that a line may touch, and the one after the last.
    """

    ends: np.ndarray
    looks: np.ndarray
    rows: np.ndarray


@inner
def _touch(sums, at, share, look):
    """Let a line have its share of a pixel: its colour times alpha, alpha and coverage, or light that is added."""
    red, green, blue, alpha = look
    part = share * abs(alpha)
    if alpha < 0.0:
        sums[at, 5] += part * red
        sums[at, 6] += part * green
        sums[at, 7] += part * blue
    else:
        sums[at, 0] += part * red
        sums[at, 1] += part * green
        sums[at, 2] += part * blue
        sums[at, 3] += part
        sums[at, 4] += part * (np.float32(1.0) - sums[at, 4])


@inner
def _draw(lines, k, top, bottom, width, sums):
    """Draw line k into the rows top ... bottom; return how many pixels its middle meets there."""
    x0, y0, x1, y1 = lines.ends[k, 0], lines.ends[k, 1], lines.ends[k, 2], lines.ends[k, 3]
    look = lines.looks[k, 0], lines.looks[k, 1], lines.looks[k, 2], lines.looks[k, 3]
    stride = width + 2 * MARGIN
    corner = MARGIN * stride + MARGIN - top * stride
    first, last, low, high, along, across = 0, width, top - 2, bottom + 1, 1, stride
    if abs(y1 - y0) > abs(x1 - x0):
        x0, y0, x1, y1 = y0, x0, y1, x1
        first, last, low, high, along, across = top, bottom, -2, width + 1, stride, 1
    if x1 < x0:
        x0, y0, x1, y1 = x1, y1, x0, y0
    if not x1 > x0:
        return 0
    half, one, nothing = np.float32(0.5), np.float32(1.0), np.float32(0.0)
    slope = (y1 - y0) / (x1 - x0)
    cosine = one / math.sqrt(one + slope * slope)
    touched = 0
    for i in range(max(math.floor(x0), first), min(math.ceil(x1), last)):
        begin, end = max(x0, np.float32(i)), min(x1, np.float32(i + 1))
        y = y0 + slope * ((begin + end) * half - x0)
        floor = math.floor(y)
        j = np.int64(floor)
        if j <= low or j >= high:
            continue
        off = (y - np.float32(floor) - half) * cosine
        middle = one - abs(off)
        before, after = max(one - abs(off + cosine), nothing), max(one - abs(off - cosine), nothing)
        scale = (end - begin) / (cosine * (before + middle + after))
        at = corner + i * along + j * across
        _touch(sums, at - across, before * scale, look)
        _touch(sums, at, middle * scale, look)
        _touch(sums, at + across, after * scale, look)
        touched += low + 1 < j < high - 1
    return touched


@inner
def _settle(sums, top, bottom, pixels):
    """Write the colours of a band of rows."""
    width = pixels.shape[1]
    at = MARGIN * (width + 2 * MARGIN) + MARGIN
    for y in range(top, bottom):
        for x in range(width):
            alpha, covered = sums[at, 3], sums[at, 4]
            mean = covered / alpha if alpha > 0.0 else np.float32(0.0)
            for c in range(3):
                pixels[y, x, c] = sums[at, c] * mean + sums[at, 5 + c]
            pixels[y, x, 3] = covered
            at += 1
        at += 2 * MARGIN


@compiled
def draw_band(lines, spans, top, bottom, pixels):
    """Draw the rows top ... bottom with what of the lines in the spans lies there; return how many fragments there are."""
    width = pixels.shape[1]
    sums = np.zeros(((bottom - top + 2 * MARGIN) * (width + 2 * MARGIN), 8), np.float32)
    fragments = 0
    for span in range(len(spans)):
        for k in range(spans[span, 0], spans[span, 1]):
            if lines.rows[k, 0] < bottom and lines.rows[k, 1] > top:
                fragments += _draw(lines, k, top, bottom, width, sums)
    _settle(sums, top, bottom, pixels)
    return fragments
