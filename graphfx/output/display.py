"""From light to the numbers of a picture: exposure is in the film already, then background, display transform, rounding.

    raw     c                                                              clipped to 0 ... 1
    srgb    12.92 c                        c <= 0.0031308                  [IEC 61966-2-1]
            1.055 c^(1 / 2.4) - 0.055      else
    filmic  srgb(f(k c) ),   f(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)

f is Narkowicz's fit of the ACES tone curve ("ACES Filmic Tone Mapping Curve", 2015), for each channel alone, so that
light far above 1 turns white through its neighbours in hue; k = 0.7232 lets middle grey, 0.18, stay where it is. The
curve reaches 1 at c = 10, 5.8 stops above middle grey.

With a background the picture is opaque: film + (1 - alpha) background. Without, it is transparent, and its
colours are not multiplied by alpha. Light without alpha (flames that add) cannot be said so; it gets
the least alpha that shows it over black as it is: max(alpha, red, green, blue), no more than 1.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from graphfx.store.threads import parallel_ranges

Background = tuple[float, float, float] | np.ndarray | None
"""A linear colour, a linear picture (height, width, 3), or none."""

DISPLAYS = ("srgb", "filmic", "raw")
STEPS = 65536
"""Entries of the table for sRGB: fine enough that a byte is the nearest one to 0.03 of a level."""
BAND = 32
"""Rows that are worked on at a time."""
MIDDLE_GREY = 0.18


def over(film: np.ndarray, background: tuple[float, float, float] | np.ndarray) -> np.ndarray:
    """Return the film (height, width, 4) over a linear colour or picture, as (height, width, 3)."""
    through, behind, picture = 1.0 - film[..., 3], np.asarray(background, film.dtype), film[..., :3].copy(order="K")
    for plane in range(3):
        picture[..., plane] += through * behind[..., plane]
    return picture


def srgb(linear: np.ndarray) -> np.ndarray:
    """Return linear values as sRGB, both clipped to 0 ... 1."""
    value = np.clip(linear, 0.0, 1.0)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def _tone(x: np.ndarray) -> np.ndarray:
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)


@cache
def filmic_scale() -> float:
    """Return k, for which f(k c) = c at middle grey: the positive root of a square equation."""
    a, b, c = 2.51 - 2.43 * MIDDLE_GREY, 0.03 - 0.59 * MIDDLE_GREY, -0.14 * MIDDLE_GREY
    return float((-b + (b * b - 4 * a * c) ** 0.5) / (2 * a) / MIDDLE_GREY)


def filmic(linear: np.ndarray) -> np.ndarray:
    """Return linear values with their highlights rolled off, in 0 ... 1 and still linear; none is so great that it overflows."""
    return np.minimum(_tone(np.clip(linear, 0.0, 1e9) * linear.dtype.type(filmic_scale())), linear.dtype.type(1.0))


def straight(film: np.ndarray) -> np.ndarray:
    """Return (height, width, 4) with colours that are not multiplied by alpha; they may pass 1, alpha does not."""
    picture = np.maximum(film, 0.0)
    red, green, blue, alpha = (picture[..., plane] for plane in range(4))
    alpha = np.minimum(np.maximum(np.maximum(red, green), np.maximum(blue, alpha)), 1.0)
    picture[..., :3] /= np.where(alpha > 0.0, alpha, 1.0)[..., None]
    picture[..., 3] = alpha
    return picture


def shown(film: np.ndarray, background: Background, display: str) -> np.ndarray:
    """Return what a display shows of a film, linear in 0 ... 1: RGB over a background, else RGBA."""
    picture = over(film, background) if background is not None else straight(film)
    if display == "filmic":
        picture[..., :3] = filmic(picture[..., :3])
    return picture.clip(0.0, 1.0)


@cache
def _srgb_bytes() -> np.ndarray:
    """Return the byte of sRGB for linear k / (STEPS - 1)."""
    return (srgb(np.arange(STEPS) / (STEPS - 1)) * 255.0 + 0.5).astype(np.uint8)


def _in_bytes(value: np.ndarray, display: str) -> np.ndarray:
    """Return one colour, or alpha as `raw`, in 8 bits."""
    if display == "raw":
        return (value * 255.0 + 0.5).astype(np.uint8)
    return _srgb_bytes()[(value * (STEPS - 1) + 0.5).astype(np.uint16)]


def _in_words(value: np.ndarray, display: str) -> np.ndarray:
    """Return one colour, or alpha as `raw`, in 16 bits."""
    exact = value.astype(np.float64)
    return ((exact if display == "raw" else srgb(exact)) * 65535.0 + 0.5).astype(np.uint16)


def _by_planes(rows: np.ndarray) -> np.ndarray:
    """Return a copy (height, width, 4) that lies in memory colour by colour, over which NumPy goes in long strides."""
    return np.moveaxis(np.ascontiguousarray(np.moveaxis(rows, -1, 0)), 0, -1)


def displayed(
    film: np.ndarray, background: Background = None, display: str = "srgb", bits: int = 8, threads: int = 1, scale: float = 1.0
) -> np.ndarray:
    """Return a linear premultiplied film as numbers of 8 or 16 bits: RGB over a background, else RGBA.

    Each is the nearest to what it stands for; nothing is dithered. The film's light is multiplied by `scale` before.
    """
    height, width = film.shape[:2]
    result = np.empty((height, width, 4 if background is None else 3), np.uint8 if bits == 8 else np.uint16)
    rounded = _in_bytes if bits == 8 else _in_words

    def work(_: int, start: int, stop: int) -> None:
        behind = _by_planes(background[start:stop]) if isinstance(background, np.ndarray) else background
        light = _by_planes(film[start:stop])
        light[..., :3] *= np.float32(scale)
        picture = shown(light, behind, display)
        for plane in range(result.shape[2]):
            result[start:stop, :, plane] = rounded(picture[..., plane], display if plane < 3 else "raw")

    parallel_ranges(work, [(top, min(top + BAND, height)) for top in range(0, height, BAND)], threads)
    return result
