"""What a cook tells while it runs."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from graphfx.cli.progress import Lines, Silence, in_words, progress_for, short_name
from graphfx.cook.effect import FrameReport


def report(frame: int) -> FrameReport:
    return FrameReport(frame, particles=12345, fragments=6789012, dropped=0, restless=0, failed=0, files=())


@pytest.mark.parametrize(("seconds", "words"), [
    (0.2, "0 s"), (59.4, "59 s"), (59.6, "1 min 0 s"), (125, "2 min 5 s"), (3600, "1 h 0 min"), (3840, "1 h 4 min"),
])
def test_times_in_words(seconds: float, words: str) -> None:
    """A time to wait is told in its two largest units."""
    assert in_words(seconds) == words


@pytest.mark.parametrize(("name", "short"), [
    ("kernel.vortex", "vortex"), ("graphfx.render.tiles._render_tiles", "render_tiles"), ("the renderer", "the renderer"),
])
def test_what_is_compiled(name: str, short: str) -> None:
    """Compiled code is called by the last part of its name."""
    assert short_name(name) == short


def test_lines(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Each frame is a line with its number, its place in the cook, particles, fragments and the time left."""
    clock = iter([100.0, 102.0, 104.0])
    monkeypatch.setattr("graphfx.cli.progress.time.monotonic", lambda: next(clock))
    with Lines(3) as progress:
        progress.compiling("kernel.vortex")
        for frame in (1, 5, 9):
            progress.frame(report(frame))
    assert capsys.readouterr() == ("", "compiling vortex (first time only)\n"
                                   "frame 1 (1 of 3): 12,345 particles, 6,789,012 fragments\n"
                                   "frame 5 (2 of 3): 12,345 particles, 6,789,012 fragments, 2 s left\n"
                                   "frame 9 (3 of 3): 12,345 particles, 6,789,012 fragments\n")


def test_silence(capsys: pytest.CaptureFixture[str]) -> None:
    """Where output is for programs, nothing is told."""
    with progress_for(3, terminal=True, quiet=True) as progress:
        assert isinstance(progress, Silence)
        progress.compiling("kernel.vortex")
        progress.frame(report(1))
    assert capsys.readouterr() == ("", "")


@pytest.mark.skipif(os.name == "nt", reason="there are no such terminals there")
def test_bar_on_a_terminal(folder: Path) -> None:
    """On a terminal one line moves; at its end it shows the last frame, all frames done, particles and fragments."""
    import pty

    ours, theirs = pty.openpty()
    environment = os.environ | {"COLUMNS": "120", "TERM": "xterm", "NO_COLOR": "1"}
    process = subprocess.Popen([sys.executable, "-m", "graphfx", "cook", "fountain.json"], stdout=subprocess.PIPE, stderr=theirs,
                               text=True, env=environment)
    os.close(theirs)
    shown = b""
    try:
        while part := os.read(ours, 65536):
            shown += part
    except OSError:  # Linux says so when the other end has closed
        pass
    finally:
        os.close(ours)
    out, _ = process.communicate(timeout=60)
    assert (process.returncode, out.partition(" (")[0]) == (0, f"wrote 6 files in {Path('out', 'fountain')}")
    plain = re.sub(r"\x1b\[[?0-9;]*[A-Za-z]", "", shown.decode())
    last = [line for line in re.split(r"[\r\n]+", plain) if line.strip()][-1]
    for part in ("frame 6", "6/6", "51 particles", " fragments"):
        assert part in last
