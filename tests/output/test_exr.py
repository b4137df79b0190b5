"""EXR files, flat and deep, hold what they are given; the OpenEXR library reads them back."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.errors import OutputError
from graphfx.output.deep import deep_file
from graphfx.output.exr import read_exr, write_exr

OpenEXR = pytest.importorskip("OpenEXR")
DRAW = np.random.default_rng(0)
SAID = {"frame": 7, "time": 0.25, "graph": "snow", "seed": "18446744073709551615",
        "worldToCamera": np.arange(16, dtype=np.float32).reshape(4, 4)}


def read(path):
    """Return the header and the channels."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return dict(file.header()), {name: channel.pixels for name, channel in file.channels().items()}


def film(height=9, width=5):
    return DRAW.normal(0.5, 2.0, (height, width, 4)).astype(np.float32)


def hold_attributes(header):
    for name, value in SAID.items():
        np.testing.assert_array_equal(header[name], value)


@pytest.mark.parametrize(("bits", "kind"), [(16, np.float16), (32, np.float32)])
def test_light_comes_back_from_the_file(tmp_path, bits, kind):
    """Every number as the nearest half or as it is, row 0 at the top, beside further channels that are never halves."""
    pixels, depth = film(), DRAW.random((9, 5), np.float32)
    ids = DRAW.integers(0, 2**32, (9, 5), np.uint32)
    write_exr(tmp_path / "x.exr", pixels, {"Z": depth, "id": ids}, bits, SAID)
    header, channels = read(tmp_path / "x.exr")
    for plane, name in enumerate("RGBA"):
        assert channels[name].dtype == kind
        np.testing.assert_array_equal(channels[name], pixels[..., plane].astype(kind))
    np.testing.assert_array_equal(channels["Z"], depth)
    np.testing.assert_array_equal(channels["id"], ids)
    assert (channels["Z"].dtype, channels["id"].dtype, len(channels)) == (np.float32, np.uint32, 6)
    assert header["compression"] == OpenEXR.ZIP_COMPRESSION
    hold_attributes(header)


def test_light_beyond_a_half_is_the_greatest_half(tmp_path):
    """No infinity comes of a bright light."""
    pixels = np.array([[[1e30, 65504, -1e9, 1.0]]], np.float32)
    write_exr(tmp_path / "x.exr", pixels, {}, 16, {})
    np.testing.assert_array_equal(read_exr(tmp_path / "x.exr"), [[[65504, 65504, -65504, 1.0]]])


def test_same_film_gives_the_same_bytes(tmp_path):
    """No date or number of a run is in the file."""
    pixels = film()
    for name in "ab":
        write_exr(tmp_path / f"{name}.exr", pixels, {}, 16, SAID)
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()


def test_file_that_cannot_be_written_is_an_output_error(tmp_path):
    """The path and the system's reason are said."""
    with pytest.raises(OutputError, match="No such file or directory"):
        write_exr(tmp_path / "no" / "x.exr", film(), {}, 16, {})


def test_grey_is_read_as_three_colours(tmp_path):
    """A file with Y alone is grey and opaque; one without light is refused."""
    grey = DRAW.random((3, 4), np.float32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"Y": grey}).write(str(tmp_path / "y.exr"))
    np.testing.assert_array_equal(read_exr(tmp_path / "y.exr"), np.stack([grey, grey, grey, np.ones_like(grey)], axis=-1))
    OpenEXR.File(header, {"Z": grey}).write(str(tmp_path / "z.exr"))
    with pytest.raises(ValueError, match="it has the channels Z, and R, G, B are wanted"):
        read_exr(tmp_path / "z.exr")


TYPES = {"R": np.dtype(np.float16), "A": np.dtype(np.float32), "Z": np.dtype(np.float32), "id": np.dtype(np.uint32),
         "velocity.X": np.dtype(np.float32)}


def samples(counts):
    """Return random values for so many samples."""
    total = int(np.sum(counts))
    return {name: (DRAW.random(total) * 1000).astype(kind) for name, kind in TYPES.items()}


def write_deep(path, counts, values, width, rows=16, threads=1, attributes=SAID):
    """Write a deep file, some rows at a time."""
    starts = np.concatenate([[0], np.cumsum(counts)])
    height = len(counts) // width
    with deep_file(path, width, height, TYPES, attributes, threads) as file:
        for top in range(0, height, rows):
            part = starts[top * width : min(top + rows, height) * width + 1]
            file.add(part - part[0], {name: column[part[0] : part[-1]] for name, column in values.items()})
    return starts


@pytest.mark.parametrize(("width", "height", "most"), [(1, 1, 3), (37, 29, 6), (16, 16, 1), (3, 40, 200), (50, 5, 0)])
def test_samples_come_back_from_the_file(tmp_path, width, height, most):
    """All samples of every pixel, in order; a pixel may have none, a file too."""
    counts = DRAW.integers(0, most + 1, width * height)
    values = samples(counts)
    starts = write_deep(tmp_path / "x.exr", counts, values, width)
    header, channels = read(tmp_path / "x.exr")
    assert set(channels) == set(TYPES) and header["type"] == OpenEXR.deepscanline
    hold_attributes(header)
    for name, kind in TYPES.items():
        for pixel, count in enumerate(counts):
            got = channels[name][pixel // width, pixel % width]
            assert (0 if got is None else len(got)) == count
            if count:
                assert got.dtype == kind
                np.testing.assert_array_equal(got, values[name][starts[pixel] : starts[pixel + 1]])


def test_numbers_that_do_not_compress_are_kept_as_they_are(tmp_path):
    """Noise is written plain, and read; it takes no more than it is."""
    counts = np.full(8, 500)
    values = {name: DRAW.integers(0, 256, 4000 * kind.itemsize, np.uint8).view(kind) for name, kind in TYPES.items()}
    write_deep(tmp_path / "x.exr", counts, values, 8)
    _, channels = read(tmp_path / "x.exr")
    assert (tmp_path / "x.exr").stat().st_size < sum(column.nbytes for column in values.values()) + 1000
    for name, column in values.items():
        assert np.concatenate(list(channels[name][0])).tobytes() == column.tobytes()


def test_threads_and_bands_change_no_byte(tmp_path):
    """Rows added one at a time or all together, by one thread or by five, make one file."""
    counts = DRAW.integers(0, 9, 20 * 31)
    values = samples(counts)
    made = set()
    for rows, threads in ((1, 1), (16, 5), (31, 2)):
        write_deep(tmp_path / "x.exr", counts, values, 20, rows, threads)
        made.add((tmp_path / "x.exr").read_bytes())
    assert len(made) == 1


def test_deep_file_that_fails_leaves_nothing(tmp_path):
    """Half a deep file is none."""
    with pytest.raises(RuntimeError), deep_file(tmp_path / "x.exr", 4, 4, TYPES, {}):
        raise RuntimeError("stop")
    assert not list(tmp_path.iterdir())
