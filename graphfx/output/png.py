"""PNG pictures of 8 bits from a linear film.

    sRGB(c) = 12.92 c                        c <= 0.0031308
              1.055 c^(1 / 2.4) - 0.055      else                  [IEC 61966-2-1]

With a background the picture is opaque: film + (1 - alpha) background. Without, it is transparent,
and PNG wants colours that are not multiplied by alpha. Light without alpha (flames that add) cannot be
said so; it gets the least alpha that shows it over black as it is: max(alpha, red, green, blue).
"""

from __future__ import annotations

import os

import numpy as np

from graphfx.output.atomic import whole_file

COMPRESSION = 4
"""zlib's level: a third of the time of the usual 6 for a few percent of the size."""


def over(film: np.ndarray, background: tuple[float, float, float]) -> np.ndarray:
    """Return the film (height, width, 4) over a linear colour, as (height, width, 3)."""
    return film[..., :3] + (1.0 - film[..., 3:]) * np.asarray(background, film.dtype)


def srgb(linear: np.ndarray) -> np.ndarray:
    """Return linear values as sRGB, both clipped to 0 ... 1."""
    value = np.clip(linear, 0.0, 1.0)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def straight(film: np.ndarray) -> np.ndarray:
    """Return (height, width, 4) with colours that are not multiplied by alpha, clipped to 0 ... 1."""
    clipped = np.clip(film, 0.0, 1.0)
    alpha = clipped.max(axis=-1, keepdims=True)
    colors = np.divide(clipped[..., :3], alpha, out=np.zeros_like(clipped[..., :3]), where=alpha > 0.0)
    return np.concatenate([colors, alpha], axis=-1)


def eight_bit(film: np.ndarray, background: tuple[float, float, float] | None = None) -> np.ndarray:
    """Return a linear premultiplied film as sRGB bytes: RGB over a background, else RGBA."""
    if background is not None:
        return _bytes(srgb(over(film, background)))
    picture = straight(film)
    return np.concatenate([_bytes(srgb(picture[..., :3])), _bytes(picture[..., 3:])], axis=-1)


def _bytes(value: np.ndarray) -> np.ndarray:
    return (value * 255.0 + 0.5).astype(np.uint8)


def write_png(path: str | os.PathLike[str], film: np.ndarray, background: tuple[float, float, float] | None = None) -> None:
    """Write a film as PNG; `background` is linear."""
    from PIL import Image

    with whole_file(path) as stream:
        Image.fromarray(eight_bit(film, background)).save(stream, "PNG", compress_level=COMPRESSION)
