"""The head's hair: a cap with an even hairline, and locks that set out from the crown and curl, row under row."""

from __future__ import annotations

from functools import cache

import numpy as np
from clay import FAR, Distance, Points, common, ellipsoid, join, near

CENTER = np.array([0.0, 0.29, -0.16])
RADII = np.array([0.685, 0.725, 0.855])
CROWN = np.array([0.0, 0.80, -0.60])
HAIRLINE = ([0.0, 0.45, 0.8, 1.05, 1.25, 1.45, 1.6, 1.9, 2.2, 2.6, np.pi],
            [0.57, 0.545, 0.43, 0.22, -0.02, -0.04, 0.16, 0.05, -0.28, -0.44, -0.48])
ROWS = 11


def hair(points: Points) -> Distance:
    """Return the distance from the hair, FAR where that is not near."""
    cap = ellipsoid(points, CENTER, RADII)
    whole = common(0.05, cap, 0.8 * (hairline(points) - points[:, 1]))
    close = np.abs(cap) < 0.2
    part = points[close]
    locks = np.full(len(part), FAR, dtype=points.dtype)
    for path, radii in all_locks():
        middle = (path.min(axis=0) + path.max(axis=0)) / 2
        reach = np.linalg.norm(path - middle, axis=1).max() + 0.14
        locks = join(0.012, locks, near(part, middle, reach, lambda p, path=path, radii=radii: strands(p, path, radii)))
    whole[close] = join(0.03, whole[close], locks)
    return whole


def strands(points: Points, path: np.ndarray, radii: np.ndarray) -> Distance:
    """Return the distance from one lock: flat, and grooved along its way into strands."""
    best = np.full(len(points), FAR, dtype=points.dtype)
    for a, b, start, end in zip(path[:-1], path[1:], radii[:-1], radii[1:], strict=True):
        along = np.clip((points - np.float32(a)) @ np.float32((b - a) / np.dot(b - a, b - a)), 0.0, 1.0)
        off = points - np.float32(a) - along[:, None] * np.float32(b - a)
        across = np.cross(b - a, (a - CENTER) / RADII**2)
        side = off @ np.float32(across / np.linalg.norm(across))
        radius = start + (end - start) * along
        groove = 0.008 * (1 - np.cos(2 * np.pi * (side / radius * 1.25 + 0.5))) * (radius / 0.07)
        way = np.sqrt(np.maximum((off * off).sum(axis=1) - 0.25 * side * side, 0.0)) - radius + groove
        best = np.minimum(best, 0.8 * way)
    return best


def hairline(points: np.ndarray) -> np.ndarray:
    """Return the height [m] down to which there is hair, in the direction of each point about the vertical axis."""
    return np.interp(np.arctan2(np.abs(points[:, 0]), points[:, 2]), *HAIRLINE).astype(points.dtype)


@cache
def all_locks() -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the paths (n, 3) and radii (n,) [m] of all locks."""
    random = np.random.default_rng(5)
    locks = []
    for row in range(ROWS):
        polar = 0.06 + 0.235 * row
        number = max(5, round(18 * np.sin(min(polar + 0.15, 2.0)) + 1))
        for turn in range(number):
            azimuth = 2 * np.pi * (turn + 0.5 * (row % 2) + random.uniform(-0.15, 0.15)) / number
            lock = one_lock(polar + random.uniform(-0.05, 0.05), azimuth, random)
            if lock is not None:
                locks.append(lock)
    return locks


def one_lock(polar: float, azimuth: float, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray] | None:
    """Return a lock that begins so far from the crown and hooks to one side, or None where there is no hair."""
    way = np.linspace(0, 1, 12)
    side = 1.0 if random.random() < 0.5 else -1.0
    bend = side * random.uniform(0.8, 1.4)
    hook = bend * (0.09 * np.sin(np.pi * way) - 0.34 * np.maximum(way - 0.4, 0) ** 1.6)
    theta = polar + 0.46 * np.sin(way * 1.9)
    phi = azimuth + hook / np.maximum(np.sin(theta), 0.35)
    lift = 1.0 + 0.04 * np.sin(np.pi * way) * random.uniform(0.6, 1.4) + 0.05 * way**3
    path = on_cap(theta, phi, lift)
    if path[-1, 1] < hairline(path[-1:])[0] - 0.09 or path[0, 1] < hairline(path[:1])[0] + 0.02:
        return None
    width = random.uniform(0.062, 0.08)
    return path, width * (0.3 + 0.7 * np.sin(np.pi * np.minimum(0.15 + 0.9 * way, 1.0)) ** 0.8)


def on_cap(theta: np.ndarray, phi: np.ndarray, lift: np.ndarray) -> np.ndarray:
    """Return the cap's points at angles from the crown and about it, their distance from the cap's middle times `lift`."""
    up = CROWN / np.linalg.norm(CROWN)
    right = np.array([1.0, 0.0, 0.0])
    ahead = np.cross(right, up)
    way = np.cos(theta)[:, None] * up + np.sin(theta)[:, None] * (np.cos(phi)[:, None] * right + np.sin(phi)[:, None] * ahead)
    return CENTER + RADII * way * (lift - 0.05)[:, None]
