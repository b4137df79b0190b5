"""How far pictures are apart that differ in the method alone: RMS of what is displayed, and PSNR.

    RMS = sqrt(mean (a - b)^2) of sRGB values from 0 to 1,    PSNR = -20 log10 RMS [dB]
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from graphfx.cook.demo import at_size
from graphfx.cook.effect import Effect
from graphfx.cook.writing import Writer
from graphfx.graph.flat import FlatGraph, TimeSettings
from graphfx.plan.pictures import plain_value
from graphfx.study.candidates import settings

WIDEST = 320
"""Pixels that a compared picture is wide at most."""
FINER = 1e-3
"""The tolerance of the picture that the others are compared with, as a share of the graph's."""


@dataclass(frozen=True)
class PictureError:
    """How a frame's picture under some settings differs from that of the reference; PSNR is infinite where it does not [dB]."""

    name: str
    frame: int
    rms: float

    @property
    def psnr(self) -> float:
        """Return the ratio of the greatest value to the RMS [dB]."""
        return -20 * math.log10(self.rms) if self.rms > 0 else math.inf


def picture_errors(flat: FlatGraph, frame: int, times: dict[str, TimeSettings]) -> list[PictureError]:
    """Draw a frame of the graph's first picture small, with all particles, under several time settings."""
    plan = Effect(flat).plan
    if not plan.images:
        return []
    width = plain_value(plan.images[0].node.arguments["size"])[0]
    small = at_size(flat, min(WIDEST / width, 1.0))
    true = _drawn(small, settings(flat.time, "adaptive", 64, 1, flat.time.tolerance * FINER, 8), frame)
    return [PictureError(name, frame, root_mean_square(_drawn(small, time, frame) - true)) for name, time in times.items()]


def root_mean_square(values: np.ndarray) -> float:
    """Return sqrt(mean v^2)."""
    return float(np.sqrt(np.mean(np.square(values))))


def _drawn(flat: FlatGraph, time: TimeSettings, frame: int) -> np.ndarray:
    """Return what is displayed of a frame, from 0 to 1."""
    effect = Effect(replace(flat, time=time))
    image = effect.plan.images[0]
    writer = Writer(effect.plan, 1)
    return np.asarray(writer.displayed(image, effect.film(frame, threads=1), frame), np.float64) / 255
