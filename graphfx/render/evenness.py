"""Keep the total of small particles even as they move over the pixels.

Sampled at pixel centres, a falloff of radius 1 sums to anything from -8 to +12 % of its integral
(gaussian: +-50 %), so a small moving particle would twinkle. Opacity is therefore multiplied by

    1 + fade (total / sampled - 1),   fade = clamp(2 - r) clamp(2 - L / 8), both to 0 ... 1

where `sampled` is the sum over all pixel centres, in the picture or not, r the greater radius and L the
length in pixels. A particle of up to one pixel and eight pixels' streak has its total exactly;
beyond two pixels or sixteen, where the sum is even by itself, nothing changes.
"""

from __future__ import annotations

import math

import numpy as np

from graphfx.lanes import splat
from graphfx.lanes.bits import sum_lanes
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.falloff import DISC_RAMP
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH, fragments, groups_touched, localize
from graphfx.render.segments import DX, DY, RADIUS0, RADIUS1, X, Y

LARGE = 2.0
"""Radius in pixels from which on the sum is even enough."""
LENGTHY = 8.0
"""Length in pixels up to which the total is kept exactly; at twice this not at all."""


@inner
def _tiles_along(start, way, reach, size):
    """Return the first pixel centre that a segment reaches along one axis, and how many tiles from there hold the rest."""
    low, high = min(start, start + way) - reach, max(start, start + way) + reach
    first = math.floor(low) + 0.5
    return first, int((high - first) / size) + 1


@inner
def sampled_total(segments, q, square):
    """Return the sum over all pixel centres of segment q at opacity 1, made by the layers that draw it."""
    place, values = segments.places[q], segments.values[q]
    reach = np.float64(max(values[RADIUS0], values[RADIUS1], np.float32(1.0))) + DISC_RAMP
    left, across = _tiles_along(place[X], place[DX], reach, TILE_WIDTH)
    top, down = _tiles_along(place[Y], place[DY], reach, TILE_HEIGHT)
    total = splat(np.float32(0.0))
    for tile in range(across * down):
        local = localize(segments, q, left + tile % across * TILE_WIDTH, top + tile // across * TILE_HEIGHT)
        first, last = groups_touched(local)
        for group in range(first, last + 1):
            _, shape, _, hit = fragments(local, group, square)
            total = total + where(hit, shape, 0.0)
    return np.float64(sum_lanes(total))


@inner
def evenness(segments, q, square, total):
    """Return the factor for the opacity of segment q; `total` is its true one, `square` says perspective."""
    place, values = segments.places[q], segments.values[q]
    length = math.sqrt(place[DX] * place[DX] + place[DY] * place[DY])
    radius = np.float64(max(values[RADIUS0], values[RADIUS1]))
    fade = min(max(LARGE - radius, 0.0), 1.0) * min(max(2.0 - length / LENGTHY, 0.0), 1.0)
    if fade == 0.0:
        return 1.0
    sampled = sampled_total(segments, q, square)
    return 1.0 + fade * (total / sampled - 1.0) if sampled > 0.0 else 1.0
