"""`graphfx demo`: what comes with graphfx, cooked small, and pages of test pictures."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from .conftest import FOUNTAIN


@pytest.fixture
def library(folder: Path) -> str:
    """A library `mine` with an effect `tiny` and a page `small` of two demos."""
    graphs = folder / "mine" / "graphs"
    for place in ("effects", "demos/small"):
        (graphs / place).mkdir(parents=True)
    effect = {**FOUNTAIN, "doc": "A tiny fountain."}
    (graphs / "effects" / "tiny.json").write_text(json.dumps(effect))
    nodes: dict[str, Any] = FOUNTAIN["nodes"]
    second = nodes["frames"] | {"file": "second.####.png", "doc": "Seen <twice>."}
    two = {**FOUNTAIN, "doc": "Two. Of one fountain.", "x-page": {"order": 2}, "nodes": nodes | {"second": second}}
    page = {"order": 1, "light": True, "moves": True, "zoom": {"frames": 3}}
    moving = {**FOUNTAIN, "doc": "Moving. With light.", "x-page": page}
    (graphs / "demos" / "small" / "a_two.json").write_text(json.dumps(two))
    (graphs / "demos" / "small" / "moving.json").write_text(json.dumps(moving))
    return "mine"


def test_lists_what_there_is(invoke, library: str) -> None:
    """Without a name the effects are listed with what they say of themselves, and the pages with what is on them."""
    code, out, err = invoke("demo", "--library", library)
    assert (code, err) == (0, "")
    told = dict(line.split(maxsplit=1) for line in out.splitlines() if line.startswith("  "))
    assert (told["tiny"], told["small"]) == ("A tiny fountain.", "moving, two")
    assert "snow" in told and told["rendering"].startswith("falloffs, comets, ")


def test_effect_is_cooked_small(invoke, folder: Path, library: str) -> None:
    """An effect becomes one animation, small, and the command for the whole of it is told."""
    code, out, _ = invoke("demo", "tiny", "--library", library, "--size", "20", "--frames", "2-5")
    first, second = out.splitlines()
    assert (code, first.partition(" (")[0]) == (0, f"wrote {Path('out', 'demo', 'tiny.webp')}")
    assert second == (f"'graphfx cook {Path('mine', 'graphs', 'effects', 'tiny.json')}' cooks it whole, "
                      "'graphfx preview' draws it quickly")
    with Image.open(folder / "out" / "demo" / "tiny.webp") as animation:
        assert (animation.size, animation.n_frames) == ((20, 12), 4)


def test_page(invoke, folder: Path, library: str) -> None:
    """A page has a picture for each image, movies, the graphs, a sheet and HTML whose every link leads to one of them."""
    code, out, err = invoke("demo", "small", "--library", library, "--out", "shown")
    assert code == 0
    assert out.partition(" (")[0] == f"wrote {Path('shown', 'index.html')}, {Path('shown', 'sheet.png')}"
    assert [line for line in err.splitlines() if "compil" not in line] == ["drawing moving (1 of 2)", "drawing a_two (2 of 2)"]
    made = folder / "shown"
    assert {file.name for file in made.iterdir()} == {
        "index.html", "sheet.png", "a_two.json", "moving.json", "a_two.frames.png", "a_two.second.png", "moving.frames.png",
        "moving.frames.webp"}
    page = (made / "index.html").read_text()
    links = re.findall(r'(?:src|href)="([^"]+)"', page)
    assert links and all((made / link).is_file() for link in links)
    assert page.index("Moving") < page.index("Two") and "Seen &lt;twice&gt;." in page
    assert "Measured: over 6 frames the light of all pixels varies by " in page
    with Image.open(made / "moving.frames.webp") as animation:
        assert animation.n_frames == 6
    with Image.open(made / "sheet.png") as sheet:
        assert sheet.width == 1400 and np.ptp(np.asarray(sheet)) > 100


def test_pictures_are_those_of_a_cook(invoke, folder: Path, library: str) -> None:
    """A page's picture has the pixels of the frame that `cook` writes."""
    invoke("demo", "small", "--library", library, "--out", "shown")
    invoke("cook", "mine/graphs/demos/small/moving.json", "--frames", "6", "--out", "cooked")
    one, other = (np.asarray(Image.open(folder / file)) for file in ("shown/moving.frames.png", "cooked/moving.0006.png"))
    assert (one == other).all()


@pytest.mark.parametrize(("arguments", "code", "message"), [
    (("snwo",), 2, "there is no demo 'snwo'. Did you mean 'snow'? 'graphfx demo' lists what there is\n"),
    (("rendering", "--out", "fountain.json"), 3,
     "nothing can be written in fountain.json: it is a file; choose another folder with --out\n"),
])
def test_messages(invoke, folder: Path, arguments: tuple[str, ...], code: int, message: str) -> None:
    """What cannot be is told before any work."""
    assert invoke("demo", *arguments) == (code, "", message)
    assert [file.name for file in folder.iterdir()] == ["fountain.json"]


def test_frames_beyond_an_effect(invoke, folder: Path, library: str) -> None:
    """Frames that an effect has not are told before any work."""
    assert invoke("demo", "tiny", "--library", library, "--frames", "0-3") == (
        2, "", "--frames: '0-3' goes beyond the graph's frames 1 to 6; change time.frames in the graph to have more\n")
    assert not (folder / "out").exists()


@pytest.mark.parametrize(("page", "message"), [
    ({"ordr": 1}, "x-page: a page knows no 'ordr'. Did you mean 'order'?\n  it knows order, zoom, moves, light"),
    ({"zoom": 3}, 'x-page: zoom should be like {"frames": 4}; it is 3\n  it knows order, zoom, moves, light'),
    ({"light": "yes"}, "x-page: light should be like true; it is \"yes\"\n  it knows order, zoom, moves, light"),
    (7, 'x-page: it should be an object, such as {"order": 1}; it is 7\n  it knows order, zoom, moves, light'),
])
def test_wrong_place_on_a_page(invoke, folder: Path, library: str, page: Any, message: str) -> None:
    """What a graph says of its page is checked, and told at its file."""
    file = folder / "mine" / "graphs" / "demos" / "small" / "moving.json"
    file.write_text(json.dumps({**FOUNTAIN, "x-page": page}))
    code, out, err = invoke("demo", "small", "--library", library)
    assert (code, out) == (1, "")
    assert err.partition("moving.json: ")[2] == message + "\n"
