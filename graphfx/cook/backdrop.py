"""A background picture: read, made linear, and fitted to the frame.

It fills the frame as `cover` does in CSS: scaled with its proportions kept until nothing of the frame is bare, its
middle in the frame's, cut where it is longer. Pictures of 8 and 16 bits are sRGB, floats linear; scaling is done on
linear light. What is transparent in it shows the background colour.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from graphfx.cook.textures import load_light
from graphfx.errors import GraphError
from graphfx.output import exr


def covering(size: tuple[int, int], frame: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return the part (left, top, right, bottom) of a picture that fills a frame, in pixels of the picture.

    With s = min(w / W, h / H) it is W s wide and H s high, in the middle; W, H are the frame's size.
    """
    width, height = size
    scale = min(width / frame[0], height / frame[1])
    left, top = (width - frame[0] * scale) / 2, (height - frame[1] * scale) / 2
    return left, top, width - left, height - top


def read_backdrop(file: str, frame: tuple[int, int]) -> np.ndarray:
    """Return a picture fitted to a frame (width, height), linear float32 (height, width, 4), multiplied by its alpha.

    Raise GraphError for what is no picture, LimitError for one that is too large.
    """
    return _fitted(_read_exr(file) if file.lower().endswith(".exr") else _premultiplied(load_light(file)), frame)


def _premultiplied(light: np.ndarray) -> np.ndarray:
    if light.shape[2] == 3:
        return np.concatenate([light, np.ones_like(light[..., :1])], axis=2)
    return np.concatenate([light[..., :3] * light[..., 3:], light[..., 3:]], axis=2)


def _read_exr(file: str) -> np.ndarray:
    name = Path(file).name
    if fault := exr.fault("read"):
        raise GraphError(fault)
    try:
        light = exr.read_exr(file)
    except Exception as error:  # a reader of hostile files may fail in any way
        raise GraphError(f"the picture {name} cannot be read: {error}") from error
    if not np.isfinite(light).all():
        raise GraphError(f"the picture {name} has numbers in it that are not finite")
    return light


def _fitted(picture: np.ndarray, frame: tuple[int, int]) -> np.ndarray:
    """Return a premultiplied picture cut and scaled to a frame: enlarged by bilinear interpolation, which does not ring."""
    from PIL import Image

    height, width = picture.shape[:2]
    part = covering((width, height), frame)
    way = Image.Resampling.BILINEAR if part[2] - part[0] < frame[0] else Image.Resampling.BICUBIC
    planes = [
        np.asarray(Image.fromarray(np.ascontiguousarray(picture[..., plane])).resize(frame, way, part))
        for plane in range(4)
    ] if (width, height) != frame else list(np.moveaxis(picture, -1, 0))
    scaled = np.maximum(np.stack(planes, axis=-1), 0.0)
    scaled[..., 3] = scaled[..., 3].clip(0.0, 1.0)
    return scaled
