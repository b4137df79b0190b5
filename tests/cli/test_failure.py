"""Whatever goes wrong becomes a plain message and a documented exit code."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from graphfx.graph import check as check_module

WRONG_GRAPH = """\
fountain.json:1:190: nodes.spring.rte: emit has no parameter 'rte'. Did you mean 'rate'?
  emit takes: rate [1/s], life [s], count, vertices, every [s]
  declared in nodes/emitters/emit.py
fountain.json:1:332: nodes.fall.ops[0].type: there is no node type 'gravty'. Did you mean 'gravity'?
"""


def test_own_mistake_is_one_line(invoke, monkeypatch: pytest.MonkeyPatch) -> None:
    """An exception that is no message of ours is our own mistake: one line, where it is, exit code 70."""

    def broken(*_: object) -> None:
        raise KeyError("spring")

    monkeypatch.setattr(check_module, "check", broken)
    line = broken.__code__.co_firstlineno + 1
    assert invoke("check", "fountain.json") == (
        70, "", f"graphfx itself is wrong: KeyError: 'spring' (test_failure.py:{line}); run with --debug to see where\n")


@pytest.mark.parametrize("arguments", [["--debug", "check", "fountain.json"], ["check", "fountain.json", "--debug"]])
def test_debug_shows_where(invoke, monkeypatch: pytest.MonkeyPatch, arguments: list[str]) -> None:
    """`--debug`, before or after the command, shows the traceback as well."""
    monkeypatch.setattr(check_module, "check", lambda *_: 1 // 0)
    code, _, err = invoke(*arguments)
    assert code == 70
    assert err.startswith("Traceback (most recent call last):")
    assert "ZeroDivisionError" in err.splitlines()[-1]


def test_no_memory(invoke, monkeypatch: pytest.MonkeyPatch) -> None:
    """Want of memory is a limit, not a mistake."""

    def full(*_: object) -> None:
        raise MemoryError("Unable to allocate 12 TiB")

    monkeypatch.setattr(check_module, "check", full)
    assert invoke("check", "fountain.json") == (4, "", "there is not enough memory: Unable to allocate 12 TiB\n")


def test_stopped(invoke, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C in a command that writes nothing is one word."""

    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(check_module, "check", stopped)
    assert invoke("check", "fountain.json") == (130, "", "stopped\n")


@pytest.mark.skipif(os.name == "nt", reason="pipes close otherwise there")
@pytest.mark.parametrize("arguments", [["nodes"], ["schema"], ["plan", "fountain.json"]])
def test_closed_pipe_is_quiet(started: Callable[..., subprocess.Popen[str]], arguments: list[str]) -> None:
    """Who pipes into `head` sees no complaint."""
    process = started(*arguments)
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.close()
    assert process.stderr.read() == ""
    assert process.wait(timeout=30) == 141
    process.stderr.close()


@pytest.mark.parametrize("command", ["cook", "check", "plan", "format"])
def test_no_graph_file(invoke, folder: Path, command: str) -> None:
    """A missing file, and a folder in place of a file, are said plainly."""
    (folder / "graphs").mkdir()
    assert invoke(command, "missing.json") == (1, "", "missing.json: there is no such file\n")
    assert invoke(command, "graphs") == (1, "", "graphs: this is a folder; name a graph's file in it\n")


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() == 0, reason="nothing is unreadable for the superuser")
def test_unreadable_graph_file(invoke, folder: Path) -> None:
    """A file that may not be read is said so."""
    (folder / "fountain.json").chmod(0)
    assert invoke("check", "fountain.json") == (1, "", "fountain.json: the file cannot be read: Permission denied\n")


@pytest.mark.parametrize("command", ["cook", "plan"])
def test_wrong_graph(invoke, folder: Path, command: str) -> None:
    """All problems of a graph are told, each with its place; nothing is written."""
    text = (folder / "fountain.json").read_text()
    (folder / "fountain.json").write_text(text.replace('"rate"', '"rte"').replace('"gravity"', '"gravty"'))
    assert invoke(command, "fountain.json") == (1, "", WRONG_GRAPH)
    assert [file.name for file in folder.iterdir()] == ["fountain.json"]
