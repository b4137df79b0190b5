"""What pictures see of particles while the shutter is open."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.cook.pictures import window_of
from graphfx.cook.streaks import streaks_of
from graphfx.render.streaks import Streaks

from .effects import effect, graph

FLOOR = {"type": "bounce_plane", "resilience": 1}
SIDE = {"type": "camera", "projection": "orthographic", "view_width": 8, "position": [0, 1, 10], "target": [0, 1, 0]}
LOOK = {"position": [0, 1, 0], "velocity": [3, -4, 0], "radius": 0.1, "opacity": 0.5}
ONE = {"count": 1, "set": LOOK}


def scene(ops, emit, shutter=1.0, phase=0.0, look=None, camera=None, frames=9, fps=2, **time):
    """Return the effect of a stack seen from the side, two frames a second."""
    image = {
        "from": {"stream": "act" if ops else "sky", **(look or {})}, "camera": "side", "size": [64, 48],
        "shutter": shutter, "phase": phase,
    }
    time = {"fps": fps, "frames": [1, frames], "precision": 64, **time}
    return effect(graph(ops, {"rate": 0, **emit}, time, image, {"side": {**SIDE, **(camera or {})}}))


def pieces(found, frame, **how) -> list[Streaks]:
    """Return the streaks of a frame's picture."""
    simulation = found.simulation(**how)
    for _ in simulation.frames(frame):
        pass
    window, image = window_of(found.plan.images[0], simulation, frame), found.plan.images[0]
    both = [simulation.particles["sky"]] + [past for past in [simulation.particles["sky"].past] if past is not None]
    made = [shown.streaks.drawn() for each in both for shown in streaks_of(each, None, image.streams[0].looks, window, False)]
    return [streaks for streaks in made if streaks.count]


def ways(found, frame) -> list[tuple[Any, ...]]:
    """Return (tail, head, share of the shutter) of every streak of a frame, the earliest last, rounded."""
    rows = []
    for streaks in pieces(found, frame):
        columns = [np.broadcast_to(column, streaks.count) for column in streaks.columns(0, streaks.count)]
        for i in range(streaks.count):
            numbers = [float(column[i]) for column in columns]
            ends = [tuple(round(number, 4) for number in numbers[first : first + 3]) for first in (3, 0)]
            rows.append((*ends, round(numbers[16] * numbers[17], 4)))
    return rows
