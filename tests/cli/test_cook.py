"""`graphfx cook`: what it writes, what it says, what it leaves when it fails."""

from __future__ import annotations

import json
import re
from hashlib import sha256
from pathlib import Path

import pytest
from PIL import Image

NAMES = [f"fountain.{number:04}.png" for number in range(1, 7)]


def files_in(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


def digests(folder: Path) -> dict[str, str]:
    return {file.name: sha256(file.read_bytes()).hexdigest() for file in folder.iterdir()}


def test_cook_writes_every_frame(invoke, folder: Path) -> None:
    """Without options all frames go to out/NAME, which is made, and are pictures of the stated size."""
    code, out, _ = invoke("cook", "fountain.json")
    assert (code, out.partition(" (")[0]) == (0, f"wrote 6 files in {Path('out', 'fountain')}")
    assert files_in(folder / "out" / "fountain") == NAMES
    for name in NAMES:
        with Image.open(folder / "out" / "fountain" / name) as picture:
            assert (picture.size, picture.mode) == ((32, 18), "RGB")


def test_cook_twice_gives_the_same_bytes(invoke, folder: Path) -> None:
    """Two cooks, and cooks with 1 and 3 threads, write the same files to the last byte."""
    for threads, out in (("1", "a"), ("1", "b"), ("3", "c")):
        assert invoke("cook", "fountain.json", "--out", out, "--threads", threads).code == 0
    assert digests(folder / "a") == digests(folder / "b") == digests(folder / "c")


def test_one_frame_is_as_in_the_whole(invoke, folder: Path) -> None:
    """A frame cooked alone has the bytes that it has in the sequence."""
    invoke("cook", "fountain.json", "--out", "all")
    invoke("cook", "fountain.json", "--out", "some", "--frames", "2-6x3")
    assert digests(folder / "some") == {name: digest for name, digest in digests(folder / "all").items()
                                        if name in (NAMES[1], NAMES[4])}


def test_plain_progress(invoke) -> None:
    """Where there is no terminal, each frame is a line on stderr with its number, particles and fragments."""
    code, _, err = invoke("cook", "fountain.json", "--frames", "2,4")
    lines = [line for line in err.splitlines() if not line.startswith("compiling ")]
    assert code == 0
    assert len(lines) == 2
    assert lines[0].startswith("frame 2 (1 of 2): 11 particles, ")
    assert lines[1].startswith("frame 4 (2 of 2): 31 particles, ")
    assert all(line.endswith(" fragments") for line in lines)


def test_json_is_a_line_a_frame(invoke, folder: Path) -> None:
    """With --json stdout holds only JSON: a line for each frame, then one for the whole; stderr is silent."""
    code, out, err = invoke("cook", "fountain.json", "--json", "--frames", "1-3", "--out", "made")
    *frames, whole = map(json.loads, out.splitlines())
    assert (code, err) == (0, "")
    assert [frame["frame"] for frame in frames] == [1, 2, 3]
    assert [frame["particles"] for frame in frames] == [1, 11, 21]
    assert [frame["files"] for frame in frames] == [[str(Path("made", name))] for name in NAMES[:3]]
    assert (whole["frames"], whole["files"]) == (3, 3)
    assert whole["seconds"] > 0


def test_dry_run_writes_nothing(invoke, folder: Path) -> None:
    """--dry-run says which files there would be, and makes not even the folder."""
    first, last = Path("out", "fountain", NAMES[0]), Path("out", "fountain", NAMES[2])
    assert invoke("cook", "fountain.json", "--dry-run", "--frames", "1-3") == (
        0, f"would write frames 1-3: 3 frames\n  frames: 32 x 18, {first} to {last}\n", "")
    assert files_in(folder) == ["fountain.json"]


def test_dry_run_as_json(invoke) -> None:
    """--dry-run --json lists every file."""
    code, out, _ = invoke("cook", "fountain.json", "--dry-run", "--json", "--out", "made", "--frames", "6")
    assert code == 0
    image = {"node": "frames", "size": [32, 18], "files": [str(Path("made", NAMES[5]))]}
    assert json.loads(out) == {"frames": [6], "images": [image]}


def test_set_changes_a_parameter(invoke, folder: Path) -> None:
    """--set gives another picture; the default, stated, gives the same."""
    for out, speed in (("a", "3"), ("b", " 3.0 "), ("c", "1")):
        assert invoke("cook", "fountain.json", "--frames", "6", "--out", out, "--set", f"speed={speed}").code == 0
    assert digests(folder / "a") == digests(folder / "b") != digests(folder / "c")


@pytest.mark.parametrize(("setting", "message"), [
    ("sped=2", "--set sped=2: the graph has no parameter 'sped'. Did you mean 'speed'?\n  its parameters: speed [m/s]\n"),
    ("speed=-1", "--set speed=-1: params.speed: -1 is out of range; speed must be at least 0 [m/s]\n"),
])
def test_wrong_setting(invoke, folder: Path, setting: str, message: str) -> None:
    """A parameter that is not there, or a value that it does not take, stops the cook before it begins."""
    assert invoke("cook", "fountain.json", "--set", setting) == (1, "", message)
    assert files_in(folder) == ["fountain.json"]


@pytest.mark.parametrize(("frames", "message"), [
    ("7", "--frames: '7' goes beyond the graph's frames 1 to 6; change time.frames in the graph to have more\n"),
    ("1,4-2", "--frames: '4-2' is empty; write the lesser frame first and a step of 1 or more\n"),
    ("all", "--frames: 'all' is no frame set; write 12, 1-48, 1-48x2 or several with commas\n"),
    ("", "--frames: '' is no frame set; write 12, 1-48, 1-48x2 or several with commas\n"),
])
def test_wrong_frames(invoke, frames: str, message: str) -> None:
    """A set of frames that makes no sense is refused, and how to write one is said."""
    assert invoke("cook", "fountain.json", "--frames", frames) == (2, "", message)


def test_output_folder_in_the_way(invoke, folder: Path) -> None:
    """A file where the folder should be is said before any work is done."""
    assert invoke("cook", "fountain.json", "--out", "fountain.json") == (
        3, "", "nothing can be written in fountain.json: it is a file; choose another folder with --out\n")
    below = str(Path("fountain.json", "frames"))
    assert invoke("cook", "fountain.json", "--out", below) == (
        3, "", f"nothing can be written in {below}: a file is in its way; choose another folder with --out\n")


BRANCHING = '''"""Push: away from the ground."""
from graphfx.math import Vec3
from graphfx.node import operator


@operator.flow(writes="position")
def push(position: Vec3, dt: float) -> Vec3:
    """Return the position."""
    if position.y < 0.0:
        return position
    return position * (1.0 + dt)
'''


def test_node_that_branches(invoke, folder: Path) -> None:
    """A user's node that branches on a particle's value is told its line, and what to write; nothing is left behind."""
    node = folder / "mine" / "nodes" / "operators" / "push.py"
    node.parent.mkdir(parents=True)
    node.write_text(BRANCHING)
    (folder / "pushed.json").write_text((folder / "fountain.json").read_text().replace("gravity", "push"))
    code, out, err = invoke("cook", "pushed.json", "--library", "mine", "--out", "made")
    assert (code, out) == (1, "")
    assert "push.py:9: push: " in err
    assert "where(condition, a, b)" in err
    assert files_in(folder / "made") == []


@pytest.mark.parametrize(("option", "message"), [
    ("--limit-particles=100", "about 240 particles would be alive at once, and the limit is 100; "
                              "lower the rate, the count or the life, or allow more with --limit-particles"),
    ("--limit-pixels=500", "a picture of 32 x 18 has 576 pixels, and the limit is 500; "
                           "make it smaller, or allow more with --limit-pixels"),
    ("--memory=1M", "graphfx itself takes about 200 MB of memory, and 1 MB are allowed; allow 200.1 MB with "
                    "--memory\n"
                    "  particles 11.1 kB, pictures 9.3 kB, graphfx itself 200 MB"),
    ("--memory=200MB", "fountain.json:1:175: nodes.spring: about 200.1 MB of memory are needed, and 200 MB are allowed; "
                       "allow 200.1 MB with --memory, or lower the rate, the count or the life of the particles\n"
                       "  particles 11.1 kB, pictures 9.3 kB, graphfx itself 200 MB"),
])
def test_limits(invoke, folder: Path, option: str, message: str) -> None:
    """What would pass a limit is refused before work begins, with exit code 4 and how to allow it."""
    text = (folder / "fountain.json").read_text()
    (folder / "fountain.json").write_text(text.replace('"frames": [1, 6]', '"frames": [1, 600]'))
    code, out, err = invoke("cook", "fountain.json", "--out", "made", option)
    assert (code, out) == (4, "")
    assert message in err
    assert files_in(folder) == ["fountain.json"]


def test_least_memory_that_is_told_is_enough(invoke, folder: Path) -> None:
    """What a message says is to be allowed is allowed."""
    text = (folder / "fountain.json").read_text()
    (folder / "fountain.json").write_text(text.replace('"rate": 240', '"rate": 9000000'))
    code, _, err = invoke("cook", "fountain.json", "--dry-run", "--memory=210MB")
    told = re.search(r"about (.*) of memory are needed, and 210 MB are allowed; allow (.*) with --memory", err)
    assert code == 4 and told is not None and told[1] == told[2]
    least = float(told[1].removesuffix(" MB"))
    assert invoke("cook", "fountain.json", "--dry-run", f"--memory={least}MB").code == 0
    assert invoke("cook", "fountain.json", "--dry-run", f"--memory={least - 0.2}MB").code == 4


def test_what_is_not_drawn_is_named(invoke, folder: Path) -> None:
    """Particles with a radius that is no number are told of once: whose they are, what is wrong, since when, what to do."""
    text = (folder / "fountain.json").read_text()
    (folder / "fountain.json").write_text(text.replace('"set": {', '"set": {"radius": {"expr": "sqrt(0.099 - time)"}, '))
    code, _, err = invoke("cook", "fountain.json")
    assert code == 0
    assert err.splitlines()[-1] == (
        "48 times a particle of spring: its radius is not finite, and it was not drawn, first in frame 4; look in what gives it "
        "for a division by 0, a root or a logarithm of what is less than 0, or what grows without end"
    )
