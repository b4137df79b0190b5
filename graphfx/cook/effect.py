"""An effect in Python: load a graph, cook it, or take its particles and pictures.

effect = graphfx.load("snow.json")
effect.cook("out")
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook import warm
from graphfx.cook.cameras import check_views
from graphfx.cook.channels import draw_all
from graphfx.cook.executor import BlockExecutor, Executor, ReferenceExecutor
from graphfx.cook.far import FarAway
from graphfx.cook.files import check_files, file_name
from graphfx.cook.limits import CookLimits, check_disk, check_limits
from graphfx.cook.lost import Lost
from graphfx.cook.memory import is_scarce, return_what_is_freed
from graphfx.cook.movies import KINDS, Open, movie_file, open_movies
from graphfx.cook.pilot import choices_for, doubts
from graphfx.cook.simulate import Simulation
from graphfx.cook.writing import Writer
from graphfx.errors import OutputError, Problem, UsageError
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.plan.make import Plan, make_plan
from graphfx.plan.method import Choice
from graphfx.plan.pictures import ImagePlan
from graphfx.render.film import Film
from graphfx.store.threads import available_threads


@dataclass(frozen=True)
class FrameReport:
    """What is told of a cooked frame.

    `dropped` particles could not be drawn, as numbers of theirs are not finite; `restless` ones met surfaces so often
    within one step that they were brought to rest, `failed` ones found no step short enough to go on, and `lost` counts steps
    that were not taken, as they lead beyond the numbers (all counted since the start). `faults` tell the stream and the
    attribute of those that were dropped; `warnings` are told once in a cook.
    """

    frame: int
    particles: int
    fragments: int
    dropped: int
    restless: int
    failed: int
    files: tuple[Path, ...]
    faults: tuple[tuple[str, str, int], ...] = ()
    warnings: tuple[Problem, ...] = ()
    lost: int = 0


class Effect:
    """A flattened graph and its plan; `kinds` say what becomes of the pictures of a movie, by the suffix of its file.

    `choices` of how motion is computed are tried where they are not known.
    """

    def __init__(self, flat: FlatGraph, kinds: Mapping[str, Open] = KINDS, choices: Mapping[str, Choice] | None = None):
        self.flat, self.kinds, self._known = flat, kinds, choices

    @cached_property
    def draft(self) -> Plan:
        """What will run, but for how motion is computed where that must be tried: for all that is asked before any work."""
        return make_plan(self.flat)

    @cached_property
    def choices(self) -> Mapping[str, Choice]:
        """How motion is computed where that must be tried, by source."""
        return self._known if self._known is not None else choices_for(self.draft)

    @cached_property
    def plan(self) -> Plan:
        """What will run."""
        return make_plan(self.flat, choices=self.choices) if self.choices else self.draft

    @property
    def frames(self) -> list[int]:
        """All frames of the graph."""
        return list(range(self.flat.time.first, self.flat.time.last + 1))

    def cook(
        self,
        out: str | Path = ".",
        frames: Iterable[int] | None = None,
        threads: int | None = None,
        report: Callable[[FrameReport], None] | None = None,
        limits: CookLimits | None = None,
    ) -> list[Path]:
        """Simulate and write the images of the frames (all, unless told); return the files written.

        `report` is called after each frame. Raise LimitError, before any work, for what would not fit.
        """
        wanted, limits = sorted(set(frames)) if frames is not None else self.frames, limits or CookLimits()
        check_limits(self.draft, limits)
        check_files(self.draft, Path(out), wanted)
        check_disk(self.draft, Path(out), wanted, limits)
        written: list[Path] = []
        with closing(self._cooked(Path(out), wanted, threads or available_threads(), limits)) as cooked:
            for made in cooked:
                written += made.files
                if report is not None:
                    report(made)
        return written + [movie_file(movie, self.flat.name, Path(out)) for movie in self.plan.movies if wanted]

    def _cooked(self, out: Path, frames: list[int], threads: int, limits: CookLimits) -> Generator[FrameReport]:
        """Yield the reports of frames as their files are there; a file is written while the next frame is made.

        Movies are there when the last report was taken.
        """
        wanted = set(self._checked(frames))
        if limits.memory is not None:
            return_what_is_freed()
        simulation = self.simulation(threads, limits=limits)
        if not frames:
            return
        rendered = any(image.node.node_type.role == "image" for image in self.plan.images)
        warming = warm.start(any(image.polygons for image in self.plan.images)) if rendered else None
        writer, far, lost = Writer(self.plan, threads, limits.memory), FarAway(), Lost()
        pixels = sum(math.prod(image.size) for image in self.plan.images)
        with open_movies(self.plan, out, self.kinds) as movies, ThreadPoolExecutor(1, thread_name_prefix="graphfx-write") as pool:
            waiting: tuple[FrameReport, list[Future[None]]] | None = None
            for frame in simulation.frames(frames[-1]):
                if frame not in wanted:
                    continue
                if warming is not None:
                    warming.wait()
                if waiting is not None and is_scarce(limits.memory, pixels):
                    yield _finished(*waiting)
                    waiting = None
                stills = {image.node.path: out / file_name(str(image.value("file")), self.flat.name, frame)
                          for image in self.plan.stills}
                try:
                    films = {image.node.path: writer.draw(stills.get(image.node.path), image, simulation, frame)
                             for image in self.plan.images}
                except OutputError:  # of samples, which are written as they come
                    if waiting is not None:
                        yield _finished(*waiting)
                    raise
                if waiting is not None:
                    yield _finished(*waiting)
                jobs = [pool.submit(writer.write, stills[image.node.path], image, films[image.node.path], frame)
                        for image in self.plan.stills]
                jobs += [pool.submit(writer.add, movie, films[movie.image.node.path], frame) for movie in movies]
                warnings = (*far.warnings(simulation, frame), *lost.warnings(simulation, frame))
                if frame == frames[0]:
                    warnings = (*doubts(self.plan, self.choices), *warnings)
                waiting = self._report(frame, simulation, list(films.values()), list(stills.values()), warnings), jobs
                del films  # each is let go of as soon as it is written
            if waiting is not None:
                yield _finished(*waiting)

    @staticmethod
    def _report(
        frame: int, simulation: Simulation, films: list[Film], files: list[Path], warnings: tuple[Problem, ...]
    ) -> FrameReport:
        particles = simulation.particles.values()
        return FrameReport(
            frame,
            sum(each.alive for each in particles),
            sum(film.fragments for film in films),
            sum(film.dropped for film in films),
            sum(each.unfinished for each in particles),
            sum(each.failed for each in particles),
            tuple(files),
            tuple(fault for film in films for fault in film.faults),
            warnings,
            sum(each.lost for each in particles),
        )

    def _checked(self, frames: list[int]) -> list[int]:
        time = self.flat.time
        wrong = [frame for frame in frames if not time.first <= frame <= time.last]
        if wrong:
            raise UsageError(f"frame {wrong[0]} is not in the graph's frames {time.first} to {time.last}")
        return frames

    def simulation(self, threads: int | None = None, reference: bool = False, limits: CookLimits | None = None) -> Simulation:
        """Return a new simulation: on the block machine, or in plain Python, which defines what is right.

        Raise LimitError for what would not fit.
        """
        limits = limits or CookLimits()
        check_limits(self.draft, limits)
        check_views(self.draft)
        check_limits(self.plan, limits)
        executor: Executor = (
            ReferenceExecutor(self.plan.precision) if reference else BlockExecutor(self.plan.precision, threads or 1)
        )
        return Simulation(self.plan, executor, threads or 1, limits.particles)

    def simulate(self, frame: int, threads: int | None = None, reference: bool = False) -> dict[str, dict[str, np.ndarray]]:
        """Return the columns of all particles alive at a frame, by emitter: numbers (n,), vectors (n, 3)."""
        self._checked([frame])
        simulation = self.simulation(threads, reference)
        for _ in simulation.frames(frame):
            pass
        return {
            path: {name: _columns(particles.store.column(name), particles.living()) for name in particles.store.columns}
            for path, particles in simulation.particles.items()
        }

    def _image(self, image: int | str) -> ImagePlan:
        """Return an image by its place among the graph's images, or by the id of its node."""
        images = self.plan.images
        if isinstance(image, int) and image < len(images):
            return images[image]
        found = [each for each in images if each.node.path == image]
        if not found:
            names = ", ".join(each.node.path for each in images)
            raise UsageError(f"the graph has no image {image!r}; it has: {names}" if names else "the graph has no image")
        return found[0]

    def film(self, frame: int, threads: int | None = None, image: int | str = 0) -> Film:
        """Return a frame of one of the graph's images, by number or id, as a film: linear, premultiplied float32."""
        self._checked([frame])
        wanted = self._image(image)
        simulation = self.simulation(threads or available_threads())
        for _ in simulation.frames(frame):
            pass
        return draw_all(wanted, simulation, frame, threads or available_threads())

    def frame(self, frame: int, threads: int | None = None, image: int | str = 0) -> Any:
        """Return a frame of one of the graph's images, by number or id, as a Pillow image, which notebooks show."""
        from PIL import Image

        writer = Writer(self.plan, threads or available_threads())
        return Image.fromarray(writer.displayed(self._image(image), self.film(frame, threads, image), frame))


def _finished(report: FrameReport, jobs: list[Future[None]]) -> FrameReport:
    """Wait until a frame's files are written; raise what kept them from it."""
    for job in jobs:
        job.result()
    return report


def _columns(arrays: tuple[np.ndarray, ...], rows: np.ndarray) -> np.ndarray:
    return np.stack([array[rows] for array in arrays], axis=1) if len(arrays) > 1 else arrays[0][rows]


def load(path: str | Path, library: Iterable[str | Path] = (), set: Mapping[str, Any] | None = None) -> Effect:
    """Load and check a graph file. `library` are further library roots; `set` gives values to its parameters.

    Raises GraphError with all problems, each located.
    """
    return Effect(flatten(path, Library(library_roots(library)), set))
