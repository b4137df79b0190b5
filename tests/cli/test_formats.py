"""What a picture's file cannot hold is refused with its place, before any work."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

from graphfx.output.exr import read_exr

BITS = "say so, or let the file's name end in "


def told(invoke, folder: Path, command: str = "cook", **image: Any) -> tuple[int, list[str]]:
    """Run a command on the fountain with an image of these parameters; return the exit code and what it says."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["nodes"]["frames"] |= image
    (folder / "fountain.json").write_text(json.dumps(graph, indent=1))
    code, out, err = invoke(command, "fountain.json", *(("--out", "made") if command == "cook" else ()))
    assert {file.name for file in folder.iterdir()} <= {"fountain.json", "made", "sky.png"} and not list(folder.rglob("*.part"))
    return code, (err or out).strip().splitlines()


def place(folder: Path, parameter: str) -> str:
    """Return where a parameter's value begins in the fountain."""
    for number, line in enumerate((folder / "fountain.json").read_text().splitlines(), 1):
        if f'"{parameter}": ' in line:
            return f"fountain.json:{number}:{line.index(':') + 3}: nodes.frames.{parameter}: "
    raise AssertionError(parameter)


REFUSED = [
    ({"bits": 32}, "bits", f"the numbers of a PNG have 8 or 16 bits; {BITS}.exr"),
    ({"bits": 8, "file": "x.####.exr"}, "bits", f"the numbers of an EXR have 16 or 32 bits; {BITS}.png"),
    ({"channels": ["depth"]}, "channels",
     "a PNG holds colour and alpha alone; leave channels out, or let the file's name end in .exr"),
    ({"deep": True}, "deep", "a PNG holds no samples; leave deep out, or let the file's name end in .exr"),
    ({"file": "{nope}.####.png"}, "file", "'{nope}.####.png': {nope} means nothing in the name of a file; write {graph} for the "
     "graph's name, #### for the frame's number, or no braces"),
    ({"file": "x.####.tif"}, "file", "'x.####.tif': pictures are written as PNG and as EXR; let the name end in .png or .exr"),
]


@pytest.mark.parametrize("command", ["cook", "check"])
@pytest.mark.parametrize(("image", "parameter", "message"), REFUSED)
def test_what_a_file_cannot_hold(invoke, folder: Path, command, image, parameter, message) -> None:
    """Each is told at its place, by `cook` and by `check`; nothing is made, not even the folder."""
    code, said = told(invoke, folder, command, **image)
    assert (code, said) == (3 if command == "cook" else 1, [place(folder, parameter) + message])
    assert not (folder / "made").exists()


def test_all_faults_are_told_at_once(invoke, folder: Path) -> None:
    """Bits, channels and samples of one PNG."""
    code, said = told(invoke, folder, bits=32, channels=["id"], deep=True)
    assert code == 3
    assert [line.split(": ")[1] for line in said] == [f"nodes.frames.{name}" for name in ("bits", "channels", "deep")]


def test_a_missing_library_is_told_before_any_work(invoke, folder: Path, monkeypatch) -> None:
    """The message names the extra that brings it; deep files need no library."""
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    code, said = told(invoke, folder, file="x.####.exr")
    assert (code, said) == (3, [
        place(folder, "file")
        + "'x.####.exr': EXR files are written by OpenEXR, which is not installed; install it by: pip install \"graphfx[exr]\""])
    assert told(invoke, folder, file="x.####.exr", deep=True)[0] == 0
    assert len(list((folder / "made").glob("x.*.exr"))) == 6


def test_a_damaged_library_is_told_before_any_work(invoke, folder: Path, tmp_path_factory, monkeypatch) -> None:
    """Where OpenEXR is there but cannot be loaded, the message says why, and the extra that brings it."""
    damaged = tmp_path_factory.mktemp("damaged")
    (damaged / "OpenEXR.py").write_text("raise ImportError('libz.so.9: no such file')")
    monkeypatch.syspath_prepend(damaged)
    monkeypatch.delitem(sys.modules, "OpenEXR", raising=False)
    assert told(invoke, folder, file="x.####.exr") == (3, [
        place(folder, "file") + "'x.####.exr': EXR files are written by OpenEXR, which cannot be loaded: libz.so.9: no such "
        "file; install it again by: pip install --force-reinstall \"graphfx[exr]\""])
    assert not (folder / "made").exists()


@pytest.mark.parametrize("command", ["cook", "check"])
def test_a_background_that_is_no_picture(invoke, folder: Path, command) -> None:
    """It is told at its place, before any frame."""
    (folder / "sky.png").write_text("blue")
    code, said = told(invoke, folder, command, background_image="sky.png")
    message = ("the picture sky.png cannot be read: it is no picture that is known; give a PNG, JPEG, TIFF or another that "
               "Pillow reads")
    assert (code, said) == (1, [place(folder, "background_image") + message])


def test_a_background_that_is_not_there(invoke, folder: Path) -> None:
    """Where it was sought is said."""
    code, said = told(invoke, folder, background_image="sky.png")
    assert code == 1 and said[0] == place(folder, "background_image") + "there is no file 'sky.png'." and "sought in" in said[1]


@pytest.mark.parametrize("size", [[0, 18], [1_000_000, 1_000_000], [-4, 18]])
def test_sizes_that_no_picture_has(invoke, folder: Path, size) -> None:
    """0 and a million pixels on a side are told at their place."""
    code, said = told(invoke, folder, size=size)
    assert code == 1 and said[0].endswith(f"{size[0]} is out of range; size must lie between 1 and 65536")


def test_a_default_that_is_no_file_may_be_written(invoke, folder: Path) -> None:
    """"" stands for no map, no background and the font that comes along: the files are those of a graph that leaves it out."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["nodes"] |= {"word": {"type": "mesh_text", "text": "I"}, "sign": {"type": "polygons", "geometry": "word"}}
    graph["nodes"]["frames"] |= {"from": ["fall", "sign"], "file": "x.####.exr"}
    (folder / "out.json").write_text(json.dumps(graph))
    graph["nodes"]["word"]["font"] = graph["nodes"]["sign"]["color_map"] = graph["nodes"]["sign"]["opacity_map"] = ""
    graph["nodes"]["frames"]["background_image"] = ""
    (folder / "stated.json").write_text(json.dumps(graph))
    pictures = []
    for name in ("out", "stated"):
        assert invoke("cook", f"{name}.json", "--out", name, "--frames", "6")[0] == 0
        pictures.append(read_exr(folder / name / "x.0006.exr"))
    assert (pictures[0] == pictures[1]).all() and (pictures[0][..., 3] == 0).any() and (pictures[0][..., 3] > 0).any()
    (folder / "none.json").write_text('{"graphfx": 1, "nodes": {"m": {"type": "mesh_file", "file": ""}}}')
    assert "nodes.m.file: the path is empty; name a file" in invoke("check", "none.json").err
