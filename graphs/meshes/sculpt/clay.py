"""Signed distances, the clay of the sculptures: negative inside, positive outside, joined and cut softly.

Points are arrays (n, 3) [m] and distances arrays (n,) [m]. Ellipsoids are nearly distances, near their surface; the others
are exact. After Quilez, *Distance functions* and *Smooth minimum*, https://iquilezles.org/articles.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

Points = np.ndarray
Distance = np.ndarray
Triple = Sequence[float]
FAR = 10.0


def turned(points: Points, axis: int, degrees: float) -> Points:
    """Return the points turned about a coordinate axis, right-handed: a shape asked there is turned the other way."""
    s, c = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    result = points.copy()
    result[:, i], result[:, j] = c * points[:, i] - s * points[:, j], s * points[:, i] + c * points[:, j]
    return result


def mirrored(points: Points, softness: float = 0.0) -> Points:
    """Return the points with |x| for x, or sqrt(x^2 + softness^2), which leaves no crease on the middle plane."""
    return np.column_stack([np.hypot(points[:, 0], softness), points[:, 1], points[:, 2]])


def ball(points: Points, center: Triple, radius: float) -> Distance:
    """Return |p - center| - radius."""
    return np.linalg.norm(points - np.float32(center), axis=1) - radius


def ellipsoid(points: Points, center: Triple, radii: Triple, turn: tuple[int, float] | None = None) -> Distance:
    """Return k (k - 1) / |q / r^2| with q = p - center and k = |q / r|; `turn` is an axis and degrees by which it is turned."""
    q = points - np.float32(center)
    if turn is not None:
        q = turned(q, turn[0], -turn[1])
    q = q / np.float32(radii)
    k = np.linalg.norm(q, axis=1)
    return k * (k - 1.0) / np.maximum(np.linalg.norm(q / np.float32(radii), axis=1), 1e-9)


def limb(points: Points, start: Triple, end: Triple, start_radius: float, end_radius: float) -> Distance:
    """Return the distance from a line whose radius goes evenly from one end to the other, rounded at its ends."""
    a, b = np.float32(start), np.float32(end)
    along = np.clip((points - a) @ (b - a) / np.dot(b - a, b - a), 0.0, 1.0)
    way = np.linalg.norm(points - a - along[:, None] * (b - a), axis=1)
    return way - (start_radius + (end_radius - start_radius) * along)


def tube(points: Points, path: Sequence[Triple], radii: Sequence[float], softness: float = 0.0) -> Distance:
    """Return the distance from limbs one after another through the points of a path, each with its radius."""
    parts = [limb(points, *ends) for ends in zip(path[:-1], path[1:], radii[:-1], radii[1:], strict=True)]
    return join(softness, *parts)


def smooth_path(path: Sequence[Triple], count: int) -> np.ndarray:
    """Return `count` points (count, d) of the Catmull-Rom spline through the points of a path; also for radii, (n, 1)."""
    knots = np.asarray(path, dtype=float)
    knots = np.vstack([2 * knots[0] - knots[1], knots, 2 * knots[-1] - knots[-2]])
    place = np.linspace(0, len(knots) - 3 - 1e-9, count)
    i, t = place.astype(int), (place % 1.0)[:, None]
    a, b, c, d = (knots[i + n] for n in range(4))
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))


def join(softness: float, *parts: Distance) -> Distance:
    """Return the least of all, less h^2 / (4 softness) where two come within the softness: h = softness - |a - b|."""
    result = parts[0]
    for part in parts[1:]:
        least = np.minimum(result, part)
        result = least - np.maximum(softness - np.abs(result - part), 0.0) ** 2 / (4 * softness) if softness else least
    return result


def cut(softness: float, whole: Distance, *parts: Distance) -> Distance:
    """Return the whole without the parts, its edges rounded."""
    return -join(softness, -whole, *parts)


def common(softness: float, *parts: Distance) -> Distance:
    """Return what is inside all of them, its edges rounded."""
    return -join(softness, *(-part for part in parts))


def swell(points: Points, center: Triple, radii: Triple, turn: tuple[int, float] | None = None) -> Distance:
    """Return exp(-|(p - center) / radii|^2): times a height, how far a thumb's stroke raises or dents a surface."""
    q = points - np.float32(center)
    if turn is not None:
        q = turned(q, turn[0], -turn[1])
    return np.exp(-(((q / np.float32(radii)) ** 2).sum(axis=1)))


def near(points: Points, center: Triple, reach: float, shape: Callable[[Points], Distance]) -> Distance:
    """Return a shape's distance within `reach` of a center, and FAR elsewhere, without asking it there."""
    result = np.full(len(points), FAR, dtype=points.dtype)
    close = ((points - np.float32(center)) ** 2).sum(axis=1) < reach * reach
    if close.any():
        result[close] = shape(points[close])
    return result
