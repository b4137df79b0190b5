"""OpenEXR pictures, by the OpenEXR library, which is imported only here: linear light, multiplied by alpha.

    R G B A         half or float                Z         float, m along the camera's axis
    name.X name.Y   float                        whole numbers: UINT

Compressed as ZIP. A half cannot be greater than 65504; light beyond it is written as that.
"""

from __future__ import annotations

import io
import os
from collections.abc import Mapping
from importlib import import_module
from typing import Any

import numpy as np

from graphfx.errors import how_to_install
from graphfx.output.atomic import whole_file

GREATEST_HALF = 65504.0


def fault(done: str = "written") -> str:
    """Return what keeps EXR files from being written, or read, or nothing."""
    try:
        import_module("OpenEXR")
    except Exception as error:  # libraries of other versions make it fail in many ways
        return f"EXR files are {done} by OpenEXR, {how_to_install(error, 'exr')}"
    return ""


def as_half(values: np.ndarray) -> np.ndarray:
    """Return values as the nearest halves, the greatest where they are beyond it."""
    return values.clip(-GREATEST_HALF, GREATEST_HALF).astype(np.float16)


def write_exr(
    path: str | os.PathLike[str], film: np.ndarray, channels: Mapping[str, np.ndarray], bits: int, attributes: Mapping[str, Any],
) -> None:
    """Write a film (height, width, 4) and further channels (height, width), float32 or uint32, with attributes.

    Attributes are whole numbers, numbers, texts, and float32 matrices (4, 4) for row vectors.
    """
    import OpenEXR

    made = film if bits == 32 else as_half(film)
    held = {name: np.ascontiguousarray(made[..., plane]) for plane, name in enumerate("RGBA")}
    held |= {name: np.ascontiguousarray(values) for name, values in channels.items()}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **attributes}
    whole = io.BytesIO()
    OpenEXR.File(header, held, num_threads=0).write(whole)
    with whole_file(path) as stream:
        stream.write(whole.getbuffer())


def read_exr(path: str | os.PathLike[str]) -> np.ndarray:
    """Return the light of a flat EXR, multiplied by alpha: float32 (height, width, 4); grey where it has but Y."""
    import OpenEXR

    with OpenEXR.File(os.fspath(path), separate_channels=True) as file:
        channels = {name: np.asarray(channel.pixels) for name, channel in file.channels().items()}
    planes = [channels[name] for name in (name if name in channels else "Y" for name in "RGB") if name in channels]
    if len(planes) < 3 or any(plane.dtype == object for plane in planes):
        raise ValueError(f"it has the channels {', '.join(channels)}, and R, G, B are wanted")
    alpha = channels.get("A", np.ones_like(planes[0]))
    return np.stack([*planes, alpha], axis=-1).astype(np.float32)
