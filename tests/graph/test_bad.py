"""Bad graphs, each with the whole message that its author should read."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphfx.errors import GraphfxError
from graphfx.graph.check import check
from graphfx.graph.document import load_document
from graphfx.node import Library

HERE = Path(__file__).parent
BAD = HERE / "bad"
NAMES = sorted(path.stem for path in BAD.glob("*.json"))


def told(name: str, library: Library) -> str:
    """Return all that the checks say of one bad graph, with folders under names that no machine changes."""
    try:
        problems = check(load_document(f"{name}.json"), library)
    except GraphfxError as error:
        problems = error.problems
    text = "\n".join(str(problem) for problem in problems) + "\n"
    for root, shown in ((BAD.resolve(), "<here>"), (library.roots[0], "<library>"), (library.roots[1], "<language>")):
        text = text.replace(str(root), shown)
    return text


@pytest.mark.parametrize("name", NAMES)
def test_a_mistake_is_told_in_full(name: str, library: Library, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each mistake is told with file, line, column, JSON path, what was wanted and what to do."""
    monkeypatch.chdir(BAD)
    assert told(name, library) == (BAD / f"{name}.expected").read_text(encoding="utf-8")


def test_five_mistakes_are_told_at_once(library: Library, monkeypatch: pytest.MonkeyPatch) -> None:
    """No check stops at the first problem."""
    monkeypatch.chdir(BAD)
    assert len(check(load_document("five_mistakes.json"), library)) == 5


def test_there_are_many_bad_graphs() -> None:
    """The corpus covers at least sixty ways to be wrong."""
    assert len(NAMES) >= 60
