"""PNG files hold the numbers that they are given, and are whole or absent."""

from __future__ import annotations

import os
import struct
import zlib

import numpy as np
import pytest
from PIL import Image

from graphfx.errors import OutputError
from graphfx.output import png
from graphfx.output.atomic import whole_file
from graphfx.output.png import BAND, joined_adler, write_png

DRAW = np.random.default_rng(0)
PICTURE = DRAW.integers(0, 256, (5, 4, 3), np.uint8)
SHAPES = [(1, 1, 3), (1, 1, 4), (BAND, 7, 3), (BAND + 1, 5, 4), (3 * BAND - 1, 33, 3), (2, 3000, 4)]


def chunks(path):
    """Yield (name, data) of a PNG, with its signature and sums checked."""
    data = path.read_bytes()
    assert data[:8] == bytes([137, 80, 78, 71, 13, 10, 26, 10])
    at = 8
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0] == zlib.crc32(name + body)
        yield name.decode(), body
        at += 12 + size


def decoded(path):
    """Decode a PNG by the text of the standard, for the filters None and Up."""
    parts = list(chunks(path))
    assert (parts[0][0], parts[-1]) == ("IHDR", ("IEND", b""))
    width, height, bits, kind, *rest = struct.unpack(">IIBBBBB", parts[0][1])
    assert rest == [0, 0, 0]
    channels = {2: 3, 6: 4}[kind]
    rows = np.frombuffer(zlib.decompress(b"".join(body for name, body in parts if name == "IDAT")), np.uint8).reshape(height, -1)
    numbers, above = [], np.zeros(rows.shape[1] - 1, np.uint8)
    for row in rows:
        above = row[1:] + (above if row[0] == 2 else np.uint8(0))
        assert row[0] in (0, 2)
        numbers.append(above)
    return np.stack(numbers).view(np.uint8 if bits == 8 else ">u2").reshape(height, width, channels)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_numbers_come_back_from_the_file(tmp_path, shape, kind):
    """Every number of 8 and of 16 bits, row 0 at the top, whatever the number of bands."""
    picture = DRAW.integers(0, np.iinfo(kind).max + 1, shape, kind)
    write_png(tmp_path / "x.png", picture)
    np.testing.assert_array_equal(decoded(tmp_path / "x.png"), picture)


@pytest.mark.parametrize("shape", SHAPES)
def test_pillow_reads_the_same(tmp_path, shape):
    """Pillow's numbers are ours for 8 bits, and our greater bytes for 16, which is what it has of them."""
    picture = DRAW.integers(0, 65536, shape, np.uint16)
    write_png(tmp_path / "a.png", (picture >> 8).astype(np.uint8))
    write_png(tmp_path / "b.png", picture)
    for name in ("a.png", "b.png"):
        with Image.open(tmp_path / name) as opened:
            assert opened.mode == {3: "RGB", 4: "RGBA"}[shape[2]]
            np.testing.assert_array_equal(np.asarray(opened), picture >> 8)


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_threads_change_no_byte(tmp_path, kind):
    """One thread, two and nine make the same file."""
    picture = DRAW.integers(0, 9, (7 * BAND + 3, 40, 4)).astype(kind)
    for threads in (1, 2, 9):
        write_png(tmp_path / f"{threads}.png", picture, threads=threads)
    files = {(tmp_path / f"{threads}.png").read_bytes() for threads in (1, 2, 9)}
    assert len(files) == 1


def test_meaning_of_the_numbers_is_said(tmp_path):
    """sRGB, with the gamma for readers that do not know it; gamma 1 where they are light itself."""
    write_png(tmp_path / "a.png", PICTURE)
    write_png(tmp_path / "b.png", PICTURE, linear=True)
    with Image.open(tmp_path / "a.png") as a, Image.open(tmp_path / "b.png") as b:
        assert (a.info["gamma"], a.info["srgb"]) == (0.45455, 0)
        assert b.info["gamma"] == 1.0 and "srgb" not in b.info


def test_rows_that_repeat_are_small(tmp_path):
    """A megabyte of one colour is a few kilobytes."""
    write_png(tmp_path / "x.png", np.full((600, 600, 3), 77, np.uint8))
    assert (tmp_path / "x.png").stat().st_size < 6000


@pytest.mark.parametrize("sizes", [(0, 0), (0, 5), (5, 0), (1, 1), (65521, 65520), (300_000, 700_001)])
def test_joined_sums(sizes):
    """The sum of two pieces together, from those of each."""
    a, b = (DRAW.integers(0, 256, size, np.uint8).tobytes() for size in sizes)
    assert joined_adler(zlib.adler32(a), zlib.adler32(b), len(b)) == zlib.adler32(a + b)


@pytest.mark.parametrize("failure", [RuntimeError("stop"), KeyboardInterrupt()])
def test_file_that_fails_half_way_leaves_nothing(tmp_path, failure):
    """No part of a file, and no temporary one, is ever left."""
    with pytest.raises(type(failure)), whole_file(tmp_path / "x.png") as stream:
        stream.write(b"half")
        raise failure
    assert not list(tmp_path.iterdir())


def test_failing_writer_keeps_the_former_file(tmp_path, monkeypatch):
    """A picture that cannot be written leaves the one that was there."""
    path = tmp_path / "x.png"
    write_png(path, PICTURE)
    before = path.read_bytes()

    def full(picture, threads):
        yield b"half"
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(png, "compressed", full)
    with pytest.raises(OutputError, match=f"cannot write {path}: No space left on device"):
        write_png(path, PICTURE)
    assert [p.name for p in tmp_path.iterdir()] == ["x.png"] and path.read_bytes() == before


def test_folder_that_is_not_there_is_an_output_error(tmp_path):
    """The path and the system's reason are said."""
    with pytest.raises(OutputError, match="No such file or directory"):
        write_png(tmp_path / "no" / "x.png", PICTURE)


@pytest.mark.skipif(os.name == "nt", reason="POSIX permissions")
def test_file_has_the_usual_permissions(tmp_path):
    """As the process's mask gives them, not the private ones of temporary files."""
    mask = os.umask(0o022)
    try:
        write_png(tmp_path / "x.png", PICTURE)
    finally:
        os.umask(mask)
    assert (tmp_path / "x.png").stat().st_mode & 0o777 == 0o644
