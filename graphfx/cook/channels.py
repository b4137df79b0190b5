"""What a picture holds besides colour and alpha: channels of single numbers, and deep samples.

    depth           m along the camera's axis, of the nearest of what is seen; 1e30 where nothing is
    velocity        pixels a frame on the screen, X to the right, Y upwards
    world_velocity  m/s
    id              the particle's number in its source, whole, modulo 2^32
    stream          which of the streams of the image it belongs to, whole, from 1 on

All but depth are those of the particle that is seen most in the pixel (see render/samples.py), since a mean of two
would be that of neither; 0 for polygons, and where nothing is seen. Velocities are means over the shutter, or over half a frame
where it stays shut. In deep files each sample has its own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.beginnings import index_of
from graphfx.cook.pictures import cameras_of, draw, window_of
from graphfx.cook.simulate import Simulation
from graphfx.cook.streaks import Shown, way_of
from graphfx.output.deep import DeepFile
from graphfx.output.exr import as_half
from graphfx.plan.pictures import MOTION, ImagePlan
from graphfx.render.film import Film
from graphfx.render.motion import screen_motion, world_motion
from graphfx.render.samples import NOTHING, Samples, fold_samples

FARTHEST = np.float32(1e30)
"""Depth of a pixel in which nothing is seen."""
COLOR = ("R", "G", "B")
COLUMNS = {
    "velocity": ("velocity.X", "velocity.Y"),
    "world_velocity": ("world_velocity.X", "world_velocity.Y", "world_velocity.Z"),
    "id": ("id",),
    "stream": ("stream",),
}
"""What is known of each particle for a channel, by names in the file; the depth, Z, is each sample's own."""
WHOLE = ("id", "stream")


DeepSink = Callable[[dict[str, np.ndarray]], Callable[[Samples], None]]
"""Takes what deep samples hold of every particle, by channel, and returns what the samples are handed to."""


def draw_all(
    image: ImagePlan, simulation: Simulation, frame: int, threads: int, memory: int | None = None, deep: DeepSink | None = None
) -> Film:
    """Return the picture of a frame with its channels; where it is deep, its samples go to `deep` instead."""
    if not image.channels:
        return draw(image, simulation, frame, threads, memory)
    made: list[Channels] = []

    def sampling(shown: list[Shown]) -> Callable[[Samples], None]:
        columns = particle_columns(image, simulation, frame, shown)
        if deep is not None:
            return deep(columns)
        made.append(Channels(columns, "depth" in image.channels, *image.size))
        return made[0].add

    film = draw(image, simulation, frame, threads, memory, sampling)
    for channels in made:
        film.channels = channels.made()
    return film


def particle_columns(image: ImagePlan, simulation: Simulation, frame: int, shown: list[Shown]) -> dict[str, np.ndarray]:
    """Return what an image's channels hold of every streak drawn, of all streams together, by name in the file.

    The last row, which NOTHING as a number means, is 0.
    """
    found = dict[str, list[np.ndarray]]()
    window = window_of(image, simulation, frame)
    fps = simulation.clock.fps
    if window.length <= 0:
        window = window._replace(opening=max(window.closing - MOTION / fps, window.start))
    cameras = cameras_of(image, window, frame)
    for each in shown:
        streaks = each.streaks.drawn() if each.streaks.tail is not None else way_of(each, window)
        values: dict[str, np.ndarray] = {}
        if "velocity" in image.channels:
            values["velocity"] = screen_motion(streaks, *cameras, *image.size, window.length * fps)
        if "world_velocity" in image.channels:
            values["world_velocity"] = world_motion(streaks, window.length)
        if "id" in image.channels:
            values["id"] = each.particles.store.column("id")[0][index_of(each.rows)].astype(np.uint32)[:, None]
        if "stream" in image.channels:
            values["stream"] = np.full((streaks.count, 1), each.stream + 1, np.uint32)
        for channel, columns in values.items():
            for name, column in zip(COLUMNS[channel], columns.T, strict=True):
                found.setdefault(name, []).append(column)
    return {name: np.concatenate([*found.get(name, ()), np.zeros(1, kind_of(name))]) for name in columns_of(image)}


def columns_of(image: ImagePlan) -> list[str]:
    """Return the names of what an image's file holds of particles."""
    return [name for channel in image.channels for name in COLUMNS.get(channel, ())]


def kind_of(name: str) -> np.dtype[Any]:
    """Return the type of the numbers of a column."""
    return np.dtype(np.uint32 if name in WHOLE else np.float32)


@dataclass
class Channels:
    """Folds samples into channels; `columns` are what each holds of every particle, by its name in the file."""

    columns: dict[str, np.ndarray]
    depth: bool
    width: int
    height: int
    nearest: np.ndarray = field(init=False)
    strongest: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        """Begin with a picture in which nothing is seen."""
        self.nearest = np.full(self.width * self.height, FARTHEST, np.float32)
        self.strongest = np.full(self.width * self.height, NOTHING, np.int32)

    def add(self, samples: Samples) -> None:
        """Take in a band of rows."""
        inside = slice(samples.top * self.width, samples.top * self.width + len(samples.offsets) - 1)
        nearest, strongest = self.nearest[inside], self.strongest[inside]
        fold_samples(samples.offsets, samples.depth, samples.opacity, samples.particle, nearest, strongest)

    def made(self) -> dict[str, np.ndarray]:
        """Return the channels (height, width), by name."""
        strongest = self.strongest.reshape(self.height, self.width)
        found = {"Z": self.nearest.reshape(strongest.shape)} if self.depth else {}
        return found | {name: column[strongest] for name, column in self.columns.items()}


def deep_types(names: Iterable[str], bits: int) -> dict[str, np.dtype[Any]]:
    """Return the channels of a deep file and their types; `names` are those of what it holds of particles."""
    color = np.dtype(np.float16 if bits == 16 else np.float32)
    own = {name: kind_of(name) for name in names}
    return {**dict.fromkeys((*COLOR, "A"), color), "Z": np.dtype(np.float32), **own}


def deep_adder(file: DeepFile, columns: dict[str, np.ndarray], exposure: float) -> Callable[[Samples], None]:
    """Return what adds samples to a deep file: colours times their own alpha; flames have colour and no alpha.

    Flattening front to back, C += (1 - A) c and A += (1 - A) a, gives the picture.
    """
    light, half = np.float32(2.0**exposure), file.channels["A"] == np.float16

    def add(samples: Samples) -> None:
        color = samples.color * (np.abs(samples.opacity) * light)[:, None]
        made = {name: color[:, plane] for plane, name in enumerate(COLOR)} | {"A": np.maximum(samples.opacity, 0.0)}
        values = {name: as_half(column) for name, column in made.items()} if half else made
        values |= {"Z": samples.depth} | {name: column[samples.particle] for name, column in columns.items()}
        file.add(samples.offsets, values)

    return add
