"""What the command says of itself, and how soon."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import graphfx
from graphfx.cli import commands

COMMANDS = sorted(file.stem.replace("_", "-") for file in Path(commands.__path__[0]).glob("[!_]*.py"))


def test_help_is_instant(started: Callable[..., subprocess.Popen[str]]) -> None:
    """`graphfx --help` takes less than 0.3 s of a processor, the best of three."""
    seconds = []
    for _ in range(3):
        before = os.times()
        started("--help").communicate(timeout=60)
        after = os.times()
        seconds.append(after.children_user + after.children_system - before.children_user - before.children_system)
    assert min(seconds) < 0.3


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["nonsense"], *([name, "--help"] for name in COMMANDS)])
def test_help_loads_no_large_library(arguments: list[str]) -> None:
    """Help and complaints of the command line need neither NumPy nor Numba."""
    code = f"import sys\nfrom graphfx.cli.main import main\ntry:\n    main.main({arguments!r})\nfinally:\n    print(*sys.modules)"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    loaded = {name.partition(".")[0] for name in result.stdout.splitlines()[-1].split()}
    assert loaded.isdisjoint({"numpy", "numba", "llvmlite", "networkx", "PIL", "rich"})


def test_no_arguments_show_help(invoke) -> None:
    """`graphfx` alone shows what `--help` shows, and that is no mistake."""
    assert invoke() == invoke("--help")
    assert invoke().code == 0


def test_help_lists_every_command_in_full(invoke) -> None:
    """Each file of `commands` is listed, with a summary that is not cut short."""
    listed = dict(re.findall(r"^  ([\w-]+) +(\S.*)$", invoke().out.partition("Commands:")[2], re.MULTILINE))
    assert sorted(listed) == COMMANDS
    assert [summary for summary in listed.values() if not summary.endswith(".") or summary.endswith("...")] == []


def test_version(invoke) -> None:
    """The version is the package's."""
    assert invoke("--version") == (0, f"graphfx {graphfx.__version__}\n", "")


@pytest.mark.parametrize(("arguments", "message"), [
    (["cok"], "graphfx: there is no command 'cok'. Did you mean 'cook'?\n  'graphfx --help' says what it takes\n"),
    (["teapot"], "graphfx: there is no command 'teapot'.\n  'graphfx --help' says what it takes\n"),
    (["--verison"],
     "graphfx: there is no option '--verison'. Did you mean '--version'?\n  'graphfx --help' says what it takes\n"),
    (["cook", "--frame", "1", "g.json"],
     "graphfx cook: there is no option '--frame'. Did you mean '--frames'?\n  'graphfx cook --help' says what it takes\n"),
    (["cook"], "graphfx cook: GRAPH is missing\n  'graphfx cook --help' says what it takes\n"),
    (["check"], "graphfx check: GRAPH... is missing\n  'graphfx check --help' says what it takes\n"),
    (["cook", "g.json", "--threads", "0"],
     "graphfx cook: --threads: 0 is not in the range 1<=x<=256.\n  'graphfx cook --help' says what it takes\n"),
    (["cook", "g.json", "--set", "speed"], "--set speed: write it as name=value\n"),
    (["cook", "g.json", "--set", "=4"], "--set =4: write it as name=value\n"),
    (["nodes", "vortx"], "there is no node type 'vortx'. Did you mean 'vortex'? 'graphfx nodes' lists them\n"),
    (["format", "--write", "--check", "fountain.json"], "--write changes files and --check does not; give one of them\n"),
])
def test_wrong_command_line(invoke, arguments: list[str], message: str) -> None:
    """A wrong command line exits with 2, and says what was meant where that can be told."""
    assert invoke(*arguments) == (2, "", message)
