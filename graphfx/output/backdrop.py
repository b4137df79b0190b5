"""A background picture: read, made linear, and fitted to the frame.

It fills the frame as `cover` does in CSS: scaled with its proportions kept until nothing of the frame is bare, its
middle in the frame's, cut where it is longer. Pictures of 8 and 16 bits are sRGB, EXR is linear; scaling is done on
linear light. What is transparent in it shows the background colour.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.errors import OutputError
from graphfx.output import exr

FORMATS = (".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".bmp", ".exr")
MOST_PIXELS = 1 << 28


def linear(value: np.ndarray) -> np.ndarray:
    """Return the light of sRGB values in 0 ... 1, float32. [IEC 61966-2-1]

        v / 12.92                        v <= 0.04045
        ((v + 0.055) / 1.055)^2.4        else
    """
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4).astype(np.float32)


def covering(size: tuple[int, int], frame: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return the part (left, top, right, bottom) of a picture that fills a frame, in pixels of the picture.

    With s = min(w / W, h / H) it is W s wide and H s high, in the middle; W, H are the frame's size.
    """
    width, height = size
    scale = min(width / frame[0], height / frame[1])
    left, top = (width - frame[0] * scale) / 2, (height - frame[1] * scale) / 2
    return left, top, width - left, height - top


def read_backdrop(file: str, frame: tuple[int, int], color: tuple[float, float, float]) -> np.ndarray:
    """Return a picture fitted to a frame (width, height), linear float32 (height, width, 3), over a colour.

    Raise OutputError for what is no picture.
    """
    path = Path(file)
    if path.suffix.lower() not in FORMATS:
        raise OutputError(f"the picture {path.name} should be one of {', '.join(FORMATS)}")
    if path.suffix.lower() == ".exr" and not exr.is_there():
        raise OutputError(exr.INSTALL.replace("written", "read"))
    try:
        picture = exr.read_exr(path) if path.suffix.lower() == ".exr" else _decoded(path)
    except Exception as error:  # a reader of hostile files may fail in any way
        raise OutputError(f"the picture {path.name} cannot be read: {error}") from error
    if not np.isfinite(picture).all():
        raise OutputError(f"the picture {path.name} has numbers in it that are not finite")
    return _fitted(picture, frame, color)


def _decoded(path: Path) -> np.ndarray:
    """Return a picture's light, multiplied by its alpha: float32 (height, width, 4)."""
    from PIL import Image

    with Image.open(path) as opened:
        if opened.width * opened.height > MOST_PIXELS:
            raise ValueError(f"it has {opened.width * opened.height:,} pixels, and the most is {MOST_PIXELS:,}")
        numbers: Any = np.asarray(opened) if opened.mode.startswith("I;16") else np.asarray(opened.convert("RGBA"))
    if numbers.ndim == 2:
        light = linear(numbers / 65535.0)
        return np.stack([light, light, light, np.ones_like(light)], axis=-1)
    alpha = numbers[..., 3:].astype(np.float32) / np.float32(255.0)
    table = linear(np.arange(256) / 255.0)
    return np.concatenate([table[numbers[..., :3]] * alpha, alpha], axis=-1)


def _fitted(picture: np.ndarray, frame: tuple[int, int], color: tuple[float, float, float]) -> np.ndarray:
    """Return a premultiplied picture cut and scaled to a frame, over a colour."""
    from PIL import Image

    height, width = picture.shape[:2]
    part = covering((width, height), frame)
    planes = [
        np.asarray(Image.fromarray(np.ascontiguousarray(picture[..., plane])).resize(frame, Image.Resampling.BICUBIC, part))
        for plane in range(4)
    ] if (width, height) != frame else list(np.moveaxis(picture, -1, 0))
    scaled = np.stack(planes, axis=-1)
    behind = (1.0 - scaled[..., 3:].clip(0.0, 1.0)) * np.asarray(color, np.float32)
    return np.asarray(np.maximum(scaled[..., :3], 0.0) + behind, np.float32)
