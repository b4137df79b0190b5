"""Background pictures are read as light, and fill the frame."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from graphfx.cook.backdrop import covering, read_backdrop
from graphfx.errors import GraphError


def linear(value):
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize(("size", "frame", "part"), [
    ((100, 100), (50, 50), (0, 0, 100, 100)),
    ((200, 100), (50, 50), (50, 0, 150, 100)),  # too wide: cut left and right
    ((100, 300), (200, 100), (0, 125, 100, 175)),  # too high
    ((3, 3), (1920, 1080), (0, 0.65625, 3, 2.34375)),
])
def test_part_that_fills_the_frame(size, frame, part):
    """The greatest part of the frame's shape, in the middle."""
    assert covering(size, frame) == pytest.approx(part)


def test_picture_of_the_frames_size_is_kept_to_the_bit(tmp_path):
    """Each pixel is its own light, row 0 at the top."""
    picture = np.random.default_rng(0).integers(0, 256, (4, 6, 3), np.uint8)
    Image.fromarray(picture).save(tmp_path / "x.png")
    np.testing.assert_allclose(read_backdrop(str(tmp_path / "x.png"), (6, 4))[..., :3], linear(picture / 255.0), atol=1e-7)


def test_what_is_transparent_has_its_alpha(tmp_path):
    """A fifth of red, and as much alpha."""
    Image.fromarray(np.array([[[255, 0, 0, 51]]], np.uint8)).save(tmp_path / "x.png")
    np.testing.assert_allclose(read_backdrop(str(tmp_path / "x.png"), (1, 1)), [[[0.2, 0.0, 0.0, 0.2]]], atol=1e-6)


def test_scaling_is_done_on_light(tmp_path):
    """Black and white lines make a grey of half the light, which is 188 in sRGB, not 128."""
    lines = np.zeros((64, 64, 3), np.uint8)
    lines[:, ::2] = 255
    Image.fromarray(lines).save(tmp_path / "x.png")
    small = read_backdrop(str(tmp_path / "x.png"), (4, 4))
    np.testing.assert_allclose(small[1:3, 1:3, :3], 0.5, atol=0.02)


def test_scaled_picture_is_upright(tmp_path):
    """The upper left quarter stays there."""
    picture = np.zeros((40, 80, 3), np.uint8)
    picture[:20, :40] = 255
    Image.fromarray(picture).save(tmp_path / "x.png")
    scaled = read_backdrop(str(tmp_path / "x.png"), (8, 8))
    assert scaled[:3, :3].min() > 0.9 and scaled[5:, :, :3].max() < 0.1 and scaled[:, 5:, :3].max() < 0.1


def test_enlarged_picture_does_not_ring(tmp_path):
    """From a dark half to a light one light only rises, and both keep their own beside it."""
    picture = np.full((6, 6, 3), 100, np.uint8)
    picture[:, 3:] = 200
    Image.fromarray(picture).save(tmp_path / "x.png")
    row = read_backdrop(str(tmp_path / "x.png"), (60, 60))[30, :, 0]
    assert (np.diff(row) >= 0).all()
    np.testing.assert_allclose(row[[0, -1]], linear(np.array([100, 200]) / 255), rtol=1e-6)


def test_grey_of_sixteen_bits(tmp_path):
    """Numbers of 16 bits are read as such."""
    Image.fromarray(np.array([[0, 32768, 65535]], np.uint16)).save(tmp_path / "x.png")
    want = linear(np.array([0, 32768, 65535]) / 65535)
    np.testing.assert_allclose(read_backdrop(str(tmp_path / "x.png"), (3, 1))[0, :, 0], want, atol=1e-6)


def test_exr_is_light_already(tmp_path):
    """Lights beyond 1 stay."""
    pytest.importorskip("OpenEXR")
    from graphfx.output.exr import write_exr

    light = np.array([[[4.0, 0.5, 0.25, 1.0]]], np.float32)
    write_exr(tmp_path / "x.exr", light, {}, 32, {})
    np.testing.assert_array_equal(read_backdrop(str(tmp_path / "x.exr"), (1, 1)), light)


NO_PICTURE = "cannot be read: it is no picture that is known; give a PNG, JPEG, TIFF or another that Pillow reads"


@pytest.mark.parametrize(("name", "data", "message"), [
    ("x.txt", b"text", f"the picture x.txt {NO_PICTURE}"),
    ("x.png", b"", f"the picture x.png {NO_PICTURE}"),
    ("x.exr", b"text", "the picture x.exr cannot be read: "),
])
def test_what_is_no_picture(tmp_path, name, data, message):
    """A file that is none is refused, whatever is in it."""
    (tmp_path / name).write_bytes(data)
    with pytest.raises(GraphError) as caught:
        read_backdrop(str(tmp_path / name), (4, 4))
    assert str(caught.value).startswith(message)


def test_picture_cut_short(tmp_path):
    """Half a file is no picture."""
    Image.fromarray(np.random.default_rng(0).integers(0, 256, (64, 64, 3), np.uint8)).save(tmp_path / "x.png")
    (tmp_path / "x.png").write_bytes((tmp_path / "x.png").read_bytes()[:3000])
    with pytest.raises(GraphError, match=r"the picture x\.png cannot be read: "):
        read_backdrop(str(tmp_path / "x.png"), (4, 4))
