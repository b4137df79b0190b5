"""The groups of the library: documented, with units and ranges, and right in a small example each."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphfx.graph.check import check
from graphfx.graph.check_document import read_graph
from graphfx.graph.checking import Checking
from graphfx.graph.document import load_document
from graphfx.graph.flatten import flatten
from graphfx.graph.format import canonical
from graphfx.node import Library, bundled_root

LIBRARY = Library([bundled_root()])
GROUPS = sorted(path.stem for path in (bundled_root() / "graphs/groups").glob("*.json"))
EXAMPLES = Path(__file__).parent / "shipped"


def test_each_group_has_its_example() -> None:
    """No group is shipped without one, and none of the issue's is missing."""
    assert sorted(path.stem for path in EXAMPLES.glob("*.json")) == GROUPS
    assert set(GROUPS) >= {"gust", "flicker", "splat", "tornado", "fountain", "explosion", "orbit"}


@pytest.mark.parametrize("name", GROUPS)
def test_its_example_is_right(name: str) -> None:
    """It passes the checks, is in its canonical form, and uses the group in the flattened graph."""
    document = load_document(EXAMPLES / f"{name}.json")
    assert check(document, LIBRARY) == []
    assert canonical(document, LIBRARY) == (EXAMPLES / f"{name}.json").read_text(encoding="utf-8")
    assert any("/" in path for path in flatten(document, LIBRARY).nodes)


@pytest.mark.parametrize("name", GROUPS)
def test_its_parameters_are_documented(name: str) -> None:
    """The group says in one sentence what it is; each parameter has a sentence, each number a range, each length a unit."""
    graph = read_graph(load_document(bundled_root() / f"graphs/groups/{name}.json"), Checking(LIBRARY))
    assert graph.doc.endswith(".") and graph.outputs
    for parameter in graph.params.values():
        assert parameter.doc.endswith("."), parameter.name
        assert not parameter.required or parameter.type == "mesh", parameter.name
        assert parameter.unit == "m" or parameter.type != "point", parameter.name
        if parameter.type in ("float", "int"):
            low, high = parameter.min, parameter.max
            assert low is not None or high is not None, parameter.name
            assert (low is None or low <= parameter.default) and (high is None or parameter.default <= high), parameter.name
