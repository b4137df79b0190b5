"""How particles move, in the world and on the screen, as passes for motion blur want it.

    world    v = (head - tail) / (share seconds)                            m/s
    screen   u = (x(s0) - x(s1)) / ((s1 - s0) share frames)                 pixels a frame, x to the right, y upwards

`seconds` and `frames` are how long the shutter is open, `share` the part of it in which the particle lives. s runs from
0 at the head to 1 at the tail, each seen by the camera of its time: the camera's own motion is in it. s0 ... s1 is the
part between the near and the far plane; what has none does not move.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from graphfx.render.camera import Camera
from graphfx.render.streaks import Streaks


def _per_second(streaks: Streaks, span: float) -> np.ndarray:
    """Return one over the time (n,) in which each particle lives while the shutter is open; 0 for none."""
    lived = np.broadcast_to(np.asarray(streaks.share, np.float64) * np.asarray(streaks.part) * span, streaks.count)
    return np.divide(1.0, lived, out=np.zeros(streaks.count), where=lived > 0.0)


def world_motion(streaks: Streaks, seconds: float) -> np.ndarray:
    """Return the mean velocity of each particle (n, 3) while the shutter is open, m/s."""
    way = np.subtract(streaks.head, streaks.head if streaks.tail is None else streaks.tail, dtype=np.float64)
    return (way * _per_second(streaks, seconds)).T.astype(np.float32)


def screen_motion(streaks: Streaks, head: Camera, tail: Camera, width: int, height: int, frames: float) -> np.ndarray:
    """Return the mean motion of each particle (n, 2) on the screen while the shutter is open, pixels a frame."""
    matrices = head.screen_matrix(width, height), tail.screen_matrix(width, height)
    first = _at_moment(matrices, streaks.head, streaks.head_moment)
    last = _at_moment(matrices, streaks.head if streaks.tail is None else streaks.tail, streaks.tail_moment)
    near, far = head.planes
    with np.errstate(divide="ignore", invalid="ignore"):
        at_near, at_far = ((plane - first[2]) / (last[2] - first[2]) for plane in (near, far))
        level = first[2] == last[2]
        start = np.where(level, 0.0, np.maximum(0.0, np.minimum(at_near, at_far)))
        stop = np.where(level, 1.0, np.minimum(1.0, np.maximum(at_near, at_far)))
        x0, x1 = (_screen(first + s * (last - first), head.perspective) for s in (start, stop))
        motion = (x0 - x1) / (stop - start) * _per_second(streaks, frames)
    seen = (start < stop) & (~level | ((first[2] >= near) & (first[2] <= far))) & np.isfinite(motion).all(axis=0)
    return np.where(seen, motion * [[1.0], [-1.0]], 0.0).T.astype(np.float32)


def _at_moment(matrices: Sequence[np.ndarray], points: Sequence[np.ndarray] | np.ndarray, moment: Any) -> np.ndarray:
    """Return points as seen at moments between two cameras."""
    first, last = (_transformed(matrix, points) for matrix in matrices)
    return first + np.asarray(moment, np.float64) * (last - first)


def _transformed(matrix: np.ndarray, points: Sequence[np.ndarray] | np.ndarray) -> np.ndarray:
    return np.asarray(matrix[:, :3] @ np.asarray(points, np.float64) + matrix[:, 3:])


def _screen(points: np.ndarray, perspective: bool) -> np.ndarray:
    return points[:2] / points[2] if perspective else points[:2]
