"""PNG files hold what the film says, and are whole or absent."""

from __future__ import annotations

import os

import numpy as np
import pytest
from PIL import Image

from graphfx.errors import OutputError
from graphfx.output import png
from graphfx.output.atomic import whole_file
from graphfx.output.png import eight_bit, over, srgb, straight, write_png

HALF = np.array([[[0.25, 0.125, 0.0, 0.5]]], np.float32)
"""One pixel, half covered by (0.5, 0.25, 0)."""


def test_srgb_of_known_values():
    """0, 1 and middle grey are where IEC 61966-2-1 has them; the curve has no step and never falls."""
    np.testing.assert_allclose(srgb(np.array([-1, 0, 0.214041, 1, 7.0])), [0, 0, 0.5, 1, 1], atol=1e-6)
    curve = srgb(np.linspace(0, 1, 100001))
    assert (np.diff(curve) > 0).all() and np.diff(curve).max() < 2e-4


def test_background_shows_through():
    """Film + (1 - alpha) background, linear."""
    np.testing.assert_allclose(over(HALF, (1, 1, 0.5)), [[[0.75, 0.625, 0.25]]])


def test_transparent_colours_are_divided_by_alpha():
    """Premultiplied (0.25, 0.125, 0, 0.5) is (0.5, 0.25, 0) at alpha 0.5; nothing is nothing."""
    np.testing.assert_allclose(straight(HALF), [[[0.5, 0.25, 0.0, 0.5]]])
    assert not straight(np.zeros((1, 1, 4), np.float32)).any()


def test_flames_keep_their_light_over_black():
    """Light without alpha gets the alpha to show: colour times alpha is the light."""
    flame = np.array([[[0.3, 0.2, 0.1, 0.0]]], np.float32)
    picture = straight(flame)
    np.testing.assert_allclose(picture[..., :3] * picture[..., 3:], flame[..., :3], rtol=1e-6)


def test_picture_comes_back_from_the_file(tmp_path):
    """RGBA without a background, RGB with one, row 0 at the top."""
    film = np.zeros((2, 3, 4), np.float32)
    film[0, 2] = (1.0, 0.21586, 0.0, 1.0)
    write_png(tmp_path / "a.png", film)
    write_png(tmp_path / "b.png", film, (0.0, 0.0, 1.0))
    transparent, opaque = (np.asarray(Image.open(tmp_path / name)) for name in ("a.png", "b.png"))
    assert transparent.shape == (2, 3, 4) and tuple(transparent[0, 2]) == (255, 128, 0, 255) and transparent[1].max() == 0
    assert opaque.shape == (2, 3, 3) and tuple(opaque[0, 2]) == (255, 128, 0) and tuple(opaque[1, 0]) == (0, 0, 255)


def test_rounding_is_to_the_nearest():
    """Alpha of k / 255 is the byte k."""
    film = np.zeros((1, 256, 4), np.float32)
    film[0, :, 3] = np.arange(256) / 255
    assert (eight_bit(film)[0, :, 3] == np.arange(256)).all()


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
    write_png(path, HALF)
    before = path.read_bytes()

    def half(image, stream, *rest, **named):
        stream.write(b"\x89PNG half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", half)
    with pytest.raises(OutputError, match=f"cannot write {path}: No space left on device"):
        write_png(path, HALF)
    assert [p.name for p in tmp_path.iterdir()] == ["x.png"] and path.read_bytes() == before


def test_folder_that_is_not_there_is_an_output_error(tmp_path):
    """The path and the system's reason are said."""
    with pytest.raises(OutputError, match="No such file or directory"):
        write_png(tmp_path / "no" / "x.png", HALF)


@pytest.mark.skipif(os.name == "nt", reason="POSIX permissions")
def test_file_has_the_usual_permissions(tmp_path):
    """As the process's mask gives them, not the private ones of temporary files."""
    mask = os.umask(0o022)
    try:
        png.write_png(tmp_path / "x.png", HALF)
    finally:
        os.umask(mask)
    assert (tmp_path / "x.png").stat().st_mode & 0o777 == 0o644
