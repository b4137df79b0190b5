"""The README shows every effect, and the pictures that it shows are there."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from PIL import Image

from tests.marked import part_of, with_part

from .gallery import GALLERY, HEAVIEST, LENGTHS, README, STEP, SUFFIXES, WIDE, text, window
from .goldens import EFFECTS, data_of


def test_readme_shows_every_effect() -> None:
    """The README's gallery is what the effects say of themselves; `python tests/effects/gallery.py --text` writes it."""
    assert part_of(README.read_text(encoding="utf-8"), "gallery") == text(EFFECTS)


def test_readme_says_what_every_effect_takes() -> None:
    """The README's table has a row for each effect; `python tests/benchmarks/effects.py --page NAME` measures and writes it."""
    table = part_of(README.read_text(encoding="utf-8"), "effects")
    assert re.findall(r"^\| (\w+) \| [\d,]+ \| \d+ of \d+ \|", table, re.MULTILINE) == list(EFFECTS)


def test_every_picture_is_of_an_effect() -> None:
    """Each effect has its pictures, and nothing else is there; `python tests/effects/gallery.py NAME` makes them."""
    assert {file.name for file in GALLERY.iterdir()} == {f"{name}{suffix}" for name in EFFECTS for suffix in SUFFIXES}


def durations(moving: Image.Image) -> Iterator[int]:
    """Return how long each picture of an animation is shown [ms]; those that are alike in a row are one."""
    for number in range(moving.n_frames):  # type: ignore[attr-defined]
        moving.seek(number)
        moving.load()
        yield moving.info["duration"]


@pytest.mark.parametrize("name", sorted({file.stem for file in GALLERY.iterdir()}))
def test_pictures_are_as_large_as_they_should_be(name: str) -> None:
    """A poster is 1280 x 720; an animation has its width, plays for ever, shows every second frame in its time, and is light."""
    fps, file = data_of(name)["time"]["fps"], GALLERY / f"{name}.webp"
    with Image.open(GALLERY / f"{name}.jpg") as poster:
        assert poster.size == (1280, 720)
    with Image.open(file) as moving:
        assert moving.size == (WIDE, 180) and moving.info["loop"] == 0
        assert sum(durations(moving)) in {count * round(1000 * STEP / fps) for count in LENGTHS}
    assert file.stat().st_size <= HEAVIEST


@pytest.mark.parametrize(("first", "last", "poster"), [(1, 240, 120), (1, 240, 5), (1, 240, 238), (1, 96, 50), (0, 119, 60)])
def test_animations_hold_the_poster(first: int, last: int, poster: int) -> None:
    """An animation's frames are the graph's, as many as asked for where there are, the poster's among them or beside one."""
    for pictures in LENGTHS:
        frames = window(first, last, poster, pictures)
        assert first <= frames[0] and frames[-1] <= last and len(frames) == min(pictures, (last - first) // STEP + 1)
        assert min(abs(frame - poster) for frame in frames) < STEP


def test_marked_parts() -> None:
    """What stands between the marks is read and replaced, and nothing else; marks that are missing are told."""
    whole = "a\n<!-- x -->\nold\n<!-- end of x -->\nb\n"
    assert part_of(whole, "x") == "old\n"
    assert with_part(whole, "x", "new\nlines\n") == "a\n<!-- x -->\nnew\nlines\n<!-- end of x -->\nb\n"
    for wrong in ("", "<!-- x -->\n", "<!-- end of x -->\n<!-- x -->\n", whole + whole):
        with pytest.raises(ValueError, match="once each"):
            part_of(wrong, "x")
