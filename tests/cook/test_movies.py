"""Movies as nodes: just the frames asked for, whole or not at all, in place of stills unless those are wanted."""

from __future__ import annotations

import errno
import json
import os
import signal
import subprocess
import sys
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageSequence

from graphfx.cook import movies
from graphfx.cook.effect import FrameReport
from graphfx.errors import GraphError, OutputError

from .effects import graph, made

WEBP = {"movie": {"type": "movie", "image": "frames", "file": "{graph}.webp", "quality": 100}}


def names(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


def pictures(file: Path) -> list[np.ndarray]:
    with Image.open(file) as animation:
        return [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(animation)]


def test_movie_takes_the_place_of_stills(tmp_path: Path):
    """An image that a movie takes writes no stills, unless it names them; then they are the movie's frames."""
    assert made(nodes=WEBP).cook(tmp_path / "a", threads=1) == [tmp_path / "a" / "test.webp"]
    assert names(tmp_path / "a") == ["test.webp"]
    both = made(nodes=WEBP, image={"file": "still.##.png"})
    written = both.cook(tmp_path / "b", frames=range(2, 6), threads=1)
    assert [file.name for file in written] == ["still.02.png", "still.03.png", "still.04.png", "still.05.png", "test.webp"]
    stills = [np.asarray(Image.open(file)) for file in written[:-1]]
    assert all((one == other).all() for one, other in zip(pictures(written[-1]), stills, strict=True))


@pytest.mark.parametrize("suffix", sorted(movies.KINDS))
def test_just_the_frames_asked_for(tmp_path: Path, suffix: str):
    """A cook of some frames makes a movie of those alone, in order; twice, and on more threads, the same bytes."""
    import av

    effect = made(nodes={"movie": {**WEBP["movie"], "file": f"m{suffix}"}})
    digests = set()
    for out, threads in (("a", 1), ("b", 1), ("c", 3)):
        effect.cook(tmp_path / out, frames=[9, 3, 5], threads=threads)
        digests.add(sha256((tmp_path / out / f"m{suffix}").read_bytes()).hexdigest())
    assert len(digests) == 1
    shown = pictures(tmp_path / "a" / f"m{suffix}") if suffix in (".webp", ".png") else [
        frame.to_ndarray(format="rgb24") for frame in av.open(str(tmp_path / "a" / f"m{suffix}")).decode(video=0)]
    assert len(shown) == 3
    for picture, frame in zip(shown, (3, 5, 9), strict=True):
        assert np.abs(picture.astype(float).mean() - np.asarray(effect.frame(frame)).mean()) < 2.0


def test_no_frames_no_movie(tmp_path: Path):
    """Asked for no frames, a cook writes nothing."""
    assert made(nodes=WEBP).cook(tmp_path / "a", frames=[]) == []
    assert not (tmp_path / "a").exists()


def test_stopped_cook_leaves_no_movie(tmp_path: Path):
    """Where a cook is stopped between two frames there is no movie and no part of one; stills that were written stay."""
    def stop(report: FrameReport) -> None:
        if report.frame == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        made(nodes=WEBP, image={"file": "still.##.png"}).cook(tmp_path, threads=1, report=stop)
    left = names(tmp_path)
    assert left[:3] == ["still.01.png", "still.02.png", "still.03.png"]
    assert not [name for name in left if "still" not in name]


@pytest.mark.skipif(os.name == "nt", reason="processes are killed otherwise there")
def test_killed_cook_leaves_no_half_movie(tmp_path: Path):
    """Killed outright, a cook leaves nothing under the movie's name."""
    document = graph(nodes={"movie": {"type": "movie", "image": "frames", "file": "long.mp4"}}, time={"frames": [1, 100_000]})
    (tmp_path / "long.json").write_text(json.dumps(document))
    process = subprocess.Popen([sys.executable, "-m", "graphfx", "cook", "long.json", "--out", "."], cwd=tmp_path,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    assert any(line.startswith("frame 20 ") for line in process.stderr)
    process.send_signal(signal.SIGKILL)
    process.communicate(timeout=60)
    assert [name for name in names(tmp_path) if not name.endswith(".part")] == ["long.json"]


@pytest.mark.parametrize("suffix", sorted(movies.KINDS))
def test_full_disk_leaves_no_movie(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str):
    """Where the disk has no room for a movie that is said, with its name, and no part of it is left."""
    def full(handle: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError) as caught:
        made(nodes={"movie": {**WEBP["movie"], "file": f"m{suffix}"}}).cook(tmp_path / "out", frames=[1, 2], threads=1)
    file, hint = tmp_path / "out" / f"m{suffix}", "free some space there, or write to another disk"
    assert str(caught.value) == f"cannot write {file}: No space left on device; {hint}"
    assert names(tmp_path / "out") == []


FAULTS: list[tuple[dict[str, Any], dict[str, Any], str]] = [
    ({"file": "m.avi"}, {}, "'m.avi': movies are written as .mp4, .mov, .webp, .png; let the name end in one of them"),
    ({"file": "m.####.webp"}, {}, "'m.####.webp': a movie is one file for all frames; leave # out of its name"),
    ({"file": "m.mp4"}, {"size": [33, 20]},
     "'m.mp4': H.264 needs an even width and height, and the pictures of 'frames' are 33 x 20; change the size, or write .mov, "
     ".webp or .png"),
    ({"file": "m.mp4"}, {"transparent": True},
     "'m.mp4': H.264 has no alpha, and 'frames' is transparent; write .mov, .webp or .png"),
    ({"file": "m.webp"}, {"size": [16384, 2]},
     "'m.webp': a WebP is 16383 pixels wide and high at most, and the pictures of 'frames' are 16384 x 2; make them smaller, "
     "or write .mov or .png"),
    ({"file": "m.mp4"}, {"size": [20000, 2]},
     "'m.mp4': H.264 is 16384 pixels wide and high at most, and the pictures of 'frames' are 20000 x 2; make them smaller, or "
     "write .mov or .png"),
    ({"file": "m.mov"}, {"size": [2, 65536]},
     "'m.mov': ProRes is 65535 pixels wide and high at most, and the pictures of 'frames' are 2 x 65536; make them smaller, or "
     "write .png"),
    ({"file": "{name}.webp"}, {},
     "'{name}.webp': {name} means nothing in the name of a file; write {graph} for the graph's name, or no braces"),
    ({"file": "../m.webp"}, {},
     "'../m.webp': files cannot leave the output folder; write a name relative to it, with / between folders and no '..'"),
    ({"file": "a.0001.png"}, {"file": "A.####.png"},
     "'a.0001.png': the image 'frames' writes the same files; give each a name of its own"),
]


@pytest.mark.parametrize(("movie", "image", "message"), FAULTS)
def test_refused_before_any_work(tmp_path: Path, movie: dict[str, Any], image: dict[str, Any], message: str):
    """What cannot be written is told at its place, before anything is made."""
    with pytest.raises(OutputError) as caught:
        made(nodes={"movie": {"type": "movie", "image": "frames", **movie}}, image=image).cook(tmp_path / "out")
    assert str(caught.value) == f"test.json:41:15: nodes.movie.file: {message}"
    assert names(tmp_path) == []


@pytest.mark.parametrize(("suffix", "size"), [(".mp4", [16384, 2]), (".mov", [2, 65535]), (".webp", [16383, 1])])
def test_the_largest_is_written(tmp_path: Path, suffix: str, size: list[int]):
    """A movie as wide or high as its codec takes is written."""
    movie = {"type": "movie", "image": "frames", "file": f"m{suffix}"}
    made(nodes={"movie": movie}, image={"size": size}).cook(tmp_path, frames=[1])
    assert names(tmp_path) == [f"m{suffix}"]


def test_missing_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Without PyAV a .mp4 is refused before any work, with what to install."""
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(OutputError) as caught:
        made(nodes={"movie": {"type": "movie", "image": "frames"}}).cook(tmp_path / "out")
    assert str(caught.value) == ("test.json:38:14: nodes.movie.file: '{graph}.mp4': .mp4 needs PyAV, which is not "
                                 'installed; install it by: pip install "graphfx[video]", or write .webp')
    assert names(tmp_path) == []


def test_damaged_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Where PyAV is there but cannot be loaded, a .mp4 is refused before any work, with the cause."""
    (tmp_path / "av.py").write_text("raise ImportError('libx264.so: no such file')")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "av", raising=False)
    with pytest.raises(OutputError) as caught:
        made(nodes={"movie": {"type": "movie", "image": "frames"}}).cook(tmp_path / "out")
    assert str(caught.value) == (
        "test.json:38:14: nodes.movie.file: '{graph}.mp4': .mp4 needs PyAV, which cannot be loaded: libx264.so: no such file; "
        'install it again by: pip install --force-reinstall "graphfx[video]", or write .webp')


def test_movie_of_no_image():
    """A movie of what is no image is a mistake, told with the nodes that fit."""
    with pytest.raises(GraphError, match="image should be the id of an image or preview; 'sky' is a node of type emit"):
        made(nodes={"movie": {"type": "movie", "image": "sky"}})


def test_movie_of_an_image_that_is_off():
    """A movie whose image is switched off is dropped with it."""
    plan = made(nodes={**WEBP, "other": {"type": "image", "from": "sky", "camera": "view"}}, image={"enabled": False}).plan
    assert plan.schedule.dropped["movie"] == "its image 'frames' is not drawn"
    assert plan.movies == []
