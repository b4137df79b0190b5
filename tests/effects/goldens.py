"""Small pictures of the effects, kept beside this file: `python tests/effects/goldens.py [NAME ...]` writes them anew.

Of each effect that comes with graphfx its poster's frame and the one half way there, with few of its particles.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np

from graphfx.cook.demo import at_size
from graphfx.cook.effect import Effect, FrameReport
from graphfx.graph.document import load_document
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from tests.pictures import forget, keep, pixels

FOLDER = Path(__file__).parent
LIBRARY = Library(library_roots())
EFFECTS = {file.stem: file for file in sorted((library_roots()[-1] / "graphs" / "effects").glob("*.json"))}
AMOUNT = 0.05
"""Share of the particles."""
SHARE = 0.125
"""Of a picture's width and height."""


def data_of(name: str) -> dict[str, Any]:
    """Return an effect's graph as plain data."""
    data: dict[str, Any] = load_document(EFFECTS[name]).root.data()
    return data


def small(name: str) -> Effect:
    """Return an effect with few particles and small pictures."""
    return Effect(at_size(flatten(EFFECTS[name], LIBRARY, {"amount": str(AMOUNT)}), SHARE))


def frames_of(name: str) -> list[int]:
    """Return the frames that are kept: the poster's, and that half way to it from the first."""
    data = data_of(name)
    first, poster = data["time"]["frames"][0], data["x-poster"]
    return sorted({(first + poster) // 2, poster})


def cooked(effect: Effect, name: str, out: Path, threads: int) -> list[FrameReport]:
    """Cook the frames that are kept; return what is told of them, their files among it."""
    reports: list[FrameReport] = []
    effect.cook(out, frames_of(name), threads, reports.append)
    return reports


def pictures(name: str, reports: list[FrameReport]) -> dict[str, np.ndarray]:
    """Return the pictures that were cooked, by the names under which they are kept."""
    return {f"{name}.{report.frame}": pixels(report.files[0]) for report in reports}


if __name__ == "__main__":
    import tempfile

    for each in sys.argv[1:] or EFFECTS:
        forget(FOLDER, f"{each}.*.png")
        with tempfile.TemporaryDirectory() as folder:
            keep(FOLDER, pictures(each, cooked(small(each), each, Path(folder), 2)))
