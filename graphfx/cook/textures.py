"""Read pictures as textures, by Pillow.

Colours are sRGB and become linear [IEC 61966-2-1]; opacities are as they stand. Pictures of 16 bits keep them
where they are grey; Pillow reads others with 8. Greys in floating point are linear already; they are brought to 0 ... 1,
and what is no number is 0.
"""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from graphfx.errors import GraphError, LimitError, Problem
from graphfx.render.textures import MOST_TEXELS, Texture, textured

DEEP = ("I;16", "I;16L", "I;16B", "I;16N", "I", "F")
"""Pillow's modes of grey pictures with more than 8 bits."""


def check_texture(file: str, whole: bool = False) -> None:
    """Raise GraphError for a file that is no picture, LimitError for one that is too large.

    Only its beginning is read, unless the `whole` is to be: then GraphError is raised for a damaged one too.
    """
    with opened(file) as picture:
        width, height = picture.size
        if width * height > MOST_TEXELS:
            raise LimitError(Problem(f"the picture {Path(file).name} has {width} x {height} pixels, {width * height:,}; the most "
                                     f"of a texture is {MOST_TEXELS:,}; make it smaller"))
        if whole:
            try:
                picture.load()
            except (OSError, ValueError, SyntaxError) as error:
                raise unreadable(file, error) from error


def load_texture(file: str, color: bool) -> Texture:
    """Return a picture as a texture of colours, or of opacities; raise as `check_texture` does, and for a damaged one."""
    check_texture(file)
    with opened(file) as picture:
        try:
            return color_texture(picture) if color else _opacity_texture(picture)
        except (OSError, ValueError, SyntaxError) as error:
            raise unreadable(file, error) from error


def color_texture(picture: Any) -> Texture:
    """Return a Pillow picture as linear colours."""
    return textured(_light(picture))


def load_light(file: str) -> np.ndarray:
    """Return the light of a picture (height, width, 3 or 4), row 0 at the top, alpha not multiplied in."""
    check_texture(file)
    with opened(file) as picture:
        try:
            return _light(picture)
        except (OSError, ValueError, SyntaxError) as error:
            raise unreadable(file, error) from error


def _light(picture: Any) -> np.ndarray:
    if picture.mode in DEEP:
        grey = _deep(picture) if picture.mode == "F" else _linear(_deep(picture)).astype(np.float32)
        return grey[..., None].repeat(3, axis=2)
    values = np.asarray(picture.convert("RGBA" if picture.has_transparency_data else "RGB"))
    found = _linear(np.arange(256) / 255).astype(np.float32)[values[..., :3]]
    if values.shape[2] == 4:
        found = np.concatenate([found, values[..., 3:] / np.float32(255)], axis=2)
    return found


def _opacity_texture(picture: Any) -> Texture:
    """Return a picture as opacities: its alpha, or its lightness where it has none."""
    if picture.mode in DEEP:
        return textured(_deep(picture), color=False)
    grey = picture.convert("RGBA").getchannel("A") if picture.has_transparency_data else picture.convert("L")
    return textured(np.asarray(grey) / np.float32(255), color=False)


def opened(file: str) -> Any:
    """Return a file as a Pillow picture, of which only the beginning was read; raise as `check_texture` does."""
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            return Image.open(os.fspath(file))
    except Image.DecompressionBombError as error:
        raise LimitError(Problem(f"the picture {Path(file).name} is too large: {error}")) from error
    except (OSError, ValueError, SyntaxError) as error:
        raise unreadable(file, error) from error


def unreadable(file: str, error: Exception) -> GraphError:
    """Return what is told of a picture that cannot be read."""
    told = "it is no picture that is known" if "cannot identify" in str(error) else str(error)
    return GraphError(Problem(f"the picture {Path(file).name} cannot be read: {told}; give a PNG, JPEG, TIFF or another that "
                              "Pillow reads"))


def _deep(picture: Any) -> np.ndarray:
    """Return a grey picture of more than 8 bits as 0 ... 1."""
    if picture.mode == "F":
        return np.nan_to_num(np.asarray(picture), nan=0.0).clip(0, 1)
    return np.asarray(picture).astype(np.float32).clip(0, 65535) / np.float32(65535)


def _linear(value: np.ndarray) -> np.ndarray:
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
