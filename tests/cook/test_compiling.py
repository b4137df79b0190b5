"""What is compiled, and when: never for an edited graph, always for an edited node."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from .effects import effect, graph

REPORT = """
import json, sys
from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.lanes.cache import compilations
from graphfx.node import Library, library_roots
for document in json.load(open(sys.argv[1])):
    Effect(flatten(document_of(document), Library(library_roots()))).simulate(12)
print(json.dumps([name for name, _ in compilations]))
"""
SWIRL = {"type": "vortex", "magnitude": 2}
FALL = {"type": "gravity", "acceleration": {"expr": "vec(0, -age, 0)"}}


def compiled_by(tmp_path: Path, *documents: object) -> list[str]:
    """Return what a new process compiles to simulate documents."""
    (tmp_path / "report.py").write_text(REPORT)
    (tmp_path / "documents.json").write_text(json.dumps(documents))
    command = [sys.executable, str(tmp_path / "report.py"), str(tmp_path / "documents.json")]
    done = subprocess.run(command, env=os.environ.copy(), capture_output=True, text=True, timeout=300, check=True)
    return json.loads(done.stdout)


def test_editing_a_graph_compiles_nothing(tmp_path):
    """Other numbers, operators, steps, emitters, values per particle and functions never used before need no compiler."""
    falling = {"rate": 5, "life": 2}
    compiled_by(tmp_path, graph([SWIRL, FALL], falling))
    numbers = graph([SWIRL | {"magnitude": -0.3, "center": [1, 2, 3]}, FALL], {"rate": 7, "life": 0.2})
    operators = graph([SWIRL, FALL, SWIRL | {"id": "again"}, FALL | {"id": "fall2", "only": {"expr": "position.x > 0"}}], falling)
    functions = graph([SWIRL | {"magnitude": {"expr": "exp(sin(age) ** 2) - smoothstep(0, 1, length(velocity)) % 0.7"}}], falling)
    values = graph([SWIRL | {"magnitude": {"rand": [0, 1]}, "range": {"keys": [[0, 1], [1, 9]], "repeat": "mirror"}}], falling)
    steps = graph([SWIRL, FALL], {"rate": 500}, {"substeps": 4, "preroll": 0.1, "method": "sims"})
    assert compiled_by(tmp_path, numbers, operators, functions, values, steps) == []


NODE = '''"""Push: x grows by twice the amount each second."""

from graphfx.math import Vec3
from graphfx.node import operator, param


def amount(dt):
    """Return half of what is added."""
    half = dt * {factor}
    return half * 1.0


@operator.flow(writes="position")
def push(position: Vec3, dt: float, share: float = param(1.0, doc="Share of it.")) -> Vec3:
    """Return the position."""
    return position + Vec3(amount(dt) * 2.0 * share, dt * 0.0, dt * 0.0)
'''


def library(root: Path, factor: float) -> Path:
    """Write a library whose node `push` adds 2 factor a second; return its root."""
    file = root / "nodes" / "operators" / "push.py"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(NODE.format(factor=factor))
    return root


def pushed(root: Path) -> float:
    """Return how far a particle is pushed in one second."""
    emit = {"rate": 1, "during": [0, 0.5], "set": {"position": [0, 0, 0]}}
    return float(
        effect(graph([{"type": "push"}], emit, {"fps": 4, "frames": [1, 5]}), [root]).simulate(5)["sky"]["position"][0, 0]
    )


def test_changed_helper_is_compiled_anew(tmp_path):
    """When a function that a node calls changes, the node's next cook is by the new one; back again, by the old."""
    assert [pushed(library(tmp_path, factor)) for factor in (1.0, 3.0, 1.0, 0.25)] == [2.0, 6.0, 2.0, 0.5]


def test_two_libraries_with_a_node_of_one_name(tmp_path):
    """Nodes of one name from two libraries do not take each other's code, whichever is used first."""
    first, second = library(tmp_path / "a", 1.0), library(tmp_path / "b", 5.0)
    assert [pushed(root) for root in (first, second, first, second)] == [2.0, 10.0, 2.0, 10.0]


def test_changed_helper_in_another_process(tmp_path):
    """A process that finds the old code in the cache does not use it for the changed node."""
    script = "import sys; sys.path.insert(0, sys.argv[1]); from cook.test_compiling import *; print(pushed(Path(sys.argv[2])))"
    tests = str(Path(__file__).parent.parent)
    for factor in (7.0, 9.0):
        library(tmp_path, factor)
        done = subprocess.run(
            [sys.executable, "-c", script, tests, str(tmp_path)], capture_output=True, text=True, check=True, timeout=300
        )
        assert float(done.stdout) == 2 * factor


def test_user_node_that_branches(tmp_path):
    """A node with `branches=True` uses `if` and agrees with plain Python."""
    text = NODE.format(factor=1.0).replace("half * 1.0", "half * 1.0 if half > 0.05 else half * 0.0")
    text = text.replace('writes="position"', 'writes="position", branches=True')
    root = library(tmp_path, 1.0)
    (root / "nodes" / "operators" / "push.py").write_text(text)
    found = effect(graph([{"type": "push", "share": {"rand": [0, 1]}}], {"rate": 50}), [root])
    machine, plain = (found.simulate(12, reference=reference)["sky"]["position"] for reference in (False, True))
    assert np.array_equal(machine, plain)


@pytest.mark.parametrize("folder", ["missing/in/a/file", ""])
def test_cache_that_cannot_be_written(folder, tmp_path, monkeypatch):
    """Where no cache can be kept, a cook gives its result all the same."""
    (tmp_path / "missing").write_text("a file")
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path / folder))
    assert pushed(library(tmp_path / "library", 11.0)) == 22.0
