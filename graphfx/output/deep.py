"""Deep OpenEXR pictures: for every pixel a list of samples. [The OpenEXR File Layout, openexr.com]

Written here, scan line by scan line as they come: the OpenEXR library takes an array for each pixel and channel
from Python, all at once, which is a hundred times the memory. A scan line is

    y, sizes (packed table, packed samples, samples), table of the pixels' running totals, samples by channel

compressed as ZIPS: the bytes at even places before those at odd places, each less the one before, plus 128, by zlib;
as they are where that is not smaller.
"""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, BinaryIO

import numpy as np

from graphfx.output.atomic import whole_file
from graphfx.store.threads import parallel

MAGIC, VERSION, DEEP = 20000630, 2, 0x800
ZIPS = 2
COMPRESSION = 4
"""zlib's level, the library's own."""
PIXEL_TYPES = {np.dtype(np.uint32): 0, np.dtype(np.float16): 1, np.dtype(np.float32): 2}


def _attribute(name: str, kind: str, data: bytes) -> bytes:
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def _stated(name: str, value: Any) -> bytes:
    """Return an attribute of the type that its value has."""
    if isinstance(value, str):
        return _attribute(name, "string", value.encode())
    if isinstance(value, int):
        return _attribute(name, "int", struct.pack("<i", value))
    if isinstance(value, float):
        return _attribute(name, "float", struct.pack("<f", value))
    return _attribute(name, "m44f", np.ascontiguousarray(value, "<f4").tobytes())


def header(width: int, height: int, channels: Mapping[str, np.dtype[Any]], attributes: Mapping[str, Any]) -> bytes:
    """Return the first part of a deep file, up to the table of places."""
    listed = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", PIXEL_TYPES[channels[name]], 0, 1, 1) for name in sorted(channels)
    )
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    parts = [
        _attribute("channels", "chlist", listed + b"\0"),
        _attribute("chunkCount", "int", struct.pack("<i", height)),
        _attribute("compression", "compression", bytes([ZIPS])),
        _attribute("dataWindow", "box2i", window),
        _attribute("displayWindow", "box2i", window),
        _attribute("lineOrder", "lineOrder", b"\0"),
        _attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0.0, 0.0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1.0)),
        _attribute("type", "string", b"deepscanline"),
        _attribute("version", "int", struct.pack("<i", 1)),
        *(_stated(name, value) for name, value in attributes.items()),
    ]
    return struct.pack("<ii", MAGIC, VERSION | DEEP) + b"".join(parts) + b"\0"


def packed(data: np.ndarray) -> bytes:
    """Return bytes compressed as ZIPS, or as they are."""
    if not data.size:
        return b""
    halves = np.concatenate([data[0::2], data[1::2]])
    halves[1:] -= halves[:-1].copy()
    halves[1:] += np.uint8(128)
    small = zlib.compress(halves.tobytes(), COMPRESSION)
    return small if len(small) < data.size else data.tobytes()


class DeepFile:
    """A deep file that is being written, row after row from the top."""

    def __init__(self, stream: BinaryIO, width: int, height: int, channels: Mapping[str, np.dtype[Any]],
                 attributes: Mapping[str, Any], threads: int):
        self.stream, self.width, self.names, self.threads = stream, width, sorted(channels), threads
        self.channels = channels
        stream.write(header(width, height, channels, attributes))
        self.table = stream.tell()
        self.places: list[int] = []
        stream.write(bytes(8 * height))

    def add(self, starts: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """Add rows: the samples of pixel p of these rows are starts[p] ... starts[p + 1] - 1 in every channel."""
        first = len(self.places)
        lines: list[bytes] = [b""] * ((len(starts) - 1) // self.width)

        def work(row: int) -> None:
            totals = starts[row * self.width : (row + 1) * self.width + 1]
            inside = slice(totals[0], totals[-1])
            table = (totals[1:] - totals[0]).astype("<i4").view(np.uint8)
            held = [np.ascontiguousarray(values[name][inside], self.channels[name].newbyteorder("<")) for name in self.names]
            samples = np.concatenate([column.view(np.uint8) for column in held])
            small_table, small = packed(table), packed(samples)
            sizes = struct.pack("<iQQQ", first + row, len(small_table), len(small), samples.size)
            lines[row] = sizes + small_table + small

        parallel(work, len(lines), self.threads)
        for line in lines:
            self.places.append(self.stream.tell())
            self.stream.write(line)

    def finish(self) -> None:
        """Write the table of the rows' places."""
        self.stream.seek(self.table)
        self.stream.write(struct.pack(f"<{len(self.places)}Q", *self.places))


@contextmanager
def deep_file(
    path: str | os.PathLike[str], width: int, height: int, channels: Mapping[str, np.dtype[Any]], attributes: Mapping[str, Any],
    threads: int = 1,
) -> Iterator[DeepFile]:
    """Open a deep file to which rows are added; it is there, whole, when the block ends well."""
    with whole_file(path) as stream:
        file = DeepFile(stream, width, height, channels, attributes, threads)
        yield file
        file.finish()
