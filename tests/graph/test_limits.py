"""Limits of flattened graphs: nodes, groups inside groups, values that refer to values."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from graphfx.errors import GraphError, LimitError
from graphfx.graph.document import document_of, load_document
from graphfx.graph.flatten import flatten
from graphfx.graph.limits import Limits
from graphfx.node import Library

GOOD = Path(__file__).parent / "good"


def graph(*ops: dict[str, Any], **top: Any) -> dict[str, Any]:
    """Return a graph of one stack."""
    return {"graphfx": 1, **top, "nodes": {"sky": {"type": "emit"}, "fall": {"type": "stack", "from": "sky", "ops": list(ops)}}}


def test_nodes_have_a_limit(library: Library) -> None:
    """A graph may flatten to exactly as many nodes as the limit says."""
    data = graph({"type": "vortex"}, {"type": "push_twice"}, use={"push_twice": "groups/push_twice.json"})
    assert len(flatten(document_of(data, folder=GOOD, limits=Limits(nodes=4)), library).nodes) == 4
    with pytest.raises(LimitError, match="more than 3 nodes"):
        flatten(document_of(data, folder=GOOD, limits=Limits(nodes=3)), library)


def test_values_that_double_at_each_name_are_refused(library: Library) -> None:
    """Thirty names, each twice the last, would be a billion parts."""
    values: dict[str, Any] = {"v0": {"expr": "age"}} | {f"v{i}": {"expr": f"v{i - 1} + v{i - 1}"} for i in range(1, 31)}
    with pytest.raises(GraphError, match="the limits are 10,000 and 100"):
        flatten(document_of(graph({"type": "vortex", "lift": {"expr": "v30"}}, values=values)), library)


def test_groups_that_double_at_each_level_are_refused(library: Library, tmp_path: Path) -> None:
    """Twenty levels of groups, each used twice, would be a million nodes."""
    for level in range(20):
        inner = f'"use": {{"g": "g{level + 1}.json"}},' if level < 19 else ""
        kind = "g" if level < 19 else "vortex"
        (tmp_path / f"g{level}.json").write_text(
            f'{{"graphfx": 1, {inner} "inputs": {{"p": {{}}}}, "outputs": {{"p": "b"}}, '
            f'"nodes": {{"a": {{"type": "{kind}", "from": "p"}}, "b": {{"type": "{kind}", "from": "a"}}}}}}')
    data = graph({"type": "g"}, use={"g": "g0.json"})
    with pytest.raises(LimitError, match="more than 1,000"):
        flatten(document_of(data, folder=tmp_path, limits=Limits(nodes=1000)), library)


def test_groups_have_a_depth_limit(library: Library, tmp_path: Path) -> None:
    """Groups may use groups exactly as deep as the limit says."""
    for level in range(4):
        use = f'"use": {{"g": "g{level + 1}.json"}}, ' if level < 3 else ""
        (tmp_path / f"g{level}.json").write_text(f'{{"graphfx": 1, {use}"nodes": {{}}}}')
    (tmp_path / "top.json").write_text('{"graphfx": 1, "use": {"g": "g0.json"}, "nodes": {}}')
    flatten(load_document(tmp_path / "top.json", Limits(group_depth=5)), library)
    with pytest.raises(GraphError, match="deeper than the limit of 4"):
        flatten(load_document(tmp_path / "top.json", Limits(group_depth=4)), library)
