"""The demos' pictures, small, kept beside this file: `python tests/demos/goldens.py` writes them anew.

A picture is as kept if no pixel differs by more than one level of 255: processors may round a last bit differently, which
can bring a value over the edge between two levels, and never further.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from graphfx.cook.demo import Demo, Drawn, demos_in, draw_demo, picture_name
from graphfx.node import Library, library_roots

FOLDER = Path(__file__).parent
SHARE = 0.15
"""Of a picture's width and height; where the light of pixels is measured, they are small already."""
LEVELS = 1
LIBRARY = Library(library_roots())
DEMOS = {demo.name: demo for demo in demos_in(library_roots()[-1] / "graphs" / "demos" / "rendering")}


def drawn(demo: Demo) -> Drawn:
    """Return a demo's pictures, small."""
    return draw_demo(demo, LIBRARY, None, 1, 1.0 if demo.light else SHARE)


def kept(demo: Demo, image: str) -> np.ndarray:
    """Return the picture that is kept of an image."""
    with Image.open(FOLDER / f"{picture_name(demo, image)}.png") as picture:
        return np.asarray(picture.convert("RGB"))


def write() -> None:
    """Write all pictures anew."""
    for old in FOLDER.glob("*.png"):
        old.unlink()
    for demo in DEMOS.values():
        for image, picture in drawn(demo).stills.items():
            file = FOLDER / f"{picture_name(demo, image)}.png"
            Image.fromarray(picture).save(file, optimize=True)
            print(f"{file.name}: {picture.shape[1]} x {picture.shape[0]}, {file.stat().st_size:,} bytes")


if __name__ == "__main__":
    write()
