"""PNG pictures of 8 and 16 bits a number. [W3C, Portable Network Graphics, third edition]

Every row is filtered by `Up`, its difference from the row above: of the five filters it made the smallest files of
particles, or nearly so. Bands of rows are compressed apart, each to whole bytes, and follow one
another in one zlib stream; so several threads can make a file, and any number of them makes the same.
"""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Iterator

import numpy as np

from graphfx.output.atomic import whole_file
from graphfx.store.threads import parallel

SIGNATURE = b"\x89PNG\r\n\x1a\n"
UP = 2
"""The filter's number in the file."""
COMPRESSION = 4
"""zlib's level: faster than the usual 6, for a percent of the size."""
BAND = 64
"""Rows that are compressed together."""
ZLIB_HEADER = b"\x78\x5e"
SRGB = ((b"gAMA", struct.pack(">I", 45455)), (b"sRGB", b"\0"))
LINEAR = ((b"gAMA", struct.pack(">I", 100000)),)
"""What the numbers mean: the exponent that leads from light to them, times 100 000, and that sRGB is meant."""


def write_png(path: str | os.PathLike[str], picture: np.ndarray, linear: bool = False, threads: int = 1) -> None:
    """Write RGB or RGBA (height, width, 3 or 4), uint8 or uint16, alpha not multiplied in; `linear` if it is not sRGB."""
    with whole_file(path) as stream:
        stream.write(SIGNATURE)
        for name, data in _chunks(picture, linear, threads):
            stream.write(struct.pack(">I", len(data)))
            stream.write(name)
            stream.write(data)
            stream.write(struct.pack(">I", zlib.crc32(data, zlib.crc32(name))))


def _chunks(picture: np.ndarray, linear: bool, threads: int) -> Iterator[tuple[bytes, bytes]]:
    height, width, channels = picture.shape
    yield b"IHDR", struct.pack(">IIBBBBB", width, height, 8 * picture.itemsize, 6 if channels == 4 else 2, 0, 0, 0)
    yield from LINEAR if linear else SRGB
    for data in _compressed(picture, threads):
        yield b"IDAT", data
    yield b"IEND", b""


def _compressed(picture: np.ndarray, threads: int) -> list[bytes]:
    """Return the zlib stream of a picture, band by band."""
    height, tops = len(picture), range(0, len(picture), BAND)
    made: list[bytes] = [b""] * len(tops)
    sums = [(0, 0)] * len(tops)

    def work(band: int) -> None:
        rows = _filtered(picture, tops[band], min(tops[band] + BAND, height)).data
        squeeze = zlib.compressobj(COMPRESSION, wbits=-zlib.MAX_WBITS)
        last = band == len(tops) - 1
        made[band] = squeeze.compress(rows) + squeeze.flush(zlib.Z_FINISH if last else zlib.Z_FULL_FLUSH)
        sums[band] = zlib.adler32(rows), rows.nbytes

    parallel(work, len(tops), threads)
    made[0] = ZLIB_HEADER + made[0]
    total = 1
    for band, size in sums:
        total = joined_adler(total, band, size)
    made[-1] += struct.pack(">I", total)
    return made


def _filtered(picture: np.ndarray, top: int, bottom: int) -> np.ndarray:
    """Return rows as bytes, the greatest part of a number first, each less the row above and with the filter before it."""
    first = max(top - 1, 0)
    given = picture[first:bottom]
    numbers = np.ascontiguousarray(given, given.dtype.newbyteorder(">")).view(np.uint8).reshape(bottom - first, -1)
    rows = np.empty((bottom - top, numbers.shape[1] + 1), np.uint8)
    rows[:, 0] = UP
    if top == 0:
        rows[0, 1:] = numbers[0]
        np.subtract(numbers[1:], numbers[:-1], out=rows[1:, 1:])
    else:
        np.subtract(numbers[1:], numbers[:-1], out=rows[:, 1:])
    return rows


def joined_adler(first: int, second: int, size: int) -> int:
    """Return the Adler-32 of two pieces from those of each; the second has `size` bytes. [RFC 1950]

        a = 1 + sum of bytes,   b = sum of all a on the way,   both modulo 65521
    """
    base = 65521
    a = (first % 65536 + second % 65536 - 1) % base
    b = (first // 65536 + second // 65536 + size * (first % 65536 - 1)) % base
    return b * 65536 + a
