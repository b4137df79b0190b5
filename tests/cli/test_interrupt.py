"""Ctrl-C, and the signals that mean the same: whole files, and the command to go on with."""

from __future__ import annotations

import json
import os
import re
import shlex
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image

from graphfx.cli.stopping import Stopped, stoppable
from graphfx.cook.frames import parse_frames

LAST = 5000


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C reaches processes otherwise there")
def test_interrupt_leaves_whole_files(started: Callable[..., subprocess.Popen[str]], folder: Path) -> None:
    """Stopped by Ctrl-C, a cook exits with 130; every file is whole, none is partial, and the printed command makes the rest."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["time"]["frames"] = [1, LAST]
    (folder / "long.json").write_text(json.dumps(graph))
    process = started("cook", "long.json", "--out", "long frames", "--set", "speed=2")
    assert process.stderr is not None
    for line in process.stderr:
        if line.startswith("frame 4 "):
            process.send_signal(signal.SIGINT)
            break
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (130, "")
    stopped, command = err.splitlines()[-2:]
    done = int(re.fullmatch(r"stopped after frame (\d+); all files in long frames are whole. To go on:", stopped)[1])  # type: ignore[index]
    files = sorted((folder / "long frames").iterdir())
    assert len(files) in (done, done + 1)
    assert [file.name for file in files] == [f"long.{number:04}.png" for number in range(1, len(files) + 1)]
    for file in files:
        with Image.open(file) as picture:
            picture.load()
    words = shlex.split(command)
    assert words[:-1] == ["graphfx", "cook", "long.json", "--out", "long frames", "--set", "speed=2", "--frames"]
    assert parse_frames(words[-1], 1, LAST) == list(range(done + 1, LAST + 1))


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C reaches processes otherwise there")
def test_interrupt_leaves_no_movie(started: Callable[..., subprocess.Popen[str]], folder: Path) -> None:
    """Stopped by Ctrl-C, a preview leaves no file, and prints the command that makes all of it again."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["time"]["frames"] = [1, LAST]
    (folder / "long.json").write_text(json.dumps(graph))
    process = started("preview", "long.json", "--out", "shown/long.webp", "--size", "64x36", "--limit-pixels", "9999")
    assert process.stderr is not None
    assert any(line.startswith("frame 4 ") for line in process.stderr)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (130, "")
    stopped, command = err.splitlines()[-2:]
    assert re.fullmatch(r"stopped after frame \d+; all files in shown are whole; no movie is written, as it needs all of its "
                        r"5,000 frames. To begin again:", stopped)
    assert shlex.split(command) == ["graphfx", "preview", "long.json", "--out", "shown/long.webp", "--size", "64x36",
                                    "--limit-pixels", "9999", "--frames", f"1-{LAST}"]
    assert list((folder / "shown").iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="there are no such signals there")
@pytest.mark.parametrize(("name", "code"), [("SIGTERM", 143), ("SIGHUP", 129)])
@pytest.mark.parametrize("output", [{"file": "x.####.exr", "deep": True}, None])
def test_signals_leave_nothing_partial(started, folder: Path, name: str, code: int, output: dict[str, object] | None) -> None:
    """Told twice to stop, as `timeout` does, a cook cleans as after Ctrl-C and prints the command; 128 + the signal's number."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["time"]["frames"] = [1, LAST]
    graph["nodes"]["frames"] |= output or {}
    if output is None:
        graph["nodes"]["shown"] = {"type": "movie", "image": "frames", "file": "x.webp"}
    (folder / "long.json").write_text(json.dumps(graph))
    process = started("cook", "long.json", "--out", "made")
    assert any(line.startswith("frame 4 ") for line in process.stderr)
    for _ in range(2):
        process.send_signal(getattr(signal, name))
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (code, "")
    stopped, command = err.splitlines()[-2:]
    assert re.match(r"stopped after frame \d+; all files in made are whole", stopped)
    assert shlex.split(command)[:-1] == ["graphfx", "cook", "long.json", "--out", "made", "--frames"]
    assert [file.name for file in (folder / "made").iterdir() if file.suffix not in ((".exr",) if output else ())] == []


@pytest.mark.skipif(os.name == "nt", reason="there is no such signal there")
def test_what_is_ignored_stays_so(folder: Path) -> None:
    """Under nohup a closed terminal does not stop a cook; elsewhere the former handlers are there again afterwards."""
    former = signal.signal(signal.SIGHUP, signal.SIG_IGN), signal.signal(signal.SIGTERM, signal.SIG_DFL)
    try:
        with stoppable():
            os.kill(os.getpid(), signal.SIGHUP)
            with pytest.raises(Stopped):
                signal.raise_signal(signal.SIGTERM)
        assert (signal.getsignal(signal.SIGHUP), signal.getsignal(signal.SIGTERM)) == (signal.SIG_IGN, signal.SIG_DFL)
    finally:
        signal.signal(signal.SIGHUP, former[0])
        signal.signal(signal.SIGTERM, former[1])
