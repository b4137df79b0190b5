"""Keep the total of small particles even as they move over the pixels.

Sampled at pixel centres, a falloff of radius 1 sums to anything from -8 to +12 % of its integral
(gaussian: +-50 %), so a small moving particle would twinkle. Opacity is therefore multiplied by

    1 + fade (total / sampled - 1),   fade = clamp(2 - r) clamp(2 - L / 64), both to 0 ... 1

where `sampled` is the sum over all pixel centres, in the picture or not, of what the particle shows there with the opacities of
its ends, r the greater radius and L the length in pixels. A particle of up to one pixel and 64 pixels' streak has its total
exactly (unless a fragment would need an opacity above 1). Between one and two pixels that fades: at 1.7 a linear falloff is
within 7 % of its total, and from two pixels on within 2 % (a disc 4 %). Streaks of more than 128 pixels along the rows or columns
of pixels may keep to as little as 24 % (gaussian), 12 % at 45 degrees (linear).
"""

from __future__ import annotations

import math

import numpy as np

from graphfx.lanes import splat
from graphfx.lanes.bits import sum_lanes
from graphfx.lanes.inner import inner
from graphfx.math.primitives import where
from graphfx.render.falloff import DISC_RAMP
from graphfx.render.layer import TILE_HEIGHT, TILE_WIDTH, along, clipped, fragments, groups_touched, localize
from graphfx.render.segments import DX, DY, RADIUS0, RADIUS1, X, Y

LARGE = 2.0
"""Radius in pixels from which on the sum is even enough."""
LENGTHY = 64.0
"""Length in pixels up to which the total is kept exactly; at twice this not at all."""


@inner
def _tiles_along(start, way, reach, size):
    """Return the first pixel centre that a segment reaches along one axis, and how many tiles from there hold the rest."""
    low, high = min(start, start + way) - reach, max(start, start + way) + reach
    first = math.floor(low) + 0.5
    return first, int((high - first) / size) + 1


@inner
def sampled_total(segments, q, square, opacity, fall):
    """Return the sum over all pixel centres of segment q, made by the layers that draw it.

    Its opacity is `opacity` at the head, and `fall` more at the tail.
    """
    place, values = segments.places[q], segments.values[q]
    reach = np.float64(max(values[RADIUS0], values[RADIUS1], np.float32(1.0))) + DISC_RAMP
    top, down = _tiles_along(place[Y], place[DY], reach, TILE_HEIGHT)
    total = splat(np.float32(0.0))
    for row in range(down):
        low = top + row * TILE_HEIGHT - reach
        begin, end = clipped(place[Y], place[DY], low, low + TILE_HEIGHT - 1.0 + 2.0 * reach, 0.0, 1.0)
        if begin > end:
            continue
        left, across = _tiles_along(place[X] + begin * place[DX], (end - begin) * place[DX], reach, TILE_WIDTH)
        for column in range(across):
            local = localize(segments, q, left + column * TILE_WIDTH, top + row * TILE_HEIGHT)
            first, last = groups_touched(local)
            for group in range(first, last + 1):
                key, shape, t, hit = fragments(local, group, square)
                if fall != 0.0:
                    shape = shape * (opacity + along(values, local, key, t, square) * fall)
                total = total + where(hit, shape, 0.0)
    return np.float64(sum_lanes(total)) * (1.0 if fall != 0.0 else opacity)


@inner
def evenness(segments, q, square, opacities, total):
    """Return the factor for segment q with opacities of its ends; `total` is its true one, `square` says perspective."""
    place, values = segments.places[q], segments.values[q]
    length = math.sqrt(place[DX] * place[DX] + place[DY] * place[DY])
    radius = np.float64(max(values[RADIUS0], values[RADIUS1]))
    fade = min(max(LARGE - radius, 0.0), 1.0) * min(max(2.0 - length / LENGTHY, 0.0), 1.0)
    if fade == 0.0:
        return 1.0
    opacity, fall = np.float32(opacities[0]), np.float32(opacities[1] - opacities[0])
    sampled = sampled_total(segments, q, square, opacity, fall)
    return 1.0 + fade * (total / sampled - 1.0) if sampled > 0.0 else 1.0
