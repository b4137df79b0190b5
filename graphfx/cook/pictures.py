"""From particles to pictures: what the renderer is handed for a frame."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from graphfx.cook.cameras import camera_at
from graphfx.cook.faults import faults_of
from graphfx.cook.memory import working_memory
from graphfx.cook.particles import Particles, padded
from graphfx.cook.paths import Window
from graphfx.cook.polygons import lighting_of
from graphfx.cook.simulate import Simulation
from graphfx.cook.streaks import Shown, streaks_of
from graphfx.plan.pictures import Drawn, ImagePlan
from graphfx.render.camera import Camera
from graphfx.render.film import Film
from graphfx.render.lines import draw_lines
from graphfx.render.renderer import NO_LIGHTS, render
from graphfx.render.samples import Samples
from graphfx.render.wires import wires_of

Sampling = Callable[[list[Shown]], Callable[[Samples], None]]


def draw(
    image: ImagePlan, simulation: Simulation, frame: int, threads: int, memory: int | None = None,
    sampling: Sampling | None = None,
) -> Film:
    """Return the picture of a frame, the whole process taking no more than so many bytes of memory.

    `sampling` is given all streaks and whose they are, and returns what takes their samples.
    """
    window = window_of(image, simulation, frame)
    cameras = cameras_of(image, window, frame)
    shown = [
        streaks
        for number, drawn in enumerate(image.streams if window.begun else ())
        for particles in _sources(simulation, drawn)
        for streaks in streaks_of(
            particles, _selected(simulation, particles, drawn), drawn.looks, window, cameras[0] != cameras[1], number
        )
    ]
    film = _film(image, simulation, frame, threads, memory, shown, cameras, window, sampling)
    if film.dropped:
        film.faults = faults_of(shown, image, film.dropped)
    return film


def _film(
    image: ImagePlan, simulation: Simulation, frame: int, threads: int, memory: int | None, shown: list[Shown],
    cameras: tuple[Camera, Camera], window: Window, sampling: Sampling | None,
) -> Film:
    streams = [each.streaks for each in shown]
    polygons = [simulation.polygons.polygons(node, window.closing, frame) for node in image.polygons]
    if image.node.node_type.role == "preview":
        return draw_lines([*map(wires_of, polygons), *streams], *cameras, *image.size, threads)
    lighting = lighting_of(image, window.closing, frame) if polygons else NO_LIGHTS
    sampler = sampling(shown) if sampling else None
    width, height = image.size
    return render(
        streams, *cameras, width, height, threads, sampler=sampler, polygons=polygons, lighting=lighting,
        memory=working_memory(memory, width * height), cutoff=float(image.value("cutoff", window.time, frame)),
    )


def window_of(image: ImagePlan, simulation: Simulation, frame: int) -> Window:
    """Return when an image's shutter is open in a frame; never before the simulation begins."""
    clock = simulation.clock
    time = clock.time_of(frame)
    phase, shutter = image.window(time, frame)
    opening, closing = (max(time - back / clock.fps, clock.start) for back in (phase + shutter, phase))
    begun = phase <= (time - clock.start) * clock.fps + 1e-6
    return Window(opening, closing, time, clock.start, clock.fps, begun)


def cameras_of(image: ImagePlan, window: Window, frame: int) -> tuple[Camera, Camera]:
    """Return the cameras as a shutter closes and as it opens; a cut between these is no motion."""
    closing = camera_at(image.camera, window.closing, frame)
    return closing, camera_at(image.camera, window.opening, frame, window.closing)


def _sources(simulation: Simulation, drawn: Drawn) -> list[Particles]:
    """Return the particles of a stream: those of the frame, and those whose lives were over before."""
    particles = simulation.particles[drawn.path]
    return [particles, particles.past] if particles.past is not None and particles.past.store.count else [particles]


def _selected(simulation: Simulation, particles: Particles, drawn: Drawn) -> np.ndarray | None:
    """Return for each row whether a stream's selection passes it, or None for all."""
    if drawn.selection is None:
        return None
    count = particles.store.count
    selected = padded(np.zeros(count, np.uint8), np.uint8)
    simulation.programs.run(drawn.selection, particles, simulation.interval, by_place={"selected": (selected,)})
    return selected[:count]
