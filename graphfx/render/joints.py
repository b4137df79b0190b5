"""Joints: where a segment goes on in another, the two are parted by the plane between them, as far from one as from the other.

    m = way / |way| - there / |there|        its normal, from the joint along this segment and to the other's far end

So what is drawn is one body along a bent way, with neither gaps nor beads at its joints.
"""

from __future__ import annotations

import math

from graphfx.lanes.inner import inner
from graphfx.render.segments import HEAD_X, HEAD_Y, JOINED_HEAD, JOINED_TAIL, TAIL_X, TAIL_Y
from graphfx.render.sight import seen_at, value_of


@inner
def joints_of(given, segment, first, last):
    """Return the bits of the ends at which a segment goes on in another, 1 the head and 2 the tail being given.

    There are none where it is shorter than it is wide, or cut by a plane.
    """
    _, _, dx, dy, r0, r1, _, _ = segment
    if given == 0 or not dx * dx + dy * dy >= max(r0, r1, 1.0) ** 2:
        return 0
    return (JOINED_HEAD if given & 1 and first == 0.0 else 0) | (JOINED_TAIL if given & 2 and last == 1.0 else 0)


@inner
def _plane_normal(joint, other, way_x, way_y, perspective):
    """Return the normal of the plane between a segment with the way (x, y) from a joint on, and one from there to another point.

    Both points are as seen_at gives them; the way to one behind the camera is as it starts from the joint.
    """
    x, y = other[0] - joint[0], other[1] - joint[1]
    if perspective:
        x, y = other[0] * joint[2] - joint[0] * other[2], other[1] * joint[2] - joint[1] * other[2]
    length, there = math.sqrt(way_x * way_x + way_y * way_y), math.sqrt(x * x + y * y)
    if not there > 0.0:
        return way_x / length, way_y / length
    return way_x / length - x / there, way_y / length - y / there


@inner
def write_joints(columns, i, view, segment, segments, at):
    """Write the planes in which a segment ends where it goes on in others."""
    head = seen_at(columns, i, 0, 6, value_of(columns, 19, i), view)
    tail = seen_at(columns, i, 3, 7, value_of(columns, 20, i), view)
    ahead = seen_at(columns, i, 21, 6, value_of(columns, 27, i), view)
    behind = seen_at(columns, i, 24, 7, value_of(columns, 28, i), view)
    dx, dy = segment[2], segment[3]
    x0, y0 = _plane_normal(head, ahead, dx, dy, view.perspective)
    x1, y1 = _plane_normal(tail, behind, -dx, -dy, view.perspective)
    joints = segments.joints
    joints[at, HEAD_X], joints[at, HEAD_Y], joints[at, TAIL_X], joints[at, TAIL_Y] = x0, y0, -x1, -y1
