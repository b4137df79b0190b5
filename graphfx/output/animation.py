"""Animated pictures, written frame by frame: WebP and PNG, by Pillow alone.

Pillow makes each frame a picture of its own; here its chunks are put into the file of them all, which is on the disk
before the next frame comes. So memory does not grow with the number of frames (Pillow's own way keeps all of them).
[WebP: RFC 9649, 2.7; animated PNG: PNG Specification, third edition, 2025, 11.3.5]
"""

from __future__ import annotations

import io
import os
import struct
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import BinaryIO

import numpy as np

from graphfx.errors import OutputError, Problem
from graphfx.output.atomic import whole_file
from graphfx.output.png import beginning, chunk, compressed

Add = Callable[[np.ndarray], None]
"""Takes the next frame: (height, width, 3 or 4) bytes of sRGB, red, green, blue and alpha."""
LARGEST_WEBP = 16383
"""Pixels that a WebP may be wide or high."""
LONGEST_DELAY = 65535
"""The greatest number in the fraction of a second for which a frame of a PNG is shown."""
EFFORT = 0
"""How hard to try to make pictures small that lose nothing, 0 to 100: all of it saves a hundredth, for a quarter more time."""
_RIFF_LIMIT = 2**32 - 10


@contextmanager
def animated_webp(path: str | os.PathLike[str], fps: float, quality: float = 80.0) -> Iterator[Add]:
    """Give a function that adds a frame to an animation that is played for ever; 100 is without loss.

    A frame is shown for a whole number of milliseconds, so that none is more than half of one from its time.
    """
    with whole_file(path) as stream:
        frames = 0

        def add(picture: np.ndarray) -> None:
            nonlocal frames
            height, width, channels = picture.shape
            if not frames:
                _begin_webp(stream, width, height, channels == 4)
            duration = round((frames + 1) * 1000 / fps) - round(frames * 1000 / fps)
            place = b"".join(number.to_bytes(3, "little") for number in (0, 0, width - 1, height - 1, duration))
            stream.write(_chunk(b"ANMF", place + b"\x02" + b"".join(_webp_chunks(picture, quality))))
            frames += 1

        yield add
        size = stream.tell() - 8
        if size > _RIFF_LIMIT:
            raise OutputError(Problem(f"cannot write {os.fspath(path)}: it would pass 4 GiB, the most that a WebP may be; "
                                      "write fewer or smaller frames, or a .mp4"))
        stream.seek(4)
        stream.write(struct.pack("<I", size))


def _begin_webp(stream: BinaryIO, width: int, height: int, alpha: bool) -> None:
    canvas = (width - 1).to_bytes(3, "little") + (height - 1).to_bytes(3, "little")
    flags = 0x02 | (0x10 if alpha else 0)
    stream.write(b"RIFF\0\0\0\0WEBP" + _chunk(b"VP8X", bytes([flags, 0, 0, 0]) + canvas) + _chunk(b"ANIM", bytes(6)))


def _chunk(name: bytes, content: bytes) -> bytes:
    """Return a chunk of a RIFF file, padded to an even length."""
    return name + struct.pack("<I", len(content)) + content + bytes(len(content) % 2)


def _webp_chunks(picture: np.ndarray, quality: float) -> Iterator[bytes]:
    """Yield the chunks that hold a picture: alpha, if there is any, and colours."""
    from PIL import Image

    made = io.BytesIO()
    lossless = quality >= 100
    Image.fromarray(picture).save(made, "WEBP", lossless=lossless, quality=EFFORT if lossless else quality, method=0, exact=True)
    content = made.getvalue()
    at = 12
    while at < len(content):
        name, size = content[at : at + 4], int.from_bytes(content[at + 4 : at + 8], "little")
        if name in (b"ALPH", b"VP8 ", b"VP8L"):
            yield _chunk(name, content[at + 8 : at + 8 + size])
        at += 8 + size + size % 2


@contextmanager
def animated_png(path: str | os.PathLike[str], fps: float) -> Iterator[Add]:
    """Give a function that adds a frame to an animation that is played for ever; nothing is lost.

    A reader that knows no animations shows the first frame.
    """
    shown = Fraction(1 / Fraction(fps).limit_denominator(10**6)).limit_denominator(LONGEST_DELAY)
    with whole_file(path) as stream:
        frames = numbered = counted_at = 0

        def add(picture: np.ndarray) -> None:
            nonlocal frames, numbered, counted_at
            height, width, _ = picture.shape
            data = b"".join(compressed(picture))
            if not frames:
                stream.write(beginning(picture))
                counted_at = stream.tell()
                stream.write(chunk(b"acTL", bytes(8)))
            control = struct.pack(">IIIIIHHBB", numbered, width, height, 0, 0, shown.numerator, shown.denominator, 0, 0)
            stream.write(chunk(b"fcTL", control))
            numbered += 1
            if frames:
                stream.write(chunk(b"fdAT", struct.pack(">I", numbered) + data))
                numbered += 1
            else:
                stream.write(chunk(b"IDAT", data))
            frames += 1

        yield add
        stream.write(chunk(b"IEND", b""))
        stream.seek(counted_at)
        stream.write(chunk(b"acTL", struct.pack(">II", frames, 0)))
