"""Textures: pictures on polygons, read by bilinear interpolation between two levels of a pyramid.

    texel (i, j) of level l covers  i / w_l ... (i + 1) / w_l  across, its centre in the middle; v = 0 is the lowest row's edge
    level = log2 of the texels of level 0 that a pixel spans, the longer way      [Williams 1983, Pyramidal parametrics]

Each level halves the one before, rounded down, every texel the exact mean of what it covers; so all have
one mean. Texels are premultiplied by their alpha. Beyond 0 ... 1 the picture repeats, or goes on as it is at its border.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.lanes.bits import float_at
from graphfx.lanes.inner import inner
from graphfx.render.apart import apart

MOST_TEXELS = 1 << 26
"""Texels of the largest texture: a gigabyte."""


def _halved(texels: np.ndarray) -> np.ndarray:
    """Return half as many texels along the first axis, rounded down: the means of equal stretches of those given.

    An odd number 2 m + 1 gives m stretches of 2 + 1 / m texels: i begins i / m into texel 2 i, ends (i + 1) / m into 2 i + 2.
    """
    count = len(texels) // 2
    if count == 0:
        return texels
    if len(texels) % 2 == 0:
        return (texels[0::2] + texels[1::2]) * np.float32(0.5)
    into = (np.arange(count + 1) / count).reshape(-1, *[1] * (texels.ndim - 1))
    total = (1.0 - into[:-1]) * texels[0:-1:2] + texels[1::2] + into[1:] * texels[2::2]
    return (total / (2.0 + 1.0 / count)).astype(np.float32)


@dataclass
class Texture:
    """A picture: `texels` float32 (height, width, 4), linear and premultiplied by alpha, the lowest row first.

    `levels` are the pyramid, the picture itself first; `opaque` says that alpha is 1 throughout. A texture that is
    `clamped` does not repeat.
    """

    texels: np.ndarray
    clamped: bool = False
    levels: list[np.ndarray] = field(init=False)
    opaque: bool = field(init=False)

    def __post_init__(self) -> None:
        """Build the pyramid."""
        if self.texels.ndim != 3 or self.texels.shape[2] != 4 or not self.texels.size:
            raise ValueError(f"a texture is (height, width, 4), not {self.texels.shape}")
        self.opaque = bool((self.texels[..., 3] == 1.0).all())
        self.levels = [np.ascontiguousarray(self.texels, np.float32)]
        while self.levels[-1].shape[:2] != (1, 1):
            level = _halved(_halved(self.levels[-1]).swapaxes(0, 1)).swapaxes(0, 1)
            self.levels.append(np.ascontiguousarray(level))
            if self.opaque:
                self.levels[-1][..., 3] = 1.0


def tables(textures: list[Texture]) -> tuple[np.ndarray, list[tuple[int, int]]]:
    """Return all levels (m, 4) as (address, width, height, clamped), and each texture's first level and their number.

    Who calls keeps the textures alive.
    """
    rows, spans = list[tuple[int, ...]](), list[tuple[int, int]]()
    for texture in textures:
        spans.append((len(rows), len(texture.levels)))
        rows += [(level.ctypes.data, level.shape[1], level.shape[0], texture.clamped) for level in texture.levels]
    return np.array(rows, np.int64).reshape(-1, 4), spans


@inner
def _neighbours(place, size, clamped):
    """Return the texels before and after a place 0 ... 1, and the way from one to the other."""
    if clamped:
        at = min(max(place * size - 0.5, 0.0), size - 1.0)
        number = int(at)
        return number, min(number + 1, size - 1), at - number
    at = (place - math.floor(place)) * size - 0.5
    first = math.floor(at)
    number = int(first)
    return (number + size) % size, (number + 1) % size, at - first


@inner
def _texel(address, texel, share, total):
    """Return four components plus a share of those of a texel."""
    at = 4 * texel
    return (
        total[0] + share * float_at(address, at), total[1] + share * float_at(address, at + 1),
        total[2] + share * float_at(address, at + 2), total[3] + share * float_at(address, at + 3),
    )


@inner
def _bilinear(levels, level, u, v, share, total):
    """Return four components plus a share of those of one level at (u, v)."""
    address, width, height, clamped = levels[level, 0], levels[level, 1], levels[level, 2], levels[level, 3] != 0
    i0, i1, s = _neighbours(u, width, clamped)
    j0, j1, t = _neighbours(v, height, clamped)
    total = _texel(address, j0 * width + i0, share * (1.0 - s) * (1.0 - t), total)
    total = _texel(address, j0 * width + i1, share * s * (1.0 - t), total)
    total = _texel(address, j1 * width + i0, share * (1.0 - s) * t, total)
    return _texel(address, j1 * width + i1, share * s * t, total)


@inner
def level_of(levels, first, count, slope):
    """Return the level, 0 ... count - 1, for the slope (du/dx, dv/dx, du/dy, dv/dy) of the coordinates, 1 / pixel."""
    width, height = levels[first, 1], levels[first, 2]
    across = (slope[0] * width) ** 2 + (slope[1] * height) ** 2
    down = (slope[2] * width) ** 2 + (slope[3] * height) ** 2
    squared = max(across, down)
    if not squared > 1.0:
        return 0.0
    return min(0.5 * math.log2(squared), count - 1.0)


@apart
def sample(levels, first, count, u, v, slope):
    """Return the four components of a texture at (u, v), between the two levels that fit the slope."""
    level = level_of(levels, first, count, slope)
    lower = min(int(level), count - 1)
    share = level - lower
    total = _bilinear(levels, first + lower, u, v, 1.0 - share, (0.0, 0.0, 0.0, 0.0))
    return _bilinear(levels, first + lower + 1, u, v, share, total) if share > 0.0 else total


def textured(texels: Any, color: bool = True) -> Texture:
    """Return a texture from linear values (height, width), (…, 3) or (…, 4), not premultiplied, the highest row first."""
    values = np.asarray(texels, np.float32)[::-1]
    values = values[..., None] if values.ndim == 2 else values
    made = np.ones((*values.shape[:2], 4), np.float32)
    if not color:
        made[...] = values[..., :1]
        return Texture(made)
    if values.shape[2] == 4:
        made[..., 3] = values[..., 3]
    made[..., :3] = values[..., :3] * made[..., 3:]
    return Texture(made)
