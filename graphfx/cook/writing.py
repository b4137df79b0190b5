"""Write pictures: what becomes of a film in a file.

PNG: light times 2^exposure, over the background, through the display transform, rounded. EXR: light times 2^exposure,
multiplied by alpha, as it is; over the background only where the image states one, and then alpha is 1. Deep
EXR: every fragment, and never a background.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.backdrop import read_backdrop
from graphfx.cook.cameras import camera_at
from graphfx.cook.channels import columns_of, deep_adder, deep_types, draw_all
from graphfx.cook.formats import bits_of, ending
from graphfx.cook.movies import Movie
from graphfx.cook.simulate import Simulation
from graphfx.errors import GraphError, GraphfxError, Problem
from graphfx.motion.clock import Clock
from graphfx.output.atomic import make_folder
from graphfx.output.deep import deep_file
from graphfx.output.display import DISPLAYS, Background, displayed, over
from graphfx.output.exr import write_exr
from graphfx.output.png import write_png
from graphfx.plan.make import Plan
from graphfx.plan.pictures import ImagePlan
from graphfx.render.camera import Camera
from graphfx.render.film import Film


class Writer:
    """Draws and writes the pictures of a plan, with several threads; background pictures are read once, at the beginning."""

    def __init__(self, plan: Plan, threads: int, memory: int | None = None):
        self.plan, self.threads, self.memory = plan, threads, memory
        time = plan.flat.time
        self.clock = Clock(time.fps, time.first, time.preroll)
        self.backdrops = backdrops_of(plan)

    def draw(self, file: Path | None, image: ImagePlan, simulation: Simulation, frame: int) -> Film:
        """Return the picture of a frame; where it is deep and a file, write its samples there as they come."""
        if file is None or not image.value("deep"):
            return draw_all(image, simulation, frame, self.threads, self.memory)
        types = deep_types(columns_of(image), bits_of(image))
        exposure = self._exposure(image, frame)
        make_folder(file)
        with deep_file(file, *image.size, types, self.attributes(image, frame), self.threads) as deep:
            return draw_all(
                image, simulation, frame, self.threads, self.memory, lambda columns: deep_adder(deep, columns, exposure)
            )

    def write(self, file: Path, image: ImagePlan, film: Film, frame: int) -> None:
        """Write the picture of a frame, unless it is deep and there already."""
        if image.value("deep"):
            return
        make_folder(file)
        if ending(file.name) == ".png":
            picture = self.displayed(image, film, frame, bits_of(image))
            write_png(file, picture, _display(image) == "raw", self.threads)
            return
        light, background = self._exposed(image, film, frame), self._background(image, frame)
        if background is not None and ("background" in image.node.given or image.node.path in self.backdrops):
            light[..., :3] = over(light, background)
            light[..., 3] = 1.0
        write_exr(file, light, film.channels, bits_of(image), self.attributes(image, frame))

    def displayed(self, image: ImagePlan, film: Film, frame: int, bits: int = 8) -> np.ndarray:
        """Return the picture of a frame as a display is given it, in numbers of 8 or 16 bits."""
        scale = 2.0 ** self._exposure(image, frame)
        return displayed(film.pixels, self._background(image, frame), _display(image), bits, self.threads, scale)

    def add(self, movie: Movie, film: Film, frame: int) -> None:
        """Add the picture of a frame to a movie."""
        movie.add(self.displayed(movie.image, film, frame, movie.bits))

    def attributes(self, image: ImagePlan, frame: int) -> dict[str, Any]:
        """Return what an EXR says of a frame besides its pixels."""
        time, flat = self.clock.time_of(frame), self.plan.flat
        camera = camera_at(image.camera, time, frame)
        return {
            "frame": frame, "time": time, "graph": flat.name, "seed": str(flat.seed),
            "worldToCamera": world_to_camera(camera), "worldToNDC": world_to_ndc(camera, *image.size),
        }

    def _exposure(self, image: ImagePlan, frame: int) -> float:
        return float(image.value("exposure", self.clock.time_of(frame), frame))

    def _exposed(self, image: ImagePlan, film: Film, frame: int) -> np.ndarray:
        """Return a film with its light scaled by 2 to the power of the exposure."""
        scaled = film.pixels.copy()
        scaled[..., :3] *= np.float32(2.0 ** self._exposure(image, frame))
        return scaled

    def _background(self, image: ImagePlan, frame: int) -> Background:
        """Return what is behind a picture: a linear colour, or a picture of it, or nothing."""
        if image.value("transparent"):
            return None
        red, green, blue = (float(part) for part in image.value("background", self.clock.time_of(frame), frame))
        backdrop = self.backdrops.get(image.node.path)
        return (red, green, blue) if backdrop is None else over(backdrop, (red, green, blue))


def _display(image: ImagePlan) -> str:
    return str(image.value("display") or DISPLAYS[0])


def world_to_camera(camera: Camera) -> np.ndarray:
    """Return the matrix M (4, 4) for which (x, y, z, 1) M is (metres to the right, up, ahead, 1), as OpenEXR defines it."""
    made, axes = np.eye(4), camera.axes()
    made[:3, :3], made[3, :3] = axes.T, -axes @ np.asarray(camera.position, float)
    return made.astype(np.float32)


def world_to_ndc(camera: Camera, width: int, height: int) -> np.ndarray:
    """Return the matrix M for which (x, y, z, 1) M, divided by its last number, is the place in the picture.

    (0, 0) is the upper left corner, (1, 1) the lower right one, as OpenEXR defines it; the third number is the depth.
    """
    rows = camera.screen_matrix(width, height)
    last = rows[2] if camera.perspective else np.array([0.0, 0.0, 0.0, 1.0])
    return np.stack([rows[0] / width, rows[1] / height, rows[2], last], axis=1).astype(np.float32)


def backdrops_of(plan: Plan) -> dict[str, np.ndarray]:
    """Return the background pictures of images, by their paths; raise GraphError, with their places, for what cannot be read."""
    found: dict[str, np.ndarray] = {}
    problems = []
    for image in plan.images:
        file = str(image.value("background_image") or "")
        if not file or image.value("transparent"):
            continue
        try:
            found[image.node.path] = read_backdrop(file, image.size)
        except GraphfxError as error:
            value = image.node.arguments["background_image"]
            problems.append(Problem(error.problems[0].message, value.location, value.path))
    if problems:
        raise GraphError(problems)
    return found
