"""When the disk fails: a clear message, exit code 3, whole files, and the command to go on with."""

from __future__ import annotations

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from graphfx.cook import limits
from graphfx.cook.limits import in_bytes
from graphfx.output import atomic

FREE = "free some space, choose another folder with --out, write fewer with --frames, or allow it with --limit-disk"


def whole(folder: Path) -> list[str]:
    """Return the names of the files, all of which are whole pictures."""
    files = sorted(file for file in folder.rglob("*") if file.is_file())
    for file in files:
        if file.suffix == ".exr":
            with pytest.importorskip("OpenEXR").File(str(file)) as picture:
                assert picture.channels()
            continue
        with Image.open(file) as picture:
            picture.load()
    return [file.name for file in files]


@pytest.mark.parametrize(("number", "cause", "advice"), [
    (errno.ENOSPC, "No space left on device", "free some space there, or write to another disk"),
    (errno.EACCES, "Permission denied", "let it be written there, or choose another folder"),
    (errno.EROFS, "Read-only file system", "let it be written there, or choose another folder"),
    (errno.EIO, "Input/output error", ""),
])
@pytest.mark.parametrize("image", [{}, {"file": "{graph}.####.exr", "deep": True}])
def test_disk_that_fails_at_the_fourth_frame(invoke, folder: Path, monkeypatch, number, cause, advice, image) -> None:
    """Three frames are there, whole; nothing is left of the fourth; the rest can be made by the command that is told."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["nodes"]["frames"] |= image
    (folder / "fountain.json").write_text(json.dumps(graph))
    end = ".exr" if image else ".png"
    keep, kept = atomic._keep_content, []

    def fail(file: Path) -> None:
        kept.append(file)
        if len(kept) == 4:
            raise OSError(number, os.strerror(number))
        keep(file)

    monkeypatch.setattr(atomic, "_keep_content", fail)
    code, out, err = invoke("cook", "fountain.json", "--out", "made")
    file = Path("made", "fountain.0004" + end)
    assert (code, out) == (3, "")
    assert err.splitlines()[-3:] == [
        f"cannot write {file}: {cause}" + (f"; {advice}" if advice else ""),
        "  stopped after frame 3; all files in made are whole. To go on:",
        "  graphfx cook fountain.json --out made --frames 4-6",
    ]
    assert whole(folder / "made") == [f"fountain.000{frame}{end}" for frame in (1, 2, 3)]
    monkeypatch.setattr(atomic, "_keep_content", keep)
    assert invoke("cook", "fountain.json", "--out", "made", "--frames", "4-6").code == 0
    assert len(whole(folder / "made")) == 6


@pytest.mark.parametrize("image", [{}, {"file": "x.####.exr"}, {"file": "x.####.exr", "deep": True}])
@pytest.mark.skipif(os.name == "nt", reason="POSIX limits")
def test_files_that_may_not_be_so_large(folder: Path, image) -> None:
    """A limit of the system, met while a file is written, is told as such; PNG, EXR and deep EXR alike."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["nodes"]["frames"] |= {"size": [320, 180], **image}
    (folder / "fountain.json").write_text(json.dumps(graph))
    code = ("import resource, sys; from graphfx.cli.main import main; import graphfx.cook.effect; "
            "from graphfx.lanes.cache import CheckedCache; "
            "CheckedCache.save_overload = lambda *rest: None; "
            "resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300)); main.main(sys.argv[1:])")
    done = subprocess.run([sys.executable, "-c", code, "cook", "fountain.json", "--out", "made", "--frames", "3"],
                          capture_output=True, text=True, check=False)
    name = image.get("file", "{graph}.####.png").replace("{graph}", "fountain").replace("####", "0003")
    assert (done.returncode, done.stdout) == (3, "")
    assert done.stderr.splitlines()[-3:] == [
        f"cannot write {Path('made', name)}: File too large; no file may be so large there: choose another folder, or write "
        "smaller pictures",
        "  stopped before any file was written. To go on:",
        "  graphfx cook fountain.json --out made --frames 3",
    ]
    assert not list((folder / "made").iterdir())


def test_folder_of_a_name_that_is_a_file(invoke, folder: Path) -> None:
    """A file that stands where a folder of the name should be is told."""
    graph = json.loads((folder / "fountain.json").read_text())
    graph["nodes"]["frames"]["file"] = "near/x.####.png"
    (folder / "fountain.json").write_text(json.dumps(graph))
    (folder / "made").mkdir()
    (folder / "made" / "near").write_text("in the way")
    code, _, err = invoke("cook", "fountain.json", "--out", "made", "--frames", "1")
    assert code == 3 and f"cannot make the folder {Path('made', 'near')}: File exists" in err


def test_more_than_is_free_is_refused_before_any_work(invoke, folder: Path, monkeypatch) -> None:
    """What the pictures would take is told with what is free; a limit that is stated goes before."""
    monkeypatch.setattr(limits.shutil, "disk_usage", lambda folder: type("Usage", (), {"free": 1000})())
    code, _, err = invoke("cook", "fountain.json", "--out", "made")
    assert (code, err.strip()) == (4, f"6 frames would take about 2.6 kB, and 1 kB are free in made; {FREE} 2.6kB")
    assert not (folder / "made").exists()
    assert invoke("cook", "fountain.json", "--out", "made", "--limit-disk", "2.6kB").code == 0
    code, _, err = invoke("cook", "fountain.json", "--out", "made", "--limit-disk", "2k")
    assert (code, err.strip()) == (4, f"6 frames would take about 2.6 kB, and 2 kB are allowed; {FREE} 2.6kB")


@pytest.mark.parametrize("size", ["much", "0", "-5", "5 frames", "1e3", ""])
def test_sizes_that_are_none(invoke, size) -> None:
    """How a size is written is told."""
    code, _, err = invoke("cook", "fountain.json", "--limit-disk", size)
    assert code == 2 and f"--limit-disk: '{size}' is no size; write 500MB, 1.5G or a number of bytes" in err


@pytest.mark.parametrize(("count", "words"), [(0, "0 B"), (640, "640 B"), (1000, "1 kB"), (1_510_000, "1.6 MB"),
                                              (5e9, "5 GB"), (9.99e14, "999 TB"), (7e15, "7000 TB")])
def test_bytes_as_one_says_them(count, words) -> None:
    """Rounded up, so that allowing what is told is enough."""
    assert in_bytes(count) == words
