"""PNG pictures of 8 and 16 bits a number. [W3C, Portable Network Graphics, third edition]

Every row is filtered by `Up`, its difference from the row above: of the five filters it made the smallest files of
particles, or nearly so. Of what is left only runs are sought (zlib's strategy for pictures): a third of the time of
its level 4, for files between a twentieth smaller and a fifth larger. Bands of rows are compressed apart, each to
whole bytes, and follow one another in one zlib stream; so several threads can make a file, and any number of them
makes the same.
"""

from __future__ import annotations

import os
import struct
import zlib

import numpy as np

from graphfx.output.atomic import whole_file
from graphfx.store.threads import parallel

SIGNATURE = b"\x89PNG\r\n\x1a\n"
UP = 2
"""The filter's number in the file."""
BAND = 64
"""Rows that are compressed together."""
ZLIB_HEADER = b"\x78\x5e"
SRGB = ((b"gAMA", struct.pack(">I", 45455)), (b"sRGB", b"\0"))
LINEAR = ((b"gAMA", struct.pack(">I", 100000)),)
"""What the numbers mean: the exponent that leads from light to them, times 100 000, and that sRGB is meant."""


def write_png(path: str | os.PathLike[str], picture: np.ndarray, linear: bool = False, threads: int = 1) -> None:
    """Write RGB or RGBA (height, width, 3 or 4), uint8 or uint16, alpha not multiplied in; `linear` if it is not sRGB."""
    with whole_file(path) as stream:
        stream.write(beginning(picture, linear))
        for data in compressed(picture, threads):
            stream.write(chunk(b"IDAT", data))
        stream.write(chunk(b"IEND", b""))


def chunk(name: bytes, content: bytes) -> bytes:
    """Return a chunk of a PNG with its size and sum."""
    return b"".join([struct.pack(">I", len(content)), name, content, struct.pack(">I", zlib.crc32(content, zlib.crc32(name)))])


def beginning(picture: np.ndarray, linear: bool = False) -> bytes:
    """Return the first bytes of a PNG: what it is, and what its numbers mean."""
    height, width, channels = picture.shape
    head = struct.pack(">IIBBBBB", width, height, 8 * picture.itemsize, 6 if channels == 4 else 2, 0, 0, 0)
    return SIGNATURE + chunk(b"IHDR", head) + b"".join(chunk(*meaning) for meaning in (LINEAR if linear else SRGB))


def compressed(picture: np.ndarray, threads: int = 1) -> list[bytes]:
    """Return the zlib stream of a picture, band by band."""
    height, tops = len(picture), range(0, len(picture), BAND)
    made: list[bytes] = [b""] * len(tops)
    sums = [(0, 0)] * len(tops)

    def work(band: int) -> None:
        rows = _filtered(picture, tops[band], min(tops[band] + BAND, height)).data
        squeeze = zlib.compressobj(wbits=-zlib.MAX_WBITS, strategy=zlib.Z_RLE)
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
