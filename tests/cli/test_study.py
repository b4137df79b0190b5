"""`graphfx study`: a table, a page and data of a graph; what is wrong is told in words."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from .conftest import Invoke

QUICK = ("--particles", "5", "--frames", "3,6", "--seconds", "20")


def test_a_study_is_told_and_written(folder: Path, invoke: Invoke) -> None:
    """A table with every setting, what is taken for the truth, the recommendation; a page and data beside it."""
    done = invoke("study", "fountain.json", *QUICK)
    assert done.code == 0
    for word in ("p95 [m]", "the graph as it is", "exact      1 step   32 bits", "truth: ", "checked by ", "recommended: exact"):
        assert word in done.out
    assert done.out.endswith("wrote out/fountain/study.html, out/fountain/study.json\n")
    assert (folder / "out/fountain/study.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert json.loads((folder / "out/fountain/study.json").read_text())["graph"] == "fountain"


def test_data_go_to_the_output(folder: Path, invoke: Invoke) -> None:
    """--json prints the data alone, says nothing, and writes no file without --out."""
    done = invoke("study", "fountain.json", *QUICK, "--json", "--set", "speed=1")
    assert (done.code, done.err) == (0, "")
    assert json.loads(done.out)["recommended"]["time"]["method"] == "exact"
    assert not (folder / "out").exists()


def test_a_graph_without_a_picture_is_studied(folder: Path, invoke: Invoke) -> None:
    """Its particles are all that its emitters make."""
    graph = json.loads((folder / "fountain.json").read_text())
    del graph["nodes"]["frames"], graph["nodes"]["view"]
    (folder / "bare.json").write_text(json.dumps(graph))
    done = invoke("study", "bare.json", *QUICK, "--json")
    assert done.code == 0 and json.loads(done.out)["sampled"] == {"spring": 5}


def test_fields_are_explained(folder: Path, invoke: Invoke) -> None:
    """--fields needs no graph, and tells of each field in a line."""
    told = invoke("study", "--fields").out.splitlines()
    assert len(told) > 40 and any(line.startswith("results[].error.p95 ") for line in told)
    assert any(line.startswith("runs[].outcome ") for line in invoke("study", "--fields", "--stability").out.splitlines())


@pytest.mark.parametrize("arguments, message", [
    ((), "study: GRAPH is missing\n  'graphfx study --help' says what it takes\n"),
    (("--stability", "fountain.json"), "study: --stability takes no GRAPH: it tries the operators of the library\n"),
    (("fountain.json", "--frames", "9"),
     "--frames: '9' goes beyond the graph's frames 1 to 6; change time.frames in the graph to have more\n"),
])
def test_mistakes_are_told(folder: Path, invoke: Invoke, arguments, message) -> None:
    """What cannot be is refused before any work."""
    done = invoke("study", *arguments)
    assert (done.code, done.out, done.err) == (2, "", message)
