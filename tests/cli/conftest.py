"""How the tests run `graphfx`: in this process, or in one of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from graphfx.cli.main import main

FOUNTAIN: dict[str, Any] = {
    "graphfx": 1,
    "time": {"fps": 24, "frames": [1, 6]},
    "params": {"speed": {"type": "float", "default": 3, "min": 0, "unit": "m/s", "doc": "Upwards."}},
    "nodes": {
        "spring": {"type": "emit", "rate": 240, "life": 1, "set": {"velocity": {"expr": "vec(0, param.speed, 0)"}}},
        "fall": {"type": "stack", "from": "spring", "ops": [{"type": "gravity"}]},
        "view": {"type": "camera"},
        "frames": {"type": "image", "from": "fall", "camera": "view", "size": [32, 18]},
    },
}


class Outcome(NamedTuple):
    """What a command left: exit code, standard output, standard error."""

    code: int
    out: str
    err: str


Invoke = Callable[..., Outcome]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty current folder with the graph fountain.json in it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fountain.json").write_text(json.dumps(FOUNTAIN))
    return tmp_path


@pytest.fixture
def invoke(folder: Path, capsys: pytest.CaptureFixture[str]) -> Invoke:
    """Run the command in this process."""

    def run(*arguments: str) -> Outcome:
        capsys.readouterr()
        with pytest.raises(SystemExit) as end:
            main.main(list(arguments))
        return Outcome(int(end.value.code or 0), *capsys.readouterr())

    return run


@pytest.fixture
def started(folder: Path) -> Callable[..., subprocess.Popen[str]]:
    """Start the command in a process of its own, in which signals do what they do at a terminal."""

    def at_a_terminal() -> None:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)

    def start(*arguments: str, **options: Any) -> subprocess.Popen[str]:
        if os.name != "nt":
            options.setdefault("preexec_fn", at_a_terminal)
        return subprocess.Popen([sys.executable, "-m", "graphfx", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, **options)

    return start
