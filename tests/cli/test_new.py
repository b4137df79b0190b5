"""`graphfx new`: what it writes works at once, and nothing is written over."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from graphfx.cli.scaffold import DEFAULT_ROLES, roles_of
from graphfx.contract import subject, truths_of

ROLES = [(kind, role) for kind in DEFAULT_ROLES for role in roles_of(kind)]


def test_new_nodes_pass_their_tests(invoke, folder: Path) -> None:
    """A new node of every role passes the test written with it, run by pytest in the user's folder."""
    for kind, role in ROLES:
        code, out, err = invoke("new", "node", f"my_{role}", "--kind", kind, "--role", role, "--in", "mine")
        assert (code, err) == (0, "")
        assert out == (f"wrote mine/nodes/{kind}/my_{role}.py\nwrote mine/tests/test_my_{role}.py\n"
                       f"'pytest mine/tests/test_my_{role}.py' tests it; 'graphfx nodes my_{role} --library mine' shows it\n")
    result = subprocess.run([sys.executable, "-m", "pytest", "mine"], capture_output=True, text=True, cwd=folder)
    assert result.returncode == 0, result.stdout
    assert "passed" in result.stdout
    assert all(len(truths_of(subject(f"my_{role}", folder / "mine"))) >= 4 for _, role in ROLES)


def test_new_test_finds_a_broken_formula(invoke, folder: Path) -> None:
    """The test written with a node fails when the node's formula changes."""
    invoke("new", "node", "blow")
    file = folder / "nodes" / "operators" / "blow.py"
    file.write_text(file.read_text().replace("wind * dt", "wind * (dt * dt)"))
    result = subprocess.run([sys.executable, "-m", "pytest"], capture_output=True, text=True, cwd=folder)
    assert result.returncode == 1
    assert "two half steps do not give the position of a whole one" in result.stdout
    assert "test_by_hand" in result.stdout


def test_new_node_is_shown_and_used(invoke, folder: Path) -> None:
    """A new node has docs, and graphs may use it."""
    invoke("new", "node", "blow", "--in", "mine")
    told = invoke("nodes", "blow", "--library", "mine").out
    assert told.startswith("blow (operators, flow)\n\nBlow: say here in one sentence what it does.\n")
    (folder / "sample.json").write_text(told[told.index("{"):])
    assert invoke("check", "sample.json", "--library", "mine").code == 0


def test_nothing_is_written_over(invoke, folder: Path) -> None:
    """Where a file of that name is, of node or test, nothing is written."""
    (folder / "tests").mkdir()
    (folder / "tests" / "test_blow.py").write_text("mine")
    assert invoke("new", "node", "blow") == (2, "", "tests/test_blow.py is there already; choose another name, or delete it\n")
    assert sorted(file.name for file in folder.rglob("*.*")) == ["fountain.json", "test_blow.py"]
    assert invoke("new", "graph", "fountain") == (2, "", "fountain.json is there already; choose another name, or delete it\n")


@pytest.mark.parametrize(("arguments", "message"), [
    (["Blow"], "a node's name is a function's: small letters, digits and '_', as in 'blow_away'; 'Blow' is not"),
    (["../blow"], "a node's name is a function's: small letters, digits and '_', as in 'blow_away'; '../blow' is not"),
    (["lambda"], "a node's name is a function's: small letters, digits and '_', as in 'blow_away'; 'lambda' is not"),
    (["vortex"], "there is a node type 'vortex' already, in nodes/operators; choose another name"),
    (["length"], "'length' means something already, in graphs or in graphfx.math; choose another name"),
    (["rand"], "'rand' means something already, in graphs or in graphfx.math; choose another name"),
    (["blow", "--kind", "operator"],
     "--kind operator: a new node is one of operators, values, selectors, geometry. Did you mean 'operators'?"),
    (["blow", "--role", "flo"],
     "--role flo: operators have the roles flow, linear, acceleration, velocity, assign, surface, noise."
     " Did you mean 'flow'?"),
    (["blow", "--kind", "values", "--role", "flow"], "--role flow: values have the roles value."),
])
def test_wrong_requests(invoke, folder: Path, arguments: list[str], message: str) -> None:
    """A name or role that cannot be is told, and nothing is written."""
    assert invoke("new", "node", *arguments) == (2, "", f"{message}\n")
    assert [file.name for file in folder.rglob("*")] == ["fountain.json"]


def test_folder_that_cannot_be_made(invoke, folder: Path) -> None:
    """Where a file is in the way of the folder, that is told."""
    assert invoke("new", "node", "blow", "--in", "fountain.json") == (
        3, "", "the folder fountain.json/nodes/operators cannot be made: Not a directory\n")


def test_new_graph_cooks(invoke, folder: Path) -> None:
    """A new graph is in canonical form, sound, and cooks."""
    assert invoke("new", "graph", "rain") == (0, "wrote rain.json\n'graphfx cook rain.json' cooks it\n", "")
    assert invoke("format", "--check", "rain.json").code == invoke("check", "rain.json").code == 0
    assert invoke("cook", "rain.json", "--frames", "2").code == 0
    assert invoke("new", "graph", "a b") == (2, "", "a graph's name is made of letters, digits, '_' and '-'; 'a b' is not\n")
