"""The demos' pictures, small, kept beside this file: `python tests/demos/goldens.py` writes them anew."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from graphfx.cook.demo import Demo, Drawn, demos_in, draw_demo, picture_name
from graphfx.node import Library, library_roots
from tests.pictures import forget, keep

FOLDER = Path(__file__).parent
SHARE = 0.15
"""Of a picture's width and height; where the light of pixels is measured, they are small already."""
LIBRARY = Library(library_roots())
DEMOS = {demo.name: demo for demo in demos_in(library_roots()[-1] / "graphs" / "demos" / "rendering")}


def drawn(demo: Demo) -> Drawn:
    """Return a demo's pictures, small."""
    return draw_demo(demo, LIBRARY, None, 1, 1.0 if demo.light else SHARE)


if __name__ == "__main__":
    forget(FOLDER)
    for each in DEMOS.values():
        keep(FOLDER, {picture_name(each, image): picture for image, picture in drawn(each).stills.items()})
