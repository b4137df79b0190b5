"""Movies for players and editors: H.264 in .mp4 and ProRes in .mov, by PyAV (`pip install 'graphfx[video]'`).

Pictures are sRGB; their red, green and blue become luma and chroma by the matrix of ITU-R BT.709 in the limited range, and
the file says so, so that players show the colours of the stills. One thread encodes, and no date or name of an encoder is
written beside the pictures: the same pictures give the same bytes.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from importlib import import_module
from typing import Any

import numpy as np

from graphfx.errors import how_to_install
from graphfx.output.animation import Add
from graphfx.output.atomic import whole_path

BT709, SRGB, LIMITED = 1, 13, 1
"""How ITU-T H.273 numbers primaries and matrix, the transfer function of IEC 61966-2-1, and the range."""
LARGEST_H264, LARGEST_PRORES = 16384, 65535
"""Pixels that pictures of libx264 and of a .mov may be wide or high."""
RATE_DENOMINATOR = 1001
"""Frames per second are a fraction with at most this denominator: 30000 / 1001 is exact."""


@dataclass(frozen=True)
class Codec:
    """How pictures are encoded: `transfer` is what the file says of their transfer function.

    ProRes has no number for that of sRGB; there BT.709's stands for it, as is usual.
    """

    container: str
    name: str
    pixels: str
    transfer: int
    options: dict[str, str]


def h264(quality: float) -> Codec:
    """Return H.264 of a constant rate factor, 50 at quality 0 and 10 at 100."""
    return Codec("mp4", "libx264", "yuv420p", SRGB, {"crf": f"{50 - 0.4 * quality:g}", "preset": "medium"})


def prores(transparent: bool) -> Codec:
    """Return ProRes 4444 with alpha, or 422 HQ."""
    if transparent:
        return Codec("mov", "prores_ks", "yuva444p10le", BT709, {"profile": "4", "vendor": "apl0"})
    return Codec("mov", "prores_ks", "yuv422p10le", BT709, {"profile": "3", "vendor": "apl0"})


def fault() -> str:
    """Return what keeps movies from being encoded, or nothing."""
    try:
        import_module("av")
    except Exception as error:  # libraries of other versions make it fail in many ways
        return f"needs PyAV, {how_to_install(error, 'video')}"
    return ""


@contextmanager
def video(path: str | os.PathLike[str], fps: float, codec: Codec) -> Iterator[Add]:
    """Give a function that adds a frame to a movie; all frames are of one size, for H.264 an even one."""
    import av

    with whole_path(path) as temporary:
        try:
            options = {"movflags": "+faststart", "fflags": "+bitexact"}
            with av.open(str(temporary), "w", format=codec.container, options=options) as container:
                stream: Any = container.add_stream(codec.name, rate=Fraction(fps).limit_denominator(RATE_DENOMINATOR))
                stream.pix_fmt, stream.options = codec.pixels, codec.options
                context = stream.codec_context
                context.thread_count = 1
                context.flags |= av.codec.context.Flags.bitexact
                _say_colors(context, codec)

                def add(picture: np.ndarray) -> None:
                    if not context.is_open:
                        context.height, context.width = picture.shape[:2]
                    container.mux(stream.encode(_frame(picture, codec)))

                yield add
                container.mux(stream.encode())
        except av.FFmpegError as error:
            raise OSError(error.errno, error.strerror) from error


def _frame(picture: np.ndarray, codec: Codec) -> Any:
    import av

    frame = av.VideoFrame(picture.shape[1], picture.shape[0], codec.pixels)
    for plane, values in zip(frame.planes, planes(picture, codec.pixels), strict=True):
        lines = np.zeros((plane.height, plane.line_size // values.itemsize), values.dtype)
        lines[:, : values.shape[1]] = values
        plane.update(lines)
    _say_colors(frame, codec)
    return frame


def _say_colors(target: Any, codec: Codec) -> None:
    """Say of a frame, or of a stream's encoder, what its numbers mean."""
    target.color_primaries, target.color_trc = BT709, codec.transfer
    target.colorspace, target.color_range = BT709, LIMITED


def planes(picture: np.ndarray, pixels: str) -> list[np.ndarray]:
    """Return luma, both chromas and, where there is one, alpha of a picture of 8 or 16 bits, in FFmpeg's form `pixels`.

        Y = 0.2126 R + 0.7152 G + 0.0722 B,   Cb = (B - Y) / 1.8556,   Cr = (R - Y) / 1.5748      [ITU-R BT.709-6, 3]

    as 16 + 219 Y and 128 + 224 C, times 4 for 10 bits. Chroma lies on every other column, and where it is halved in
    height between two rows. (FFmpeg's own conversion gives other bytes from one run to the next.)
    """
    unit, step = np.float32(1.0 / np.iinfo(picture.dtype).max), np.float32(4.0 if "10" in pixels else 1.0)
    red, green, blue = (picture[..., c] * unit for c in range(3))
    luma = np.float32(0.2126) * red + np.float32(0.7152) * green + np.float32(0.0722) * blue
    chromas = [(blue - luma) / np.float32(1.8556), (red - luma) / np.float32(1.5748)]
    if "444" not in pixels:
        chromas = [_every_other_column(chroma) for chroma in chromas]
    if "420" in pixels:
        chromas = [(chroma[::2] + chroma[1::2]) * np.float32(0.5) for chroma in chromas]
    made = [(16 + 219 * luma) * step, *((128 + 224 * chroma) * step for chroma in chromas)]
    if pixels.startswith("yuva"):
        made.append(picture[..., 3] * (unit * (256 * step - 1)))
    return [np.rint(each).astype(np.uint16 if "10" in pixels else np.uint8) for each in made]


def _every_other_column(values: np.ndarray) -> np.ndarray:
    """Return columns 0, 2, ... of values, each with a quarter of either neighbour."""
    wide = np.pad(values, ((0, 0), (1, 1)), "edge")
    return (wide[:, :-2:2] + wide[:, 2::2]) * np.float32(0.25) + wide[:, 1:-1:2] * np.float32(0.5)
