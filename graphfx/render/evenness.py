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

from graphfx.lanes.inner import inner
from graphfx.render.falloff import DISC, DISC_RAMP, EDGE, GAUSSIAN, SHARPNESS

LARGE = 2.0
"""Radius in pixels from which on the sum is even enough."""
LONG = 8.0
"""Length in pixels up to which the total is kept exactly; at twice this not at all."""


@inner
def shape(code, distance, radius):
    """Return the falloff at a distance from the centre, both in pixels."""
    if code == DISC:
        return min(max(radius + DISC_RAMP - distance, 0.0), 1.0)
    if distance >= radius:
        return 0.0
    q = distance / radius
    if code == GAUSSIAN:
        return (math.exp(-SHARPNESS * q * q) - EDGE) / (1.0 - EDGE)
    return 1.0 - q


@inner
def weight(radius, clamped, rest, speed):
    """Return what clamping and exposure leave of the opacity: r (r + rest) / (rho (rho + rest + speed)).

    Solid streaks have rest = (width / area) L and speed 0; exposed ones have rest 0 and
    speed = (width / area) v, v in pixels a shutter at this point.
    """
    return radius * (radius + rest) / (clamped * (clamped + rest + speed))


@inner
def sampled_total(code, segment, rest, pace, square):
    """Return the sum over all pixel centres of a capsule of opacity 1; segment is (x, y, dx, dy, r0, r1, k0, k1)."""
    x, y, dx, dy, r0, r1, k0, k1 = segment
    reach = max(r0, r1, 1.0) + DISC_RAMP
    squared = dx * dx + dy * dy
    inverse = 1.0 / squared if squared > 0.0 else 0.0
    total = 0.0
    for row in range(math.floor(min(y, y + dy) - reach), math.ceil(max(y, y + dy) + reach) + 1):
        for column in range(math.floor(min(x, x + dx) - reach), math.ceil(max(x, x + dx) + reach) + 1):
            across, down = column + 0.5 - x, row + 0.5 - y
            t = min(max((across * dx + down * dy) * inverse, 0.0), 1.0)
            distance = math.sqrt((across - t * dx) ** 2 + (down - t * dy) ** 2)
            if distance < reach:
                radius = r0 + t * (r1 - r0)
                clamped = max(radius, 1.0)
                key = k0 + t * (k1 - k0)
                speed = pace * key * key if square else pace
                total += shape(code, distance, clamped) * weight(radius, clamped, rest, speed)
    return total


@inner
def evenness(code, segment, total, rest, pace, square):
    """Return the factor by which opacity is multiplied; `total` is the capsule's true one."""
    _, _, dx, dy, r0, r1, _, _ = segment
    length = math.sqrt(dx * dx + dy * dy)
    fade = min(max(LARGE - max(r0, r1), 0.0), 1.0) * min(max(2.0 - length / LONG, 0.0), 1.0)
    if fade == 0.0:
        return 1.0
    return 1.0 + fade * (total / sampled_total(code, segment, rest, pace, square) - 1.0)
