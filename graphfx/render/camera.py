"""The camera: from the world to the screen.

    perspective:   x = width / 2 + f X / w,   y = height / 2 - f Y / w,   f = width lens / 36 mm
    orthographic:  x = width / 2 + k X,       y = height / 2 - k Y,       k = width / view_width

X, Y, w are metres to the right, up and ahead of the camera; x, y are pixels, the corner of the
picture's first row at (0, 0), pixel centres at halves. Everything is float64.

A perspective camera may have a depth of field: a point at depth w is spread over a disc on the film,

    c = F^2 |w - s| / (N w (s - F))        diameter, in the unit of F

F being the lens, N the f-number `f_stop` and s the distance in focus, all along the axis. [thin lens]
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

FILM_WIDTH = 36.0
"""Width of the film in mm."""
MM = 1e-3
"""Metres."""
NEAREST, FARTHEST = 1e-9, 1e15
"""Metres ahead within which a perspective camera sees, whatever its planes: its depths are float32."""
GREATEST = 1e100
"""So that products of a camera's numbers stay finite."""
PERSPECTIVE = "perspective"
ORTHOGRAPHIC = "orthographic"


@dataclass(frozen=True)
class Camera:
    """Where the camera is, where it looks, and how it projects.

    `position` and `target` are in m; `up` need not be square to the view. `lens` is the focal
    length in mm (perspective), `view_width` the width that the picture shows in m
    (orthographic). Only what lies between the planes `near` and `far`, m ahead, is seen. `f_stop` is
    the lens over the width of its opening (infinite: all is sharp), `focus_distance` the depth that is in focus, m.
    """

    position: tuple[float, float, float] = (0.0, 0.0, 10.0)
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    lens: float = 50.0
    projection: str = PERSPECTIVE
    near: float = 0.01
    far: float = 1e6
    view_width: float = 10.0
    f_stop: float = math.inf
    focus_distance: float = 10.0

    def __post_init__(self) -> None:
        """Refuse a camera that cannot be."""
        if self.projection not in (PERSPECTIVE, ORTHOGRAPHIC):
            raise ValueError(f"projection is {self.projection!r}; it must be '{PERSPECTIVE}' or '{ORTHOGRAPHIC}'")
        if not self.near < self.far or (self.perspective and not self.near > 0.0):
            raise ValueError(f"near is {self.near}, far {self.far}; near must be less than far, and in perspective more than 0")
        if not (self.lens > 0.0 and self.view_width > 0.0):
            raise ValueError("lens and view_width must be more than 0")
        if not self.f_stop > 0.0:
            raise ValueError(f"f_stop is {self.f_stop}; it must be more than 0")
        if self.f_stop < math.inf and not self.perspective:
            raise ValueError("f_stop is for perspective alone: an orthographic camera has no lens, and sees all sharp")
        if self.f_stop < math.inf and not MM * self.lens < self.focus_distance < math.inf:
            raise ValueError(f"focus_distance is {self.focus_distance:g} m; it must be more than the lens, {self.lens:g} mm")
        numbers = np.abs([*self.position, *self.target, *self.up, self.lens, self.view_width])
        if not (numbers < GREATEST).all():
            raise ValueError(f"a camera's numbers must be finite, and less than {GREATEST:g}")

    @property
    def perspective(self) -> bool:
        """Return whether far things look smaller."""
        return self.projection == PERSPECTIVE

    @property
    def planes(self) -> tuple[float, float]:
        """Return the depths of the near and far planes."""
        if self.perspective:
            return max(float(self.near), NEAREST), min(float(self.far), FARTHEST)
        return float(self.near), float(self.far)

    def axes(self) -> np.ndarray:
        """Return the unit vectors right, up and ahead as rows.

        A camera that looks at itself looks along -z; where `up` is along the view, the world's axis
        most nearly square to it serves.
        """
        ahead = _unit(np.subtract(self.target, self.position), np.array([0.0, 0.0, -1.0]))
        right = np.cross(ahead, _unit(np.asarray(self.up, float), ahead))
        if np.linalg.norm(right) < 1e-9:
            right = np.cross(ahead, np.eye(3)[np.argmin(np.abs(ahead))])
        right = _unit(right, right)
        return np.stack([right, np.cross(right, ahead), ahead])

    def scale(self, width: int) -> float:
        """Return pixels per metre: at w = 1 m in perspective, everywhere in orthographic."""
        return width * self.lens / FILM_WIDTH if self.perspective else width / self.view_width

    def confusion(self, width: int) -> float:
        """Return the radius in pixels to which a point infinitely far away is spread; at depth w it is |1 - s / w| of that."""
        if self.f_stop == math.inf:
            return 0.0
        lens = MM * self.lens
        diameter = lens / self.f_stop * self.lens / (self.focus_distance - lens)
        return min(diameter * width / FILM_WIDTH / 2, GREATEST)

    def screen_matrix(self, width: int, height: int) -> np.ndarray:
        """Return the (3, 4) matrix from (position, 1) to (x w, y w, w), or to (x, y, w) in orthographic."""
        right, up, ahead = self.axes()
        scale = self.scale(width)
        rows = np.stack([scale * right, -scale * up, ahead])
        offset = -rows @ np.asarray(self.position, float)
        if self.perspective:
            rows[:2] += np.outer([width / 2, height / 2], rows[2])
            offset[:2] += np.array([width / 2, height / 2]) * offset[2]
        else:
            offset[:2] += [width / 2, height / 2]
        return np.column_stack([rows, offset])


def _unit(vector: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 else otherwise
