"""Extruded text: closed letters of the right size, in the right place; the font that is shipped may be."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from graphfx.errors import GraphError
from graphfx.geometry import Mesh, lettering, letters

pytest.importorskip("fontTools", reason="text is read by fonttools, the extra `text`")
pytest.importorskip("mapbox_earcut", reason="letters are filled by mapbox_earcut, the extra `text`")
PRINTABLE = "".join(map(chr, [*range(33, 127), *range(161, 173), *range(174, 384)]))


def text(line: str, size: float = 1.0, depth: float = 0.2, align: str = "center", tracking: float = 0.0) -> Mesh:
    """Return a line of text in the font that comes with graphfx."""
    return letters(line, size, depth, "", align, tracking, 5)


def test_every_letter_is_closed() -> None:
    """Each letter of the font that is shipped is a closed mesh with its outside out."""
    for letter in PRINTABLE:
        mesh = text(letter)
        assert mesh.open_edges() == 0, letter
        assert (mesh.corners.mean(axis=1) * mesh.crosses).sum() > 0, letter


def test_holes_stay_open() -> None:
    """An O is empty in the middle: its faces have the area of a ring, front and back."""
    mesh = text("O")
    front = mesh.face_normals[:, 2] > 0.5
    middle = (mesh.vertices[:, :2].min(axis=0) + mesh.vertices[:, :2].max(axis=0)) / 2
    assert np.sqrt(((mesh.corners[front].mean(axis=1)[:, :2] - middle) ** 2).sum(axis=1)).min() > 0.2


def test_letters_stand_on_the_line() -> None:
    """An H of 2 m em stands on y = 0, is as high as the font's capitals, and is half its depth to either side."""
    mesh = text("H", size=2.0, depth=0.5)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    assert (low[1], low[2], high[2]) == (0.0, -0.25, 0.25)
    assert high[1] == pytest.approx(2 * 1493 / 2048)


@pytest.mark.parametrize(("align", "ends"), [("left", (0, 1)), ("center", (-0.5, 0.5)), ("right", (-1, 0))])
def test_alignment(align: str, ends: tuple[float, float]) -> None:
    """A line lies right of, about, or left of x = 0."""
    mesh = text("HHHH", align=align)
    width = 4 * 1714 / 2048
    assert mesh.vertices[:, 0].min() / width == pytest.approx(ends[0], abs=0.04)
    assert mesh.vertices[:, 0].max() / width == pytest.approx(ends[1], abs=0.04)


def test_tracking_spreads_letters() -> None:
    """Three letters with a tracking of 0.5 em are one em wider: none is added after the last."""
    spread = [np.ptp(text("III", tracking=tracking).vertices[:, 0]) for tracking in (0.0, 0.5)]
    assert spread[1] - spread[0] == pytest.approx(1.0)


def test_a_second_line_lies_below() -> None:
    """A line break goes 1.2 em down."""
    assert text("H\nH").vertices[:, 1].min() == pytest.approx(-1.2)


@pytest.mark.parametrize(("line", "message"), [
    (" \n", "the text has nothing to show"),
    ("x" * 2001, "the text has 2001 letters; the most is 2000"),
    ("\u4e2d", "the font DejaVuSans-Bold.ttf has no letter '\u4e2d'; give one that has it"),
])
def test_what_cannot_be_written_is_told(line: str, message: str) -> None:
    """Nothing to show, too much, and a letter that the font has not are refused."""
    with pytest.raises(GraphError) as caught:
        text(line)
    assert str(caught.value) == message


def test_a_file_that_is_no_font_is_told(tmp_path: Path) -> None:
    """A font file with something else in it is refused by its name."""
    (tmp_path / "no.ttf").write_bytes(b"not a font")
    with pytest.raises(GraphError, match=r"the font no\.ttf cannot be read"):
        letters("A", 1, 1, str(tmp_path / "no.ttf"), "left", 0, 4)


@pytest.mark.parametrize(("module", "package"), [("fontTools.ttLib", "fonttools"), ("mapbox_earcut", "mapbox_earcut")])
def test_missing_libraries_are_told(module: str, package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a library is missing the message names it and the command to run."""
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(GraphError) as caught:
        text("A")
    assert str(caught.value) == f'text needs {package}, which is not installed; install it by: pip install "graphfx[text]"'


def test_the_font_is_small_and_has_its_licence() -> None:
    """The shipped font is a small one, with its licence beside it."""
    assert lettering.FONT.stat().st_size < 150_000
    assert "Permission is hereby granted, free of charge" in lettering.FONT.with_suffix(".LICENSE").read_text(encoding="utf-8")
