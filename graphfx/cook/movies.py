"""Movies: what keeps one from being written, and how the pictures of a cook get into them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePath

from graphfx.output import video as encoding
from graphfx.output.animation import LARGEST_WEBP, Add, animated_png, animated_webp
from graphfx.output.atomic import make_folder
from graphfx.output.video import LARGEST_H264, LARGEST_PRORES, h264, prores, video
from graphfx.plan.make import Plan
from graphfx.plan.pictures import ImagePlan, MoviePlan


@dataclass(frozen=True)
class Movie:
    """A movie that is being written: the image whose pictures `add` takes, and how many bits a number of them has."""

    image: ImagePlan
    add: Add
    bits: int


Open = Callable[[Path, float, float, bool], AbstractContextManager[Add]]
"""Opens a movie: its file, its frames per second, its quality, and whether its pictures have alpha."""
KINDS: Mapping[str, Open] = {
    ".mp4": lambda path, fps, quality, alpha: video(path, fps, h264(quality)),
    ".mov": lambda path, fps, quality, alpha: video(path, fps, prores(alpha)),
    ".webp": lambda path, fps, quality, alpha: animated_webp(path, fps, quality),
    ".png": lambda path, fps, quality, alpha: animated_png(path, fps),
}
"""What a movie is, by the suffix of its file."""
LARGEST = {".webp": ("a WebP", LARGEST_WEBP), ".mp4": ("H.264", LARGEST_H264), ".mov": ("ProRes", LARGEST_PRORES)}
"""What it is called, and the pixels that it may be wide or high; an animated PNG may be any."""


def movie_file(movie: MoviePlan, graph: str, out: Path) -> Path:
    """Return where a movie is written."""
    return out / str(movie.value("file")).replace("{graph}", graph)


def fault_of_movie(movie: MoviePlan, name: str) -> str:
    """Return what keeps a movie from being written under a name, or nothing."""
    suffix, image = PurePath(name).suffix.lower(), movie.image
    width, height = (int(number) for number in image.value("size"))
    size = f"the pictures of '{image.node.path}' are {width} x {height}"
    if suffix not in KINDS:
        return f"movies are written as {', '.join(KINDS)}; let the name end in one of them"
    if "#" in name:
        return "a movie is one file for all frames; leave # out of its name"
    if suffix in (".mp4", ".mov") and (fault := encoding.fault()):
        return f"{suffix} {fault}, or write .webp"
    if too_large := _too_large(suffix, max(width, height), size):
        return too_large
    if suffix == ".mp4" and image.value("transparent"):
        return f"H.264 has no alpha, and '{image.node.path}' is transparent; write .mov, .webp or .png"
    if suffix == ".mp4" and (width % 2 or height % 2):
        return f"H.264 needs an even width and height, and {size}; change the size, or write .mov, .webp or .png"
    return ""


def _too_large(suffix: str, side: int, size: str) -> str:
    """Return that pictures are wider or higher than a movie holds, or nothing."""
    if suffix not in LARGEST or side <= LARGEST[suffix][1]:
        return ""
    called, most = LARGEST[suffix]
    others = ".mov or .png" if side <= LARGEST_PRORES else ".png"
    return f"{called} is {most} pixels wide and high at most, and {size}; make them smaller, or write {others}"


@contextmanager
def open_movies(plan: Plan, out: Path, kinds: Mapping[str, Open]) -> Iterator[list[Movie]]:
    """Give what takes the pictures of each movie; the files are there when the block ends well, and only then."""
    with ExitStack() as files:
        opened = []
        for movie in plan.movies:
            path = movie_file(movie, plan.flat.name, out)
            make_folder(path)
            suffix = path.suffix.lower()
            way = kinds[suffix](path, plan.flat.time.fps, float(movie.value("quality")), bool(movie.image.value("transparent")))
            opened.append(Movie(movie.image, files.enter_context(way), 16 if suffix == ".mov" else 8))
        yield opened
