"""`graphfx preview`: any graph, quickly, as lines."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageSequence

from graphfx.cook.effect import Effect
from graphfx.cook.pictures import camera_at
from graphfx.cook.pilot import Pilot
from graphfx.cook.preview import camera_placed, preview_of
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.plan.make import make_plan

LIBRARY = Library(library_roots())


def files_in(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


def changed(folder: Path, **nodes: Any) -> None:
    """Give the fountain other nodes; None takes one away."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["nodes"] = {name: node for name, node in (graph["nodes"] | nodes).items() if node is not None}
    (folder / "fountain.json").write_text(json.dumps(graph))


def test_writes_one_animation(invoke, folder: Path) -> None:
    """Without options all frames go into out/NAME.webp, of the picture's size and rate."""
    code, out, _ = invoke("preview", "fountain.json")
    file = Path("out", "fountain.webp")
    assert (code, out.partition(" (")[0]) == (0, f"wrote {file}")
    with Image.open(file) as animation:
        assert (animation.size, animation.n_frames) == ((32, 18), 6)
        durations = [frame.copy().info["duration"] for frame in ImageSequence.Iterator(animation)]
    assert sum(durations) == 250
    assert files_in(folder / "out") == ["fountain.webp"]


def test_reduced_size(invoke, folder: Path) -> None:
    """A picture is drawn 640 pixels wide at most, or as wide as is asked for, in its shape; or to the pixel."""
    changed(folder, frames={"type": "image", "from": "fall", "camera": "view", "size": [1920, 800]})
    for size, wanted in (((), (640, 266)), (("--size", "200"), (200, 84)), (("--size", "90x91"), (90, 91))):
        assert invoke("preview", "fountain.json", "--frames", "3", "--out", "a.webp", *size).code == 0
        with Image.open("a.webp") as picture:
            assert picture.size == wanted


@pytest.mark.parametrize("suffix", [".webp", ".png", ".mp4", ".mov"])
def test_suffix_says_what_it_is(invoke, folder: Path, suffix: str) -> None:
    """The file's suffix chooses the kind of movie; the same graph gives the same bytes on any number of threads."""
    for name, threads in (("a", "1"), ("b", "3")):
        assert invoke("preview", "fountain.json", "--out", f"{name}{suffix}", "--threads", threads).code == 0
    one, other = (sha256((folder / f"{name}{suffix}").read_bytes()).hexdigest() for name in "ab")
    assert one == other


def test_frames_as_they_come(invoke, folder: Path) -> None:
    """A name with #### writes each frame as a picture as soon as it is there, and tells of it; there is no movie."""
    code, out, err = invoke("preview", "fountain.json", "--out", "shown/f.##.png", "--frames", "2-6x2", "--json")
    *frames, whole = map(json.loads, out.splitlines())
    assert (code, err) == (0, "")
    assert [frame["files"] for frame in frames] == [[str(Path("shown", f"f.{number:02}.png"))] for number in (2, 4, 6)]
    assert (whole["frames"], whole["files"]) == (3, 3)
    assert files_in(folder / "shown") == ["f.02.png", "f.04.png", "f.06.png"]


def test_json_names_the_movie(invoke) -> None:
    """With --json stdout holds only JSON, and the last line counts the movie."""
    code, out, err = invoke("preview", "fountain.json", "--json", "--frames", "1-2")
    *frames, whole = map(json.loads, out.splitlines())
    assert (code, err, len(frames), frames[0]["files"], whole["files"]) == (0, "", 2, [], 1)


def test_first_image_is_taken(invoke, folder: Path) -> None:
    """Of several pictures the first that is switched on is drawn; movies and other pictures are left alone."""
    image = {"type": "image", "from": "fall", "camera": "view"}
    changed(folder, frames=image | {"size": [10, 10], "enabled": False}, second=image | {"size": [20, 10]},
            third=image | {"size": [40, 10]}, film={"type": "movie", "image": "third"})
    assert invoke("preview", "fountain.json", "--frames", "1", "--out", "a.webp").code == 0
    with Image.open("a.webp") as picture:
        assert picture.size == (20, 10)
    assert files_in(folder) == ["a.webp", "fountain.json"]


def test_looks_as_its_image(invoke, folder: Path) -> None:
    """The picture's background, exposure and camera are the image's."""
    changed(folder, frames={"type": "image", "from": "fall", "camera": "view", "size": [32, 18], "background": "#204060"})
    assert invoke("preview", "fountain.json", "--frames", "1", "--out", "a.png").code == 0
    with Image.open("a.png") as picture:
        assert picture.getpixel((0, 0)) == (0x20, 0x40, 0x60)


def test_graph_without_an_image(invoke, folder: Path) -> None:
    """A graph without a picture is seen by a camera that holds its particles, and that is said."""
    changed(folder, frames=None, view=None)
    code, _, err = invoke("preview", "fountain.json", "--frames", "6", "--out", "a.png")
    assert code == 0
    assert "the graph has no image: its particles are seen by a camera that holds them all" in err
    with Image.open("a.png") as picture:
        lit = np.argwhere(np.asarray(picture).max(axis=-1) > 32)
        assert picture.size == (640, 360)
    assert 200 < np.ptp(lit[:, 0]) < 350 and lit.min() > 0


def test_camera_holds_what_it_should() -> None:
    """Wherever particles are, nearly all are in the picture of such a camera, and they fill it."""
    draw = np.random.default_rng(2)
    for _ in range(6):
        low, extent = draw.uniform(-50, 50, 3), 10.0 ** draw.uniform(-2, 2, 3)
        nodes = {"sky": {"type": "emit", "count": 400, "set": {
            "position": {"in_box": {"min": low.tolist(), "max": (low + extent).tolist()}}}}}
        flat = flatten(document_of({"graphfx": 1, "time": {"frames": [1, 2]}, "nodes": nodes}), LIBRARY)
        effect = camera_placed(Effect(preview_of(flat, LIBRARY, "a.webp")), [1, 2], 1)
        position = effect.simulate(2)["sky"]["position"].astype(float)
        x, y, depth = camera_at(effect.plan.images[0].camera, 0.0, 2).screen_matrix(640, 360) @ np.c_[position, np.ones(400)].T
        assert (depth > 0).all()
        across, down = x / depth / 640, y / depth / 360
        assert ((across > 0) & (across < 1) & (down > 0) & (down < 1)).mean() > 0.97
        assert max(np.ptp(across), np.ptp(down)) > 0.6


def test_motion_is_tried_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a camera is looked for, the same choice of how to move holds for the picture: nothing is tried twice."""
    ops = [{"type": "vortex"}, {"type": "vortex", "id": "other", "center": [1, 0, 0]}]
    sky = {"type": "emit", "count": 9, "set": {"position": {"in_box": {}}}}
    nodes = {"sky": sky, "act": {"type": "stack", "from": "sky", "ops": ops}}
    flat = flatten(document_of({"graphfx": 1, "time": {"frames": [1, 3]}, "nodes": nodes}), LIBRARY)
    tried: list[object] = []
    monkeypatch.setattr("graphfx.cook.pilot.Pilot.of", lambda *given, make=Pilot.of: tried.append(given) or make(*given))
    effect = camera_placed(Effect(preview_of(flat, LIBRARY, "a.webp")), [1, 2, 3], 1)
    known, anew = effect.plan.emitters["sky"], Effect(effect.flat).plan.emitters["sky"]
    assert len(tried) == 2, "one of them by the last line"
    assert (known.method, known.reason) == (anew.method, anew.reason)


def test_plan_of_a_preview_has_no_radius() -> None:
    """What a preview does not show is neither simulated nor stored."""
    flat = flatten(Path(__file__).parents[1] / "snow.json", LIBRARY)
    plan = make_plan(preview_of(flat, LIBRARY, "snow.webp"))
    assert "radius" in make_plan(flat).emitters["sky"].attributes.columns
    assert "radius" not in plan.emitters["sky"].attributes.columns


NO_SIZE = ("graphfx preview: --size: '{}' is no size; write 320 for the width, or 320x180; each from 1 to 65536\n"
           "  'graphfx preview --help' says what it takes\n")
MESSAGES = [
    (("--size", "big"), 2, NO_SIZE.format("big")), (("--size", "0x10"), 2, NO_SIZE.format("0x10")),
    (("--frames", "9"), 2, "--frames: '9' goes beyond the graph's frames 1 to 6; change time.frames in the graph to have more\n"),
    (("--out", "a.avi"), 3, "--out: 'a.avi': movies are written as .mp4, .mov, .webp, .png; let the name end in one of them\n"),
    (("--out", "a.####.jpg"), 3,
     "--out: 'a.####.jpg': pictures are written as PNG and as EXR; let the name end in .png or .exr\n"),
    (("--out", "fountain.json/a.webp"), 3,
     "nothing can be written in fountain.json: it is a file; choose another folder with --out\n"),
    (("--size", "65536x65536", "--out", "a.png"), 4,
     "fountain.json:1:385: nodes.frames: a picture of 65536 x 65536 has 4,294,967,296 pixels, and the limit is 134,217,728; "
     "make it smaller, or allow more with --limit-pixels\n"),
]


@pytest.mark.parametrize(("arguments", "code", "message"), MESSAGES)
def test_messages(invoke, folder: Path, arguments: tuple[str, ...], code: int, message: str) -> None:
    """What cannot be is told with what to do, and nothing is made."""
    assert invoke("preview", "fountain.json", *arguments) == (code, "", message)
    assert files_in(folder) == ["fountain.json"]


def test_no_particles_at_all(invoke, folder: Path) -> None:
    """A graph with neither picture nor particles is told what it lacks."""
    changed(folder, frames=None, fall=None, spring=None)
    assert invoke("preview", "fountain.json") == (
        1, "", "fountain.json: nodes: the graph has no picture and no particles; give it an enabled node of type 'emit'\n")
