"""Put the fragments of polygons between those of particles, pixel by pixel, as these come out in order.

A particle is alike in all sixteen samples of a pixel, so what passes sample s is T P_s: T what the particles let through,
P_s the polygons. With m = mean_s P_s, a particle of opacity a (above `add`, below 0) and a polygon's fragment of opacity a
that is seen in the samples M (M_s is 0 or 1) give

    w = T m |a|,               C += w c,   T -= T max(a, 0)
    w = T a mean_s(M_s P_s),   C += w c,   P_s -= P_s a M_s

and at the end alpha = 1 - T m. A polygon goes before a particle of the same key.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from graphfx.lanes import load, mask_bits, mask_from_bits, splat, store
from graphfx.lanes.bits import sum_lanes
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.coverage import PIXELS, SAMPLES

if TYPE_CHECKING:
    from graphfx.render.layers import Layers

F = np.float32


class Cover(NamedTuple):
    """The layers, and one thread's memory: for each pixel P_s and m, the key of the next fragment, its row, and the last."""

    layers: Layers
    samples: np.ndarray
    means: np.ndarray
    due: np.ndarray
    rows: np.ndarray
    stops: np.ndarray


def new_cover(layers: Layers | None) -> Cover | None:
    """Return a cover for one thread, or None where there are no polygons."""
    if layers is None:
        return None
    rows = np.empty((2, PIXELS), np.int64)
    return Cover(layers, np.empty(PIXELS * SAMPLES, F), np.empty(PIXELS, F), np.empty(PIXELS, F), *rows)


@inner
def begin_pixels(cover, k, first, count):
    """Begin `count` pixels of tile k, from its pixel `first` on: nothing covers them yet."""
    row = cover.layers.rows[k]
    for i in range(count):
        store(cover.samples, i * SAMPLES, splat(F(1.0)))
        cover.means[i] = F(1.0)
        cover.rows[i] = cover.stops[i] = 0
        if row >= 0:
            cover.rows[i], cover.stops[i] = cover.layers.firsts[row, first + i], cover.layers.firsts[row, first + i + 1]
        _note_due(cover, i)


@inner
def _note_due(cover, i):
    cover.due[i] = cover.layers.keys[cover.rows[i]] if cover.rows[i] < cover.stops[i] else F(np.inf)


@inner
def show_next(cover, i, through, light, red):
    """Composite the next fragment of pixel i, to which particles let `through`; its light lies from light[red] on."""
    row = cover.rows[i]
    value, samples = cover.layers.values[row], load(cover.samples, i * SAMPLES)
    seen = where(mask_from_bits(cover.layers.masks[row]), samples, 0.0)
    weight = through * value[0] * (sum_lanes(seen) * F(1.0 / SAMPLES))
    samples = samples - seen * value[0]
    store(cover.samples, i * SAMPLES, samples)
    cover.means[i] = sum_lanes(samples) * F(1.0 / SAMPLES)
    for c in range(3):
        light[red + c * SAMPLES] += weight * value[c + 1]
    cover.rows[i] = row + 1
    _note_due(cover, i)


@inner
def show_before(cover, first, light, at, slots, slot, chosen):
    """Composite what comes before the chosen lanes of a slot; the cover of lane 0 is `first`, its light at `at`."""
    bits = mask_bits(chosen & (load(cover.due, first) <= load(slots, slot)))
    lane = 0
    while bits:
        if bits & 1:
            while cover.due[first + lane] <= slots[slot + lane]:
                show_next(cover, first + lane, light[at + lane], light, at + SAMPLES + lane)
        bits >>= 1
        lane += 1


@inner
def show_rest(cover, first, light, at):
    """Composite all that is left of sixteen pixels."""
    for lane in range(SAMPLES):
        while cover.rows[first + lane] < cover.stops[first + lane]:
            show_next(cover, first + lane, light[at + lane], light, at + SAMPLES + lane)


@inner
def hides(layers, k, group, nearest):
    """Return whether nothing from this key on is seen in a group of tile k."""
    return nearest > layers.limits[k, group]
