"""What weighs the opacity of a segment on the screen, and its total: whole streaks, and pieces that go on in others.

A piece takes a portion p of the time of a whole streak. With caps of its own it is a streak that is exposed for that
time. Where it goes on in others it has the opacity of a whole streak at its own pace,

    L -> L / p        in the weight of layer.py

and caps at its free ends alone. So a straight streak in even motion looks the same however it is cut.
"""

from __future__ import annotations

import math

from graphfx.lanes.inner import inner
from graphfx.render.segments import JOINED_HEAD, JOINED_TAIL

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


@inner
def joined_total(sharp, opacities, segment, look, joints, portion):
    """Return the same of a segment that goes on in others, and takes the given portion of the whole streak's time."""
    _, _, dx, dy, _, _, _, _ = segment
    ends = 1.0 - (0.5 if joints & JOINED_HEAD else 0.0) - (0.5 if joints & JOINED_TAIL else 0.0)
    radius = (sharp[0] + sharp[1]) * 0.5
    length, drawn = math.sqrt(dx * dx + dy * dy), max(radius, 1.0)
    area, width = look.area * drawn * drawn, look.width * drawn * length
    true = look.area * radius * radius + (0.0 if look.exposed else look.width * radius * length / portion)
    return (area * ends + width) * true / (area + width / portion) * (opacities[0] + opacities[1]) * 0.5
