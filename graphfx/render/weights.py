"""What weighs the opacity of a segment on the screen, and its total."""

from __future__ import annotations

import math

from graphfx.lanes.inner import inner

GREATEST_PACE = 1e28
"""Times the greatest radius still a float32."""


@inner
def pace_of(segment, look, perspective):
    """Return what weighs the segment's opacity (see layer.py): solid (width / area) L, exposed (width / area) of its speed.

    In perspective the speed on the screen, pixels a shutter, of motion that is even in s is pace k(t)^2.
    """
    _, _, dx, dy, _, _, k0, k1 = segment
    pace = look.width / look.area * math.sqrt(dx * dx + dy * dy)
    return min(pace / (k0 * k1) if look.exposed and perspective else pace, GREATEST_PACE)


@inner
def true_total(sharp, opacities, segment, look):
    """Return the total, of radii `sharp` in focus and opacities at the ends.

    Exposed: of the still particle, the mean over the way. Solid: of a half at each end, and of what lies between.
    """
    _, _, dx, dy, _, _, _, _ = segment
    (r0, r1), (o0, o1) = sharp, opacities
    r, o = (r0 + r1) * 0.5, (o0 + o1) * 0.5
    if look.exposed:
        return look.area * (r0 * r0 * o0 + 4.0 * r * r * o + r1 * r1 * o1) / 6.0
    between = look.width * math.sqrt(dx * dx + dy * dy) * (r0 * o0 + 4.0 * r * o + r1 * o1) / 6.0
    return look.area * (r0 * r0 * o0 + r1 * r1 * o1) * 0.5 + between
