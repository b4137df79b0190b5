"""Animated WebP and PNG, read back by Pillow; movies, read back by PyAV."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageSequence

from graphfx.output.animation import animated_png, animated_webp
from graphfx.output.video import h264, planes, prores, video

SIZE = (48, 26)
COLORS = [(200, 40, 30), (30, 180, 60), (20, 60, 220), (128, 128, 128), (255, 255, 255), (0, 0, 0)]


def frames(channels: int = 3) -> list[np.ndarray]:
    """Return a picture of each colour: its left half; the right half is a ramp of it."""
    width, height = SIZE
    ramp = np.minimum(1, np.linspace(2, 0, width))[None, :, None]
    pictures = [np.broadcast_to((np.array(color) * ramp).astype(np.uint8), (height, width, 3)) for color in COLORS]
    return [np.dstack([each, np.full((height, width), 200, np.uint8)]) if channels == 4 else each.copy() for each in pictures]


def filled(open_file: Callable[..., Any], path: Path, pictures: list[np.ndarray], *given: Any) -> Path:
    with open_file(path, *given) as add:
        for picture in pictures:
            add(picture)
    return path


def read(path: Path) -> tuple[list[np.ndarray], list[float]]:
    with Image.open(path) as animation:
        pairs = [(np.asarray(frame.copy()), frame.info["duration"]) for frame in ImageSequence.Iterator(animation)]
    return [picture for picture, _ in pairs], [duration for _, duration in pairs]


@pytest.mark.parametrize("channels", [3, 4])
def test_frames_without_loss(tmp_path: Path, channels: int):
    """Animated PNG and WebP at quality 100 give back every frame as it was."""
    given = frames(channels)
    for path in (filled(animated_png, tmp_path / "a.png", given, 24), filled(animated_webp, tmp_path / "a.webp", given, 24, 100)):
        got, durations = read(path)
        assert len(got) == len(COLORS) and sum(durations) == pytest.approx(len(COLORS) * 1000 / 24, abs=0.5)
        assert all((a == b).all() for a, b in zip(got, given, strict=True))


@pytest.mark.parametrize("channels", [3, 4])
def test_webp_is_near(tmp_path: Path, channels: int):
    """A WebP of the usual quality has the colours to a few levels."""
    given = frames(channels)
    got, _ = read(filled(animated_webp, tmp_path / "a.webp", given, 24))
    assert all(np.abs(a.astype(int) - b).mean() < 4 for a, b in zip(got, given, strict=True))


def test_durations_do_not_drift(tmp_path: Path):
    """At 23.976 frames a second the frames of a WebP end where they should to half a millisecond, those of a PNG exactly."""
    many = frames() * 8
    ends = np.cumsum(read(filled(animated_webp, tmp_path / "a.webp", many, 23.976))[1])
    assert np.abs(ends - np.arange(1, len(many) + 1) * 1000 / 23.976).max() <= 0.5
    durations = read(filled(animated_png, tmp_path / "a.png", many, 23.976))[1]
    assert sum(durations) == pytest.approx(len(many) * 1000 / 23.976, rel=1e-6)


def test_one_frame_and_odd_sizes(tmp_path: Path):
    """One frame alone, and frames of odd sizes, down to a pixel, are fine."""
    for width, height in ((1, 1), (7, 3), (64, 1)):
        picture = np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)
        for open_file, name, quality in ((animated_png, "a.png", ()), (animated_webp, "a.webp", (100,))):
            got, _ = read(filled(open_file, tmp_path / name, [picture], 24, *quality))
            assert len(got) == 1 and (got[0][..., :3] == picture).all()


MAKERS = [(animated_webp, "a.webp", (24, 80)), (animated_png, "a.png", (24,)), (video, "a.mp4", (24, h264(80))),
          (video, "a.mov", (24, prores(False)))]


@pytest.mark.parametrize(("open_file", "name", "given"), MAKERS, ids=lambda value: value if isinstance(value, str) else "")
def test_same_frames_same_bytes(tmp_path: Path, open_file: Callable[..., Any], name: str, given: tuple[Any, ...]):
    """The same pictures twice give the same file to the last byte."""
    one, two = (filled(open_file, tmp_path / f"{k}{name}", frames(), *given).read_bytes() for k in "12")
    assert one == two


@pytest.mark.parametrize(("open_file", "name", "given"), MAKERS, ids=lambda value: value if isinstance(value, str) else "")
def test_failure_leaves_nothing(tmp_path: Path, open_file: Callable[..., Any], name: str, given: tuple[Any, ...]):
    """When something fails between two frames nothing is left behind, and what was there before stays."""
    (tmp_path / name).write_bytes(b"before")
    with pytest.raises(KeyboardInterrupt), open_file(tmp_path / name, *given) as add:
        add(frames()[0])
        raise KeyboardInterrupt
    assert [(file.name, file.read_bytes()) for file in tmp_path.iterdir()] == [(name, b"before")]


@pytest.mark.parametrize(("name", "codec", "channels", "error"), [
    ("a.mp4", h264(80), 3, 4), ("a.mov", prores(False), 3, 4), ("b.mov", prores(True), 4, 1.01)])
def test_movie_has_the_frames(tmp_path: Path, name: str, codec: Any, channels: int, error: float):
    """A movie has every frame at its rate, in its colours to the codec's error, and says that they are BT.709's."""
    import av

    given = frames(channels)
    filled(video, tmp_path / name, given, 29.97, codec)
    with av.open(str(tmp_path / name)) as movie:
        stream = movie.streams.video[0]
        shown = [frame.to_ndarray(format="rgba") for frame in movie.decode(stream)]
        assert stream.average_rate == Fraction("29.97")
        assert (stream.width, stream.height) == SIZE
        context = stream.codec_context
        assert (context.colorspace, context.color_range) == (1, 1)
        if name == "a.mp4":
            assert (context.color_primaries, context.color_trc) == (1, 13)
    assert len(shown) == len(given)
    half = SIZE[0] // 2 - 8
    for picture, wanted in zip(shown, given, strict=True):
        difference = picture[:, :half, :channels].astype(float).mean(axis=(0, 1)) - wanted[0, 0]
        assert np.abs(difference).max() < error


def test_planes_are_those_of_the_standard():
    """White, black and the primaries have the codes of ITU-R BT.709-6, table 4.6, in 8 and 10 bits."""
    colors = np.array([[[255] * 3, [0] * 3, [255, 0, 0], [0, 255, 0], [0, 0, 255]]], np.uint8)
    wanted = [[235, 16, 63, 173, 32], [128, 128, 102, 42, 240], [128, 128, 240, 26, 118]]
    assert [plane[0].tolist() for plane in planes(colors, "yuv444p")] == wanted
    ten = np.array([plane[0] for plane in planes(colors, "yuv444p10le")])
    assert np.abs(ten / 4 - wanted).max() <= 0.5 and ten[0].tolist()[:2] == [940, 64]
    deep = planes(colors.astype(np.uint16) * 257, "yuv422p10le")
    assert all((one == other).all() for one, other in zip(deep, planes(colors, "yuv422p10le"), strict=True))


def test_movie_can_be_played_from_its_beginning(tmp_path: Path):
    """The index of a .mp4 stands before its frames, so that a player on a network can begin at once."""
    content = filled(video, tmp_path / "a.mp4", frames(), 24, h264(80)).read_bytes()
    assert 0 < content.index(b"moov") < content.index(b"mdat")


def test_memory_does_not_grow(tmp_path: Path):
    """What is kept of an animation does not grow with its frames: they are in the file before it ends."""
    picture = np.random.default_rng(0).integers(0, 256, (90, 160, 3), np.uint8)
    for open_file, name in ((animated_png, "a.png"), (animated_webp, "a.webp")):
        with open_file(tmp_path / name, 24) as add:
            sizes = []
            for _ in range(30):
                add(picture)
                sizes.append(next(tmp_path.glob(".*.part")).stat().st_size)
        whole = (tmp_path / name).stat().st_size
        assert sizes[-1] > 0.8 * whole and sizes[10] > 0.2 * whole
