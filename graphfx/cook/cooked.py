"""Pictures that were cooked already: the stills of a folder, or the frames of an animation, as small as is asked for.

The frames of stills are the numbers at the ends of their names, if each has one of its own; the pictures of other folders
are numbered in the order of their names, and those of an animation in time, from 1.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.frames import frames_text, parse_frames
from graphfx.cook.textures import opened, unreadable
from graphfx.errors import UsageError

STILLS = (".png", ".jpg", ".jpeg", ".webp")
ANIMATIONS = (".webp", ".png")
MOVIES = (".mp4", ".mov", ".exr", ".gif")
"""Suffixes of what is not read, though one might give it."""


@dataclass(frozen=True)
class Cooked:
    """Pictures by frame: each a file, and its place in that; with the label that each has on a sheet."""

    source: Path
    pictures: dict[int, tuple[Path, int]]
    labels: dict[int, str]

    @property
    def frames(self) -> list[int]:
        """Return all frames."""
        return sorted(self.pictures)

    def chosen(self, text: str) -> list[int]:
        """Return the frames of a set; raise UsageError where there is no picture of one."""
        wanted = parse_frames(text, self.frames[0], self.frames[-1], f"{self.source}'s", "cook more, or take fewer")
        for frame in wanted:
            if frame not in self.pictures:
                raise UsageError(f"--frames: in {self.source} there is no picture of frame {frame}; "
                                 f"there are {frames_text(self.frames)}")
        return wanted

    def size(self, size: tuple[int, int | None] | None, widest: int) -> tuple[int, int]:
        """Return the width and height of small pictures: as the first, but no wider than `widest`, unless a size is given."""
        with opened(str(self.pictures[self.frames[0]][0])) as picture:
            width, height = picture.size
        wide = size[0] if size is not None else min(width, widest)
        given = size[1] if size is not None else None
        return wide, given or max(round(height * wide / width), 1)

    def small(self, frames: list[int], size: tuple[int, int]) -> Iterator[np.ndarray]:
        """Yield pictures of some frames, as large as finds room in a size: bytes of sRGB (height, width, 4)."""
        file, picture = Path(), None
        for frame in frames:
            wanted, place = self.pictures[frame]
            if picture is None or wanted != file:
                file, picture = wanted, opened(str(wanted))
            yield _fitted(file, picture, place, size)


def is_cooked(source: str) -> bool:
    """Return whether pictures are meant, and not a graph; raise UsageError for those that are not read."""
    suffix = Path(source).suffix.lower()
    if suffix in MOVIES:
        raise UsageError(f"{source}: of pictures that were cooked already this takes a folder of {', '.join(STILLS)}, or an "
                         f"animation in {' or '.join(ANIMATIONS)}; give one of those, or the graph")
    return Path(source).is_dir() or suffix in ANIMATIONS


def find_cooked(source: str) -> Cooked:
    """Return the pictures of a folder or an animation; raise GraphError or UsageError where there are none."""
    place = Path(source)
    if not place.exists():
        raise UsageError(f"{source}: there is no such file; give a graph, a folder of pictures, or an animation")
    if not place.is_dir():
        with opened(source) as picture:
            count = getattr(picture, "n_frames", 1)
        return Cooked(place, {frame: (place, frame - 1) for frame in range(1, count + 1)}, _numbers(range(1, count + 1)))
    files = sorted(file for file in place.iterdir() if file.suffix.lower() in STILLS and not file.name.startswith("."))
    if not files:
        raise UsageError(f"{source}: there is no picture in this folder ({', '.join(STILLS)}); cook some into it, or give a "
                         "graph")
    ends = [re.search(r"\d{1,9}$", file.stem) for file in files]
    numbers = [int(end.group()) for end in ends if end]
    if len(set(numbers)) == len(files):
        return Cooked(place, {number: (file, 0) for number, file in zip(numbers, files, strict=True)}, _numbers(numbers))
    named = dict(enumerate(files, 1))
    return Cooked(place, {number: (file, 0) for number, file in named.items()},
                  {number: file.stem for number, file in named.items()})


def _numbers(frames: Any) -> dict[int, str]:
    return {frame: str(frame) for frame in frames}


def _fitted(file: Path, picture: Any, place: int, size: tuple[int, int]) -> np.ndarray:
    from PIL import ImageOps

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            picture.seek(place)
            return np.asarray(ImageOps.pad(picture.convert("RGBA"), size, color=(0, 0, 0, 0)))
    except (OSError, ValueError, SyntaxError, EOFError) as error:
        raise unreadable(str(file), error) from error
