"""Where the files of a cook may lie: below the output folder, under names that every system takes."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from graphfx.cook.files import file_name

OUTSIDE = [
    "../x.####.png", "../../x.####.png", "a/../../x.####.png", "a/../x.####.png", "./../x.####.png", "..", "../",
    "a/..", "/x.####.png", "/etc/x.####.png", "//host/x.####.png", "///x.####.png", "C:/x.####.png", "c:x.####.png",
    "C:\\x.####.png", "\\x.####.png", "..\\x.####.png", "a\\..\\..\\x.####.png", "\\\\host\\x\\y.####.png",
    "a/..\\x.####.png", "{graph}/../../x.####.png", "a/b/../../../x.####.png", "../{graph}.####.png", "/{graph}.png",
    "a/./../../x.####.png",
]
NO_NAME = [
    "", " ", ".", "./x.####.png", "a//x.####.png", "a/ /x.####.png", " x.####.png", "x.####.png ", "a/x.####.png/",
    "x\n.####.png", "x\x00.####.png", "x?.####.png", "xx:y.####.png", "a/*/x.####.png", "<x>.####.png",
    "x|y.####.png", '"x".####.png', "\x7f.####.png",
]


def cook_as(invoke, folder: Path, *patterns: str, frames: str = "1-2") -> tuple[int, str]:
    """Cook the fountain with images of these file names into `made`; return the exit code and the last line."""
    graph = json.loads((folder / "fountain.json").read_text())
    image = graph["nodes"].pop("frames")
    graph["nodes"] |= {f"image{number}": image | {"file": pattern} for number, pattern in enumerate(patterns)}
    (folder / "fountain.json").write_text(json.dumps(graph))
    code, _, err = invoke("cook", "fountain.json", "--out", "made", "--frames", frames)
    return code, err.strip().splitlines()[-1]


@pytest.mark.parametrize("pattern", OUTSIDE)
def test_no_name_leads_out_of_the_folder(invoke, folder: Path, pattern: str) -> None:
    """Nothing is written outside the output folder, in whatever way its name is put; nothing at all is written."""
    code, message = cook_as(invoke, folder, pattern)
    assert code == 3
    assert message.endswith(
        "files cannot leave the output folder; write a name relative to it, with / between folders and no '..'")
    assert [file.name for file in folder.iterdir()] == ["fountain.json"]


@pytest.mark.parametrize("pattern", NO_NAME)
def test_no_name_at_all(invoke, folder: Path, pattern: str) -> None:
    """A name that some system does not take is refused before any work."""
    code, message = cook_as(invoke, folder, pattern)
    assert code == 3
    assert message.endswith("this is no name for files on every system; use letters, digits, '-', '_' and '.'")
    assert [file.name for file in folder.iterdir()] == ["fountain.json"]


def test_message_has_its_place(invoke, folder: Path) -> None:
    """The refusal names the file, line and column of the name in the graph."""
    assert cook_as(invoke, folder, "x.####.jpg") == (
        3, "fountain.json:1:463: nodes.image0.file: 'x.####.jpg': pictures are written as PNG and as EXR; let the name end in "
         ".png or .exr")


def test_frames_do_not_overwrite_each_other(invoke, folder: Path) -> None:
    """A name without a number serves for one frame, not for two."""
    code, message = cook_as(invoke, folder, "x.png")
    assert (code, message.partition("'x.png': ")[2]) == (
        3, "every frame would be written over the one before; put #### where its number goes")
    assert cook_as_again(invoke, "1") == 0
    assert [file.name for file in (folder / "made").iterdir()] == ["x.png"]


def cook_as_again(invoke, frames: str) -> int:
    return invoke("cook", "fountain.json", "--out", "made", "--frames", frames).code


def test_images_do_not_overwrite_each_other(invoke, folder: Path) -> None:
    """Two images need two names, even where a system does not tell capitals from small letters."""
    code, message = cook_as(invoke, folder, "x.####.png", "X.####.png")
    assert (code, message.partition("'X.####.png': ")[2]) == (
        3, "the image 'image0' writes the same files; give each a name of its own")


def test_folders_below_are_made(invoke, folder: Path) -> None:
    """A name may have folders in it, which are made."""
    assert cook_as(invoke, folder, "near/{graph}-##.png", "far/{graph}-##.png")[0] == 0
    assert sorted(str(file.relative_to(folder / "made")) for file in (folder / "made").rglob("*.png")) == [
        str(Path(where, f"fountain-0{n}.png")) for where in ("far", "near") for n in (1, 2)]


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_links_do_not_lead_out(invoke, folder: Path) -> None:
    """A link inside the output folder is not followed out of it."""
    (folder / "made").mkdir()
    (folder / "elsewhere").mkdir()
    (folder / "made" / "link").symlink_to(folder / "elsewhere")
    code, message = cook_as(invoke, folder, "link/x.####.png")
    assert code == 3
    assert message.endswith("a link leads out of the output folder there; remove it, or choose another folder with --out")
    assert list((folder / "elsewhere").iterdir()) == []


@pytest.mark.parametrize(("pattern", "name"), [
    ("{graph}.####.png", "snow.0007.png"), ("#.png", "7.png"), ("##/####.png", "07/0007.png"), ("x.png", "x.png"),
])
def test_numbers_in_names(pattern: str, name: str) -> None:
    """Each run of # becomes the frame's number, padded to its length."""
    assert file_name(pattern, "snow", 7) == name


def test_graph_name_with_a_number_sign() -> None:
    """The graph's own name is taken as it is."""
    assert file_name("{graph}.##.png", "take#2", 7) == "take#2.07.png"
