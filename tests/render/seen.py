"""How cameras see points: the reference's own account, in float64."""

from __future__ import annotations

import math

import numpy as np


def homogeneous(camera, point, radius, width, height):
    """Return X and Y in pixels, depth, radius and radius of confusion in pixels; in perspective all but depth times depth."""
    right, up, ahead = camera.axes()
    offset = np.asarray(point, np.float64) - camera.position
    depth, scale = offset @ ahead, camera.scale(width)
    center = depth if camera.perspective else 1.0
    x, y = scale * (offset @ right) + width / 2 * center, height / 2 * center - scale * (offset @ up)
    confusion = 0.0
    if camera.f_stop < math.inf:
        lens, focus = camera.lens / 1000, camera.focus_distance
        diameter = lens**2 * (depth - focus) / (camera.f_stop * (focus - lens))  # on the film, m, times depth; signed
        confusion = diameter / 2 / 0.036 * width
    return np.array([x, y, depth, max(radius, 0) * scale, confusion])


def planes(head, tail, near, far):
    """Return the part of s = 0 ... 1 between the planes, or None."""
    if head == tail:
        return (0, 1) if near <= head <= far else None
    crossings = sorted([(near - head) / (tail - head), (far - head) / (tail - head)])
    first, last = max(crossings[0], 0), min(crossings[1], 1)
    return (first, last) if first <= last else None
