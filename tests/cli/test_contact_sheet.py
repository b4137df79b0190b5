"""`graphfx contact-sheet`: frames side by side, from a graph or from pictures that are there."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from graphfx.output.contact_sheet import FOOT, GAP

from .conftest import FOUNTAIN


def cells(file: Path, columns: int, size: tuple[int, int], count: int) -> list[np.ndarray]:
    """Return the pictures of a sheet."""
    with Image.open(file) as sheet:
        rows = -(-count // columns)
        assert sheet.size == (columns * (size[0] + GAP) + GAP, rows * (size[1] + FOOT) + GAP)
        pixels = np.asarray(sheet)
    corners = [(GAP + at // columns * (size[1] + FOOT), GAP + at % columns * (size[0] + GAP)) for at in range(count)]
    return [pixels[top : top + size[1], left : left + size[0]] for top, left in corners]


def cooked(invoke, folder: Path, *arguments: str) -> list[np.ndarray]:
    """Return the fountain's frames as `cook` writes them into `stills`."""
    assert invoke("cook", "fountain.json", "--out", "stills", *arguments).code == 0
    return [np.asarray(Image.open(file)) for file in sorted((folder / "stills").iterdir())]


def test_cells_are_frames_of_a_cook(invoke, folder: Path) -> None:
    """A sheet has the frames that `cook` writes, in order, in rows that are about as many as columns."""
    code, out, err = invoke("contact-sheet", "fountain.json")
    file = Path("out", "fountain.contact-sheet.png")
    assert (code, out.partition(" (")[0]) == (0, f"wrote {file}")
    assert [line.partition(":")[0] for line in err.splitlines() if line.startswith("frame")] == [
        f"frame {frame} ({frame} of 6)" for frame in range(1, 7)]
    shown, wanted = cells(file, 3, (32, 18), 6), cooked(invoke, folder)
    assert all((one == other).all() for one, other in zip(shown, wanted, strict=True))
    assert [file.name for file in (folder / "out").iterdir()] == ["fountain.contact-sheet.png"]


def test_chosen_frames_and_columns(invoke, folder: Path) -> None:
    """--frames, --columns, --set and --out say what is shown and how."""
    assert invoke("contact-sheet", "fountain.json", "--frames", "2-6x2", "--columns", "2", "--set", "speed=5",
                  "--out", "a/b.png").code == 0
    shown = cells(folder / "a" / "b.png", 2, (32, 18), 3)
    wanted = cooked(invoke, folder, "--frames", "2-6x2", "--set", "speed=5")
    assert all((one == other).all() for one, other in zip(shown, wanted, strict=True))


def test_sixteen_frames_from_the_first_to_the_last(invoke, folder: Path) -> None:
    """Without --frames a long graph is shown at 16 frames, evenly, both ends among them."""
    (folder / "long.json").write_text(json.dumps({**FOUNTAIN, "time": {"frames": [11, 61]}}))
    _, _, err = invoke("contact-sheet", "long.json")
    frames = [int(line.split()[1]) for line in err.splitlines() if line.startswith("frame")]
    assert len(frames) == 16 and (frames[0], frames[-1]) == (11, 61)
    assert set(np.diff(frames)) == {3, 4}


def test_same_bytes_on_any_number_of_threads(invoke, folder: Path) -> None:
    """One and three threads make the same file."""
    for name, threads in (("a", "1"), ("b", "3")):
        assert invoke("contact-sheet", "fountain.json", "--out", f"{name}.png", "--threads", threads).code == 0
    assert (folder / "a.png").read_bytes() == (folder / "b.png").read_bytes()


@pytest.mark.parametrize(("size", "wanted"), [((), (320, 134)), (("--size", "100"), (100, 42)), (("--size", "50x51"), (50, 51))])
def test_sizes(invoke, folder: Path, size: tuple[str, ...], wanted: tuple[int, int]) -> None:
    """Large images are shown 320 pixels wide, or as wide as is asked for, in their shape; or to the pixel."""
    nodes = FOUNTAIN["nodes"] | {"frames": FOUNTAIN["nodes"]["frames"] | {"size": [1920, 800]}}
    (folder / "wide.json").write_text(json.dumps({**FOUNTAIN, "nodes": nodes}))
    assert invoke("contact-sheet", "wide.json", "--frames", "3", "--out", "a.png", *size).code == 0
    cells(folder / "a.png", 1, wanted, 1)


def test_pictures_that_are_there(invoke, folder: Path) -> None:
    """A folder of stills and an animation of the same frames make the sheet that the graph makes."""
    invoke("contact-sheet", "fountain.json", "--out", "graph.png")
    cooked(invoke, folder)
    movie = {"type": "movie", "image": "frames", "file": "moving.png"}
    (folder / "movie.json").write_text(json.dumps({**FOUNTAIN, "nodes": FOUNTAIN["nodes"] | {"film": movie}}))
    invoke("cook", "movie.json", "--out", ".")
    wanted = (folder / "graph.png").read_bytes()
    for source in ("stills", "moving.png"):
        assert invoke("contact-sheet", source).code == 0
        assert (folder / "out" / f"{Path(source).stem}.contact-sheet.png").read_bytes() == wanted


def test_numbers_of_files_are_their_frames(invoke, folder: Path) -> None:
    """--frames means the numbers in the files' names, and what is not there is told."""
    cooked(invoke, folder, "--frames", "2-6x2")
    assert invoke("contact-sheet", "stills", "--frames", "4,6", "--out", "a.png").code == 0
    shown, stills = cells(folder / "a.png", 2, (32, 18), 2), sorted((folder / "stills").iterdir())
    assert all((one == np.asarray(Image.open(file))).all() for one, file in zip(shown, stills[1:], strict=True))
    assert invoke("contact-sheet", "stills", "--frames", "3") == (
        2, "", "--frames: in stills there is no picture of frame 3; there are 2-6x2\n")


def test_pictures_of_any_shape_are_whole(invoke, folder: Path) -> None:
    """A picture of another shape than the first finds room in a cell, over the sheet's ground, as transparent ones do."""
    (folder / "mixed").mkdir()
    Image.new("RGB", (40, 20), (255, 0, 0)).save(folder / "mixed" / "a.jpg", quality=100)
    Image.new("RGBA", (10, 40), (0, 255, 0, 0)).save(folder / "mixed" / "b.png")
    Image.new("L", (20, 20), 128).save(folder / "mixed" / "c.webp", lossless=True)
    assert invoke("contact-sheet", "mixed", "--columns", "3", "--out", "a.png").code == 0
    red, clear, grey = cells(folder / "a.png", 3, (40, 20), 3)
    ground = np.asarray(Image.open(folder / "a.png"))[0, 0]
    assert (red[..., 0] > 250).all() and (clear == ground).all()
    assert (grey[:, 10:30] == 128).all() and (grey[:, :10] == ground).all() and (grey[:, 30:] == ground).all()


def test_graph_without_an_image(invoke, folder: Path) -> None:
    """A graph without an image is drawn as by preview: by a camera that holds its particles."""
    nodes = {name: node for name, node in FOUNTAIN["nodes"].items() if name not in ("view", "frames")}
    (folder / "bare.json").write_text(json.dumps({**FOUNTAIN, "nodes": nodes}))
    assert invoke("contact-sheet", "bare.json", "--frames", "6", "--out", "a.png").code == 0
    lit = np.argwhere(cells(folder / "a.png", 1, (320, 180), 1)[0].max(axis=-1) > 32)
    assert 100 < np.ptp(lit[:, 0]) < 175


MESSAGES = [
    (("fountain.json", "--frames", "7"), 2,
     "--frames: '7' goes beyond the graph's frames 1 to 6; change time.frames in the graph to have more\n"),
    (("fountain.json", "--out", "a.jpg"), 2,
     "--out: a contact sheet is a PNG, and 'a.jpg' ends otherwise; let the name end in .png\n"),
    (("fountain.json", "--out", "a.##.png"), 2,
     "--out: a contact sheet is one file for all frames; leave # out of 'a.##.png'\n"),
    (("fountain.json", "--out", "fountain.json/a.png"), 3,
     "nothing can be written in fountain.json: it is a file; choose another folder with --out\n"),
    (("fountain.json", "--size", "9000", "--frames", "1-4"), 4,
     "a contact sheet of 4 pictures of 9000 x 5062 has 183,484,320 pixels, and the limit is 134,217,728; make them smaller "
     "with --size, or take fewer with --frames\n"),
    (("none.json",), 1, "none.json: there is no such file\n"),
    (("none.webp",), 2, "none.webp: there is no such file; give a graph, a folder of pictures, or an animation\n"),
    ((".",), 2, ".: there is no picture in this folder (.png, .jpg, .jpeg, .webp); cook some into it, or give a graph\n"),
    ((".", "--set", "speed=1"), 2, "--set is for graphs, and . was cooked already; leave it out\n"),
    (("film.mp4",), 2,
     "film.mp4: of pictures that were cooked already this takes a folder of .png, .jpg, .jpeg, .webp, or an animation in .webp "
     "or .png; give one of those, or the graph\n"),
]


@pytest.mark.parametrize(("arguments", "code", "message"), MESSAGES)
def test_messages(invoke, folder: Path, arguments: tuple[str, ...], code: int, message: str) -> None:
    """What cannot be is told with what to do, and nothing is made."""
    assert invoke("contact-sheet", *arguments) == (code, "", message)
    assert [file.name for file in folder.iterdir()] == ["fountain.json"]


def test_damaged_picture(invoke, folder: Path) -> None:
    """A picture that cannot be read is named, and there is no sheet."""
    cooked(invoke, folder, "--frames", "1-2")
    (folder / "stills" / "fountain.0002.png").write_bytes(b"no picture")
    assert invoke("contact-sheet", "stills", "--out", "a.png") == (
        1, "", "the picture fountain.0002.png cannot be read: it is no picture that is known; give a PNG, JPEG, TIFF or another "
               "that Pillow reads\n")
    assert not (folder / "a.png").exists()
