"""The film: what a render gives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass
class Film:
    """A linear picture: `pixels` float32 (height, width, 4), colour times alpha and alpha, row 0 at the top.

    `fragments` counts pairs of a particle and a pixel that it touches, those told to lie behind opaque polygons left
    out; `dropped` the particles and triangles left out because a number of theirs was not finite.
    """

    pixels: np.ndarray
    fragments: int = 0
    dropped: int = 0
