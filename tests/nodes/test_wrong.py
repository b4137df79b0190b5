"""Each mistake in a node's file is told at the file's own line, with what to do, and nothing else is said.

A file of wrong/ is a node's text, a line of dashes, and what the command prints.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from graphfx.cli.main import main

WRONG = Path(__file__).parent / "wrong"
CASES = sorted(file.stem for file in WRONG.glob("*.txt"))
DASHES = "-----\n"


def graph_with(name: str) -> str:
    nodes = {
        "source": {"type": "emit", "rate": 60},
        "motion": {"type": "stack", "from": "source", "ops": [{"type": name}]},
        "view": {"type": "camera"},
        "frames": {"type": "image", "from": "motion", "camera": "view", "size": [32, 18]},
    }
    return json.dumps({"graphfx": 1, "time": {"frames": [1, 2]}, "nodes": nodes})


@pytest.fixture
def wrong_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return what writes one wrong node into a library here, and a graph that uses it."""
    monkeypatch.chdir(tmp_path)

    def write(name: str) -> str:
        text, _, told = (WRONG / f"{name}.txt").read_text(encoding="utf-8").partition(DASHES)
        file = tmp_path / "mine" / "nodes" / "operators" / f"{name}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        (tmp_path / "graph.json").write_text(graph_with(name))
        return told

    return write


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as end:
        main.main(list(arguments))
    return int(end.value.code or 0), *capsys.readouterr()


@pytest.mark.parametrize("name", CASES)
def test_mistake_is_told_at_its_line(wrong_library, capsys: pytest.CaptureFixture[str], name: str) -> None:
    """A cook of a graph with a wrong node prints the mistake, and exits with 1."""
    told = wrong_library(name)
    assert run(capsys, "cook", "graph.json", "--library", "mine", "--json") == (1, "", told)
    assert told.startswith(f"mine/nodes/operators/{name}.py:")


def test_wrong_node_hides_no_other(wrong_library, capsys: pytest.CaptureFixture[str]) -> None:
    """`graphfx nodes` lists all sound nodes, and tells of the wrong ones at their lines."""
    told = wrong_library("import_unknown") + wrong_library("unknown_argument")
    code, out, err = run(capsys, "nodes", "--library", "mine")
    assert (code, err) == (1, told)
    assert "  vortex " in out
    assert run(capsys, "nodes", "vortex", "--library", "mine")[::2] == (0, "")
    assert run(capsys, "nodes", "import_unknown", "--library", "mine") == (1, "", told.splitlines(keepends=True)[0])


def test_wrong_node_that_is_not_used(wrong_library, capsys: pytest.CaptureFixture[str]) -> None:
    """A wrong node in a library does not keep a graph from being cooked that does not use it."""
    wrong_library("not_python")
    Path("graph.json").write_text(graph_with("gravity"))
    assert run(capsys, "check", "graph.json", "--library", "mine") == (0, "graph.json: nothing is wrong\n", "")


SHAPE = '''"""Shape: a box that is made wrong."""

from graphfx.geometry import Mesh, box
from graphfx.node import geometry, param


@geometry
def shape(size: float = param(1.0, unit="m", min=0, doc="Length of its sides.")) -> Mesh:
    """Return the box."""
    sides = [size, size]
    return box((*sides, sides[2]))
'''
STEP = '''"""Step: a value that is found when the graph is planned."""

from graphfx.node import param, value


@value
def step(height: float = param(1.0, doc="Height of the step.")) -> float:
    """Return the height."""
    return heigth
'''


@pytest.mark.parametrize(("kind", "name", "text", "use", "told"), [
    ("geometry", "shape", SHAPE, {"mesh": {"type": "shape"}, "source": {"type": "emit", "set": {
        "position": {"on_surface": {"mesh": "mesh"}}}}},
     "mine/nodes/geometry/shape.py:11: shape: IndexError: list index out of range\n"),
    ("values", "step", STEP, {"source": {"type": "emit", "rate": {"step": {}}}},
     "mine/nodes/values/step.py:9: step: there is no 'heigth' here. Did you mean 'height'?\n"),
])
def test_mistakes_that_show_before_the_cook(wrong_library, capsys, tmp_path, kind, name, text, use, told) -> None:
    """What fails in plain Python, as a mesh is made or a constant found, is told at its line of the node."""
    file = tmp_path / "mine" / "nodes" / kind / f"{name}.py"
    file.parent.mkdir(parents=True)
    file.write_text(text)
    nodes = {**use, "view": {"type": "camera"}, "frames": {"type": "image", "from": "source", "camera": "view", "size": [32, 18]}}
    (tmp_path / "graph.json").write_text(json.dumps({"graphfx": 1, "time": {"frames": [1, 2]}, "nodes": nodes}))
    assert run(capsys, "cook", "graph.json", "--library", "mine", "--json") == (1, "", told)
