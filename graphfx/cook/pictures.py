"""From particles to pictures: what the renderer is handed for a frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.cook.cameras import camera_at
from graphfx.cook.particles import Particles, flagged, padded
from graphfx.cook.simulate import Simulation
from graphfx.plan.pictures import Drawn, ImagePlan
from graphfx.render.film import Film
from graphfx.render.lines import draw_lines
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks


def draw(image: ImagePlan, simulation: Simulation, frame: int, threads: int) -> Film:
    """Return the picture of a frame."""
    time = simulation.clock.time_of(frame)
    shutter = float(image.value("shutter", time, frame))
    opening = max(time - shutter / simulation.clock.fps, simulation.clock.start)
    reach = shutter / simulation.plan.shutter if simulation.plan.shutter > 0 else 0.0
    streams = [streaks_of(_chosen(simulation, drawn, frame), drawn.looks, time, opening, reach) for drawn in image.streams]
    width, height = (int(number) for number in image.value("size"))
    way = draw_lines if image.node.node_type.role == "preview" else render
    return way(streams, camera_at(image.camera, time, frame), camera_at(image.camera, opening, frame), width, height, threads)


@dataclass
class Chosen:
    """Particles that are drawn: all, or the rows that a selection passes."""

    particles: Particles
    rows: np.ndarray | None = None


def _chosen(simulation: Simulation, drawn: Drawn, frame: int) -> Chosen:
    particles = simulation.particles[drawn.path]
    if drawn.selection is None:
        return Chosen(particles)
    count = particles.store.count
    selected = padded(np.zeros(count), np.uint8)
    given: dict[str, Any] = {"selected": (selected,)}
    rows = np.arange(count)
    simulation.programs.run(drawn.selection, particles, simulation.interval, rows, by_place=given)
    return Chosen(particles, np.flatnonzero(selected[:count]))


def streaks_of(chosen: Chosen, look: dict[str, Any], time: float, opening: float, reach: float = 1.0) -> Streaks:
    """Return the streaks of particles over the shutter from `opening` to `time`.

    `reach` is the length of this shutter in those of the longest, at whose opening tails are taken.
    """
    particles, shown = chosen.particles, chosen.rows
    store = particles.store
    share = _shares(particles, time, opening)
    if share is not None:
        drawn = np.flatnonzero(share > 0)
        shown = drawn if shown is None else drawn[flagged(shown, store.count)[drawn]]

    def column(name: str) -> Any:
        value = particles.value(name)
        if name not in store.columns:
            return value
        arrays = value if shown is None else tuple(array[shown] for array in value)
        return np.stack([np.asarray(array, np.float32) for array in arrays]) if len(arrays) == 3 else arrays[0]

    def at_tail(name: str) -> Any:
        return column(f"tail.{name}") if f"tail.{name}" in store.columns else None

    head = column("position")
    if not isinstance(head, np.ndarray):
        head = np.repeat(np.array(head, np.float32)[:, None], store.count if shown is None else len(shown), axis=1)
    tail = column("tail") if "tail" in store.columns and opening < time else None
    if tail is not None and reach < 1.0:
        tail = head + (tail - head) * np.float32(reach)
    return Streaks(
        head=head,
        tail=tail,
        head_radius=column("radius") if particles.has("radius") else 0.0,
        head_color=column("color"),
        head_opacity=column("opacity"),
        tail_radius=at_tail("radius"),
        tail_color=at_tail("color"),
        tail_opacity=at_tail("opacity"),
        share=1.0 if share is None or shown is None else share[shown].astype(np.float32),
        **look,
    )


def _shares(particles: Particles, time: float, opening: float) -> np.ndarray | None:
    """Return the part of the shutter for which each particle lived, or None if that is 1 for all."""
    store = particles.store
    length = time - opening
    late = particles.born_at > opening if length > 0 else particles.born_at[:0] > opening
    newborn = particles.born[: len(late)][late]
    if not len(newborn) and not len(particles.dying):
        return None
    share = np.ones(store.count)
    if length > 0:
        share[newborn] = (time - particles.born_at[: len(late)][late]) / length
    if len(particles.dying):
        after_death = (time - particles.ended_at) / length if length > 0 else np.ones(len(particles.dying))
        share[particles.dying] = np.maximum(share[particles.dying] - after_death, 0.0)
    return share
