"""From particles to pictures: what the renderer is handed for a frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.cook.cameras import camera_at
from graphfx.cook.particles import Particles, flagged, padded
from graphfx.cook.polygons import lighting_of
from graphfx.cook.simulate import Simulation
from graphfx.plan.pictures import Drawn, ImagePlan
from graphfx.render.film import Film
from graphfx.render.lines import draw_lines
from graphfx.render.renderer import NO_LIGHTS, render
from graphfx.render.samples import Samples
from graphfx.render.streaks import Streaks


@dataclass
class Chosen:
    """Particles that are drawn: all, or the rows that a selection passes."""

    particles: Particles
    rows: np.ndarray | None = None


Sampling = Callable[[list[Chosen]], Callable[[Samples], None]]


def draw(image: ImagePlan, simulation: Simulation, frame: int, threads: int, sampling: Sampling | None = None) -> Film:
    """Return the picture of a frame; `sampling` is given the particles drawn, by stream, and returns what takes their samples."""
    time = simulation.clock.time_of(frame)
    shutter = float(image.value("shutter", time, frame))
    opening = max(time - shutter / simulation.clock.fps, simulation.clock.start)
    reach = shutter / simulation.plan.shutter if simulation.plan.shutter > 0 else 0.0
    chosen = [_chosen(simulation, drawn, frame) for drawn in image.streams]
    streams = [
        streaks_of(each, drawn.looks, time, opening, reach) for each, drawn in zip(chosen, image.streams, strict=True)
    ]
    cameras = camera_at(image.camera, time, frame), camera_at(image.camera, opening, frame)
    drawn = [Chosen(each.particles, drawn_rows(each, time, opening)[0]) for each in chosen] if sampling else []
    if image.node.node_type.role == "preview":
        return draw_lines(streams, *cameras, *image.size, threads)
    polygons = [simulation.polygons.polygons(node, time, frame) for node in image.polygons]
    lighting = lighting_of(image, time, frame) if polygons else NO_LIGHTS
    sampler = sampling(drawn) if sampling else None
    return render(streams, *cameras, *image.size, threads, sampler=sampler, polygons=polygons, lighting=lighting)


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
    particles = chosen.particles
    store = particles.store
    shown, share = drawn_rows(chosen, time, opening)

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


def drawn_rows(chosen: Chosen, time: float, opening: float) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Return the rows of the particles that are drawn, or None for all, and the part of the shutter for which each row lived."""
    share, shown = shares(chosen.particles, time, opening), chosen.rows
    if share is not None:
        drawn = np.flatnonzero(share > 0)
        shown = drawn if shown is None else drawn[flagged(shown, chosen.particles.store.count)[drawn]]
    return shown, share


def shares(particles: Particles, time: float, opening: float) -> np.ndarray | None:
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
