"""The film: what a render gives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Film:
    """A linear picture: `pixels` float32 (height, width, 4), colour times alpha and alpha, row 0 at the top.

    `fragments` counts pairs of a particle and a pixel that it touches, those told to lie behind opaque polygons left
    out; `dropped` the particles and triangles left out because a number of theirs was not finite. `channels`
    (height, width) are what else was asked for, by its name in a file. `faults` tell of what was dropped: the stream, the
    attribute that was not finite, and of how many.
    """

    pixels: np.ndarray
    fragments: int = 0
    dropped: int = 0
    channels: dict[str, np.ndarray] = field(default_factory=dict)
    faults: Sequence[tuple[str, str, int]] = ()
