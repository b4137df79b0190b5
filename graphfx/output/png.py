"""PNG pictures of 8 bits from a linear film.

    sRGB(c) = 12.92 c                        c <= 0.0031308
              1.055 c^(1 / 2.4) - 0.055      else                  [IEC 61966-2-1]

With a background the picture is opaque: film + (1 - alpha) background. Without, it is transparent,
and PNG wants colours that are not multiplied by alpha. Light without alpha (flames that add) cannot be
said so; it gets the least alpha that shows it over black as it is: max(alpha, red, green, blue).
"""

from __future__ import annotations

import os
from functools import cache

import numpy as np

from graphfx.output.atomic import whole_file

STEPS = 65536
"""Entries of the table for sRGB: fine enough that a byte is the nearest one to 0.03 of a level."""
COMPRESSION = 4
"""zlib's level: faster than the usual 6, for a percent of the size."""


def over(film: np.ndarray, background: tuple[float, float, float]) -> np.ndarray:
    """Return the film (height, width, 4) over a linear colour, as (height, width, 3)."""
    return film[..., :3] + (1.0 - film[..., 3:]) * np.asarray(background, film.dtype)


def srgb(linear: np.ndarray) -> np.ndarray:
    """Return linear values as sRGB, both clipped to 0 ... 1."""
    value = np.clip(linear, 0.0, 1.0)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def straight(film: np.ndarray) -> np.ndarray:
    """Return (height, width, 4) with colours that are not multiplied by alpha, clipped to 0 ... 1."""
    picture = np.clip(film, 0.0, 1.0)
    alpha = picture.max(axis=-1)
    picture[..., :3] /= np.where(alpha > 0.0, alpha, 1.0)[..., None]
    picture[..., 3] = alpha
    return picture


@cache
def _srgb_bytes() -> np.ndarray:
    """Return the byte of sRGB for linear k / (STEPS - 1)."""
    return (srgb(np.arange(STEPS) / (STEPS - 1)) * 255.0 + 0.5).astype(np.uint8)


def eight_bit(film: np.ndarray, background: tuple[float, float, float] | None = None) -> np.ndarray:
    """Return a linear premultiplied film as sRGB bytes: RGB over a background, else RGBA."""
    picture = over(film, background).clip(0.0, 1.0) if background is not None else straight(film)
    result = np.empty(picture.shape, np.uint8)
    _srgb_bytes().take((picture[..., :3] * (STEPS - 1) + 0.5).astype(np.uint16), out=result[..., :3], mode="clip")
    if background is None:
        result[..., 3] = (picture[..., 3] * 255.0 + 0.5).astype(np.uint8)
    return result


def write_png(path: str | os.PathLike[str], film: np.ndarray, background: tuple[float, float, float] | None = None) -> None:
    """Write a film as PNG; `background` is linear."""
    from PIL import Image

    with whole_file(path) as stream:
        Image.fromarray(eight_bit(film, background)).save(stream, "PNG", compress_level=COMPRESSION)
