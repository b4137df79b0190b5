"""The cache of compiled code: never stale, never trusted unread, never in the way."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from graphfx.lanes import cache, compiled
from graphfx.lanes.cache import CheckedCache, cache_folder, digest_of


def triple(values):
    return values[0] + values[1] * 18


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return an empty cache folder, in use."""
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def compilations_of_a_call() -> int:
    """Call a function that was never loaded in this process; return how many were compiled for it."""
    before = len(cache.compilations)
    assert compiled(triple)(np.arange(4)) == 18
    return len(cache.compilations) - before


def test_second_use_loads(folder):
    """What was compiled once is loaded, not compiled; one file is written, and no temporary one is left."""
    assert [compilations_of_a_call() for _ in range(3)] == [1, 0, 0]
    assert [file.suffix for file in folder.iterdir()] == [".code"]


def _truncate(file: Path) -> None:
    file.write_bytes(file.read_bytes()[:-100])


def _flip(file: Path) -> None:
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


def _flip_the_hash(file: Path) -> None:
    content = bytearray(file.read_bytes())
    content[0] ^= 0x80
    file.write_bytes(content)


def _append(file: Path) -> None:
    file.write_bytes(file.read_bytes() + b"\0")


def _replace_by_folder(file: Path) -> None:
    file.unlink()
    file.mkdir()


DAMAGE = {
    "truncated": _truncate,
    "flipped": _flip,
    "flipped hash": _flip_the_hash,
    "longer": _append,
    "empty": lambda file: file.write_bytes(b""),
    "short": lambda file: file.write_bytes(b"graphfx"),
    "text": lambda file: file.write_text("no code " * 100),
    "removed": Path.unlink,
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_file_is_compiled_again(damage, folder):
    """A damaged file costs one compilation; the result is right, and the file whole again."""
    compilations_of_a_call()
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    DAMAGE[damage](file)
    assert [compilations_of_a_call() for _ in range(2)] == [1, 0]
    assert len(file.read_bytes()) == len(whole)


def test_folder_in_a_files_place(folder):
    """What cannot be replaced is left; every process compiles for itself, and leaves no rubbish."""
    compilations_of_a_call()
    (file,) = folder.iterdir()
    _replace_by_folder(file)
    assert [compilations_of_a_call() for _ in range(2)] == [1, 1]
    assert list(folder.iterdir()) == [file]


def test_folder_that_cannot_be_made(tmp_path, monkeypatch):
    """A cache folder where a file stands costs the time to compile, and nothing else."""
    (tmp_path / "taken").write_text("mine")
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path / "taken" / "cache"))
    assert [compilations_of_a_call() for _ in range(2)] == [1, 1]
    assert (tmp_path / "taken").read_text() == "mine"


def test_folder_that_refuses(folder, monkeypatch):
    """A damaged file in a folder that lets nothing be removed or written is passed over."""
    compilations_of_a_call()
    (file,) = folder.iterdir()
    _flip(file)

    def refuse(*_given, **_named):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "unlink", refuse)
    monkeypatch.setattr(cache.tempfile, "mkstemp", refuse)
    assert compilations_of_a_call() == 1


def test_full_disk_leaves_no_partial_file(folder, monkeypatch):
    """When writing fails midway the result is right, and neither a file nor a temporary one remains."""

    class Full:
        def __init__(self, handle, _mode):
            self.handle = handle

        def __enter__(self):
            return self

        def __exit__(self, *_error):
            os.close(self.handle)

        def write(self, content):
            os.write(self.handle, content[:10])
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(cache.os, "fdopen", Full)
    assert compilations_of_a_call() == 1
    assert list(folder.iterdir()) == []


def _made_like(constant: int):
    scope: dict = {}
    exec(f"def scaled(values):\n    return values.sum() * {constant}\n", scope)
    return scope["scaled"]


def test_key_holds_constants():
    """Functions whose bytecode is the same but for a constant have different keys."""
    first, second = (_made_like(constant).__code__ for constant in (1000, 1001))
    assert first.co_code == second.co_code
    assert cache.code_digest(first) != cache.code_digest(second)


def test_borders_count():
    """Two parts are not the same as one that joins them."""
    assert digest_of([b"ab", b"c"]) != digest_of([b"a", b"bc"]) != digest_of([b"abc"])


@pytest.mark.parametrize("change", ["name", "code", "stamp"])
def test_any_change_is_another_file(change):
    """Name, code and stamp are all in the file's name."""
    given = {"name": "f", "code": b"1", "stamp": "s"}
    changed = given | {change: b"2" if change == "code" else "g"}
    magic = type("Codegen", (), {"magic_tuple": lambda self: ("cpu", "features")})()
    assert CheckedCache(**given)._file("sig", magic) != CheckedCache(**changed)._file("sig", magic)


def test_folder_is_where_it_is_told(monkeypatch, tmp_path):
    """GRAPHFX_CACHE is the folder itself; else it is `graphfx` in the user's cache folder."""
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path))
    assert cache_folder() == tmp_path
    monkeypatch.delenv("GRAPHFX_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(sys, "platform", "linux")
    assert cache_folder() == tmp_path / "graphfx"


FILL = """
import numpy as np
from graphfx.lanes import cache, compiled
def one(values): return values[4] + 7
def two(values): return values[4] + 2
def three(values): return values[0] + 3
print([int(compiled(f)(np.arange(5))) for f in (one, two, three)], len(cache.compilations))
"""


def test_processes_that_fill_an_empty_cache_together(tmp_path):
    """Four processes that start with an empty cache all get right results, and the next one compiles nothing."""
    script = tmp_path / "fill.py"
    script.write_text(FILL)
    environment = os.environ | {"GRAPHFX_CACHE": str(tmp_path / "cache")}

    def start() -> subprocess.Popen[str]:
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        return subprocess.Popen([sys.executable, str(script)], env=environment, text=True, **pipes)

    for process in [start() for _ in range(4)]:
        out, errors = process.communicate(timeout=100)
        assert out.startswith("[11, 6, 3]") and not errors
    assert start().communicate(timeout=100) == ("[11, 6, 3] 0\n", "")
    assert {file.suffix for file in (tmp_path / "cache").iterdir()} == {".code"}
