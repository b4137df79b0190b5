"""What the projection works with: the two cameras, the part of the picture, and how a stream looks."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS, curve_of
from graphfx.render.streaks import Streaks


class Seen(NamedTuple):
    """What one camera sees: its matrix, pixels per metre, pixels out of focus far away, and the depth in focus."""

    matrix: np.ndarray
    scale: float
    confusion: float
    focus: float


class View(NamedTuple):
    """The two cameras."""

    head: Seen
    tail: Seen
    near: float
    far: float
    perspective: bool
    blurred: bool


def view_of(head: Camera, tail: Camera, width: int, height: int) -> View:
    """Return the view of two cameras; near and far planes are the head's."""
    seen = [
        Seen(camera.screen_matrix(width, height), camera.scale(width), camera.confusion(width), float(camera.focus_distance))
        for camera in (head, tail)
    ]
    blurred = any(each.confusion > 0.0 for each in seen)
    return View(seen[0], seen[1], *head.planes, head.perspective, blurred)


class Slab(NamedTuple):
    """A slice of depth: of particles start ... stop - 1 those whose nearest key is, as ordered bits, from low to high."""

    sliced: bool
    low: int
    high: int
    start: int
    stop: int


class Window(NamedTuple):
    """What is rendered at one time: pixels left ... right - 1, top ... bottom - 1, of all depths or of a slab.

    Where `top_rows` and `bottom_rows` hold the first and last row of tiles that each particle reaches, those that do not
    reach the rows first_row ... last_row are passed over.
    """

    left: int
    top: int
    right: int
    bottom: int
    first_row: int
    last_row: int
    top_rows: np.ndarray
    bottom_rows: np.ndarray
    slab: Slab


class Look(NamedTuple):
    """How one stream looks: see Falloff; `spread` is 1 / sqrt(4 moment), `sign` -1 for `add`, `curve` where its table lies."""

    code: int
    width: float
    area: float
    spread: float
    reach: float
    sign: float
    exposed: bool
    varies: bool
    curve: int


def look_of(stream: Streaks) -> Look:
    """Return how a stream looks."""
    falloff = FALLOFFS[stream.falloff] if isinstance(stream.falloff, str) else curve_of(stream.falloff)
    curve = 0 if stream.curve is None else stream.curve.ctypes.data
    sign, spread = -1.0 if stream.blend == "add" else 1.0, 0.5 / math.sqrt(falloff.moment)
    exposed = stream.streak == "exposed"
    return Look(falloff.code, falloff.width, falloff.area, spread, falloff.reach, sign, exposed, stream.varies, curve)
