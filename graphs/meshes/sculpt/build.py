"""Write the sculptures beside this folder: head.obj and dragon.obj, the same bytes each time.

    pip install scikit-image fast-simplification
    python graphs/meshes/sculpt/build.py [head] [dragon]
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import surface

FOLDER = Path(__file__).resolve().parent.parent
NAMES = ("head", "dragon")


def sculpted(figure: ModuleType, step: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices [m] and triangles of a figure, sampled at so fine a step [m] and brought down to so many triangles."""
    vertices, triangles = surface.triangulated(figure.distance, figure.LOW, figure.HIGH, step)
    vertices, triangles = surface.decimated(vertices, triangles, count, figure.FOCUS)
    return surface.settled(figure.distance, vertices), triangles


def main(names: list[str]) -> None:
    """Write the figures of these names, or all."""
    for name in names or NAMES:
        figure = importlib.import_module(name)
        title = (figure.__doc__ or "").partition("\n")[0]
        surface.write(FOLDER / f"{name}.obj", title, *sculpted(figure, figure.STEP, figure.COUNT), figure.DIGITS)
        print(f"wrote {FOLDER / name}.obj")


if __name__ == "__main__":
    main(sys.argv[1:])
