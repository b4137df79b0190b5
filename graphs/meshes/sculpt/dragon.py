"""A dragon's head on its neck, jaws open, looking along +z: the mouth's hinge at the origin, the snout at 1.6 m.

The skull lies along z, the upper jaw lifted and the lower one dropped; horns, spines and ribs of the neck are tubes.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from clay import FAR, Distance, Points, ball, common, cut, ellipsoid, join, limb, mirrored, near, smooth_path, swell, tube, turned
from surface import Focus

LOW, HIGH = (-1.0, -2.0, -2.8), (1.0, 1.9, 1.9)
STEP, COUNT, DIGITS = 0.016, 22000, 4
FOCUS = Focus((0.0, 0.1, 0.7), 1.0, 0.8)
UPPER, LOWER = 14.0, -30.0
"""Degrees by which the jaws are lifted and dropped about the hinge."""
NECK = [(0, 0.12, -0.35), (0, 0.02, -0.95), (0, -0.42, -1.45), (0, -0.95, -1.95), (0, -1.30, -2.55), (0, -1.40, -3.2)]
EYE = (0.30, 0.40, 0.33)


def distance(points: Points) -> Distance:
    """Return the signed distance from the dragon, near its surface [m]."""
    p = mirrored(points, 0.02)
    upper, lower = turned(p, 0, UPPER), turned(p, 0, LOWER)
    head = join(0.10, upper_jaw(upper), near(p, (0, 0, -0.1), 1.2, back))
    head = join(0.05, head, near(lower, (0, -0.1, 0.6), 1.6, lower_jaw))
    head = join(0.12, head, neck(p))
    head = head - scales(points, head)
    head = join(0.025, head, near(upper, (0, -0.05, 0.8), 1.2, upper_teeth), near(lower, (0, 0.0, 0.7), 1.2, lower_teeth))
    head = join(0.05, head, horns(upper))
    head = join(0.02, head, spines(p))
    head = join(0.03, head, near(lower, (0, 0, 0.5), 1.1, tongue))
    return common(0.04, head, -2.7 - points[:, 2])


def bent(p: Points, path: list, start: float, end: float) -> Distance:
    """Return a tube on the smooth path through some points, its radius going evenly from start to end [m]."""
    count = 4 * len(path)
    return tube(p, smooth_path(path, count), np.linspace(start, end, count))


def upper_jaw(p: Points) -> Distance:
    """Return the skull above the mouth: cheeks, brow, snout, nostrils and eyes."""
    skull = ellipsoid(p, (0, 0.30, 0.05), (0.36, 0.30, 0.52))
    bridge = tube(p, [(0, 0.36, 0.25), (0, 0.30, 0.80), (0, 0.22, 1.30)], [0.20, 0.155, 0.15], 0.05)
    side = tube(p, [(0.26, 0.14, 0.0), (0.20, 0.13, 0.7), (0.11, 0.12, 1.30)], [0.15, 0.115, 0.12], 0.05)
    nose = ellipsoid(p, (0.085, 0.24, 1.38), (0.11, 0.10, 0.14))
    beak = ellipsoid(p, (0, 0.09, 1.47), (0.10, 0.12, 0.10))
    whole = join(0.10, join(0.12, skull, bridge), side)
    whole = join(0.06, whole, nose, beak)
    whole = cut(0.05, whole, ellipsoid(p, (0, -0.03, 0.62), (0.17, 0.10, 0.75)))
    brow = bent(p, [(0.17, 0.42, 0.72), (0.28, 0.50, 0.50), (0.35, 0.52, 0.25), (0.38, 0.52, -0.05)], 0.04, 0.09)
    cheek = bent(p, [(0.20, 0.20, 0.75), (0.32, 0.22, 0.40), (0.42, 0.16, 0.0), (0.46, 0.16, -0.30)], 0.05, 0.10)
    whole = cut(0.05, whole, ellipsoid(p, (0.36, 0.40, 0.36), (0.12, 0.075, 0.16)))
    whole = join(0.06, whole, brow, cheek)
    whole = cut(0.025, whole, ellipsoid(p, (0.16, 0.285, 1.44), (0.06, 0.035, 0.06), (1, 30)))
    ridges = 0.02 * np.cos(p[:, 2] * 42) * swell(p, (0, 0.42, 0.95), (0.12, 0.15, 0.4))
    lid = bent(p, [(0.30, 0.36, 0.50), (0.355, 0.43, 0.36), (0.33, 0.40, 0.20)], 0.03, 0.03)
    return join(0.015, join(0.02, whole - ridges, lid), ball(p, EYE, 0.085))


def back(p: Points) -> Distance:
    """Return the muscles that hold the jaws, behind the hinge."""
    return join(0.1, ellipsoid(p, (0.22, 0.05, -0.10), (0.20, 0.28, 0.26)), ellipsoid(p, (0, 0.12, -0.30), (0.34, 0.34, 0.36)))


def lower_jaw(p: Points) -> Distance:
    """Return the jaw below the mouth: two bars that meet in a chin, skin between them, a beard of spikes."""
    bar = bent(p, [(0.30, 0.0, -0.12), (0.28, -0.08, 0.3), (0.20, -0.09, 0.8), (0.08, -0.06, 1.28)], 0.12, 0.085)
    floor = ellipsoid(p, (0, -0.11, 0.55), (0.24, 0.07, 0.72))
    chin = ellipsoid(p, (0, -0.08, 1.30), (0.11, 0.09, 0.12))
    whole = join(0.08, bar, floor, chin)
    spike = bent(p, [(0.06, -0.13, 1.22), (0.07, -0.30, 1.20), (0.07, -0.42, 1.10)], 0.05, 0.022)
    second = bent(p, [(0.24, -0.13, 0.25), (0.30, -0.30, 0.15), (0.33, -0.42, -0.02)], 0.06, 0.022)
    return join(0.04, whole, spike, second)


def fang(p: Points, root: tuple, tip: tuple, width: float) -> Distance:
    """Return a tooth, bent backwards."""
    middle = [0.5 * (a + b) + c for a, b, c in zip(root, tip, (0, 0, 0.03 * abs(tip[1] - root[1]) / 0.2), strict=True)]
    return bent(p, [root, middle, tip], width, 0.018)


def upper_teeth(p: Points) -> Distance:
    """Return the teeth of the upper jaw: long ones in front, and a row."""
    teeth = [fang(p, (0.085, 0.06, 1.44), (0.085, -0.20, 1.40), 0.042), fang(p, (0.13, 0.06, 1.27), (0.14, -0.10, 1.24), 0.032)]
    for n in range(7):
        width, back_way = 0.15 + 0.016 * n, 0.14 * n
        teeth.append(fang(p, (width, 0.06, 1.12 - back_way), (width, -0.09 + 0.04 * (n % 2), 1.08 - back_way), 0.03))
    return join(0.0, *teeth)


def lower_teeth(p: Points) -> Distance:
    """Return the teeth of the lower jaw."""
    teeth = [fang(p, (0.07, -0.02, 1.34), (0.075, 0.20, 1.33), 0.038)]
    for n in range(7):
        width, back_way = 0.12 + 0.017 * n, 0.14 * n
        teeth.append(fang(p, (width, -0.03, 1.20 - back_way), (width, 0.11 - 0.03 * (n % 2), 1.17 - back_way), 0.028))
    return join(0.0, *teeth)


def tongue(p: Points) -> Distance:
    """Return the tongue: it lies on the lower jaw, and its tip is lifted."""
    return bent(p, [(0, -0.02, 0.1), (0, 0.0, 0.5), (0, 0.05, 0.85), (0, 0.14, 1.08)], 0.11, 0.03)


def horns(p: Points) -> Distance:
    """Return the horns: a long pair that sweeps back, a short one over the cheeks, a frill behind them."""
    sweep = [(0.24, 0.46, -0.05), (0.36, 0.66, -0.42), (0.46, 0.74, -0.90), (0.44, 0.92, -1.32), (0.36, 1.20, -1.55)]
    rings = 0.008 * np.cos(p[:, 2] * 55) * ((p[:, 2] < -0.2) & (p[:, 2] > -1.2))
    long = bent(p, sweep, 0.13, 0.026)
    low = bent(p, [(0.42, 0.12, -0.25), (0.56, 0.08, -0.55), (0.60, 0.12, -0.85)], 0.09, 0.022)
    mid = bent(p, [(0.38, 0.34, -0.22), (0.54, 0.42, -0.55), (0.60, 0.52, -0.85)], 0.085, 0.022)
    under = bent(p, [(0.36, -0.10, -0.22), (0.48, -0.24, -0.42), (0.52, -0.34, -0.66)], 0.075, 0.022)
    return join(0.02, long + rings, low, mid, under)


@cache
def spine() -> np.ndarray:
    """Return points along the middle of the neck (n, 3)."""
    return smooth_path(NECK, 60)


def thickness(count: int) -> np.ndarray:
    """Return the radii [m] of the neck at points along it."""
    return np.interp(np.linspace(0, 1, count), [0, 0.25, 0.6, 1.0], [0.32, 0.29, 0.40, 0.62])


def neck(p: Points) -> Distance:
    """Return the neck, with plates across its throat."""
    line = spine()[::2]
    result = np.full(len(p), FAR, dtype=p.dtype)
    radii = thickness(len(line))
    for a, b, start, end in zip(line[:-1], line[1:], radii[:-1], radii[1:], strict=True):
        result = np.minimum(result, limb(p, a, b, start, end))
    return result


def scales(points: Points, head: Distance) -> Distance:
    """Return how far scales stand out [m]: a net of diamonds on the neck and the back of the head, plates under the throat."""
    line = spine()[::2]
    close = (np.abs(head) < 0.1) & (points[:, 2] < -0.2)
    result = np.zeros(len(points), dtype=points.dtype)
    p = points[close]
    if not len(p):
        return result
    far = np.full(len(p), FAR)
    along, around = np.zeros(len(p)), np.zeros(len(p))
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    for number in range(len(line) - 1):
        way = line[number + 1] - line[number]
        share = np.clip((p - line[number]) @ way / (way @ way), 0, 1)
        off = p - line[number] - share[:, None] * way
        gap = np.linalg.norm(off, axis=1)
        up = np.cross(way, [1.0, 0, 0])
        nearer = gap < far
        far = np.where(nearer, gap, far)
        along = np.where(nearer, length[number] + share * np.linalg.norm(way), along)
        around = np.where(nearer, np.arctan2(off[:, 0], -(off @ up) / np.linalg.norm(up)), around)
    fade = np.clip((-0.25 - p[:, 2]) / 0.5, 0, 1)
    diamonds = np.abs(np.sin(13 * along + 7 * around)) * np.abs(np.sin(13 * along - 7 * around))
    plates = ((along * 5.5) % 1.0) ** 0.7
    back_side = np.abs(around) < 2.0
    result[close] = fade * np.where(back_side, 0.020 * np.sqrt(diamonds), 0.035 * plates)
    return result


def spines(p: Points) -> Distance:
    """Return the spines along the neck, larger in its middle."""
    line, radii = spine(), thickness(60)
    result = np.full(len(p), FAR, dtype=p.dtype)
    for number in range(2, 56, 4):
        way = line[number + 1] - line[number]
        up = np.cross(way, [1.0, 0, 0]) / np.linalg.norm(way)
        up = up if up[1] > 0 else -up
        root = line[number] + up * (radii[number] - 0.06)
        height = 0.20 + 0.16 * np.sin(np.pi * number / 58)
        back_way = way / np.linalg.norm(way)
        path = smooth_path([root, root + up * height * 0.6 + back_way * 0.10, root + up * height + back_way * 0.30], 7)
        spike = near(p * np.float32((1.9, 1, 1)), path[3], 0.7, lambda q, path=path: tube(q, path, np.linspace(0.12, 0.045, 7)))
        result = np.minimum(result, spike / 1.9)
    return result
