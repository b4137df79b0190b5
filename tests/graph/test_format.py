"""The canonical form: stable, idempotent, and it changes no meaning."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphfx.errors import GraphfxError
from graphfx.graph.check import check
from graphfx.graph.document import document_of, load_document, read_document
from graphfx.graph.flatten import flatten
from graphfx.graph.format import canonical
from graphfx.graph.layout import lay_out, text_of_number
from graphfx.graph.values import Value, children
from graphfx.node import Library, bundled_root

HERE = Path(__file__).parent
GRAPHS = [HERE / "good/everything.json", *sorted((HERE / "good/groups").glob("*.json")), *sorted((HERE / "bad").glob("*.json")),
          *sorted((bundled_root() / "graphs").rglob("*.json"))]


def meaning(tree: Any) -> Any:
    """Return a value without its places."""
    if isinstance(tree, Value):
        own = {key: part for key, part in vars(tree).items() if key not in ("location", "path", "_measure", "text")}
        return type(tree).__name__, {key: meaning(part) for key, part in own.items()}
    if isinstance(tree, tuple | list):
        return [meaning(part) for part in tree]
    return (tree.function, [meaning(part) for part in children(tree)]) if children(tree) else tree


def test_everything_has_its_canonical_form(library: Library) -> None:
    """Order, lines and what is left out are as the golden file says."""
    assert canonical(load_document(HERE / "good/everything.json"), library) == (HERE / "good/everything.canonical").read_text()


@pytest.mark.parametrize("path", GRAPHS, ids=lambda path: path.stem)
def test_the_canonical_form_is_its_own(path: Path, library: Library) -> None:
    """Formatting twice is formatting once, for right graphs and wrong ones; what is not JSON is refused."""
    try:
        text = canonical(load_document(path), library)
    except GraphfxError:
        return
    assert canonical(read_document(text), library) == text


def test_formatting_changes_no_meaning(library: Library) -> None:
    """The formatted graph flattens to the same nodes, values and seeds."""
    path = HERE / "good/everything.json"
    before = flatten(path, library)
    after = flatten(read_document(canonical(load_document(path), library), str(path), path.parent), library)
    for found in (before, after):
        for node in found.nodes.values():
            for values in (node.arguments, node.sets):
                for name, value in values.items():
                    values[name] = (meaning(value)[0], {key: part for key,
                        part in meaning(value)[1].items() if key != "seed"})  # type: ignore[assignment]
    compared = [[(n.path, n.sources, n.arguments, n.sets, n.during, n.when, n.enabled, n.looks) for n in found.nodes.values()]
                for found in (before, after)]
    compared = [[(*n[:7], tuple({k: v for k,
        v in look.items() if v != "over"} for look in n[7])) for n in nodes] for nodes in compared]
    assert compared[0] == compared[1]


def test_defaults_are_left_out(library: Library) -> None:
    """What a parameter, a modifier or a look is anyway is not written."""
    data = {"graphfx": 1, "nodes": {
        "a": {"life": "infinity", "rate": 100.0, "type": "emit", "enabled": True, "set": {}},
        "b": {"ops": [{"id": "vortex", "type": "vortex", "axis": [0, 1.0, 0], "magnitude": {"rand": [0, 1], "per": "life",
        "vary": 0}}],
              "from": ["a"], "type": "stack"},
        "c": {"camera": "v", "from": [{"stream": "b", "blend": "over"}], "type": "image", "background": "#000000"}}}
    assert json.loads(canonical(document_of(data), library)) == {"graphfx": 1, "nodes": {
        "a": {"type": "emit"},
        "b": {"type": "stack", "from": "a", "ops": [{"type": "vortex", "magnitude": {"rand": [0, 1]}}]},
        "c": {"type": "image", "from": "b", "camera": "v"}}}


@given(st.recursive(st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
                    lambda part: st.lists(part, max_size=5) | st.dictionaries(st.text(max_size=20), part, max_size=5),
                    max_leaves=30))
def test_layout_keeps_all_data(data: Any) -> None:
    """Laid-out text reads back as the same data, to the last bit and in the same order."""
    text = lay_out(data, broken=("", "nodes"))
    assert repr(json.loads(text, parse_int=float)) == repr(json.loads(json.dumps(data), parse_int=float))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_are_the_shortest_that_read_back(value: float) -> None:
    """A number's text gives the same bits, and is no longer than Python's."""
    text = text_of_number(value)
    assert (repr(float(text)), len(text) <= len(repr(value))) == (repr(value), True)


@pytest.mark.parametrize(("value", "text"), [(1.0, "1"), (-0.0, "-0.0"), (0.1, "0.1"), (1e22, "1e+22"), (1e14,
    "100000000000000"), (7, "7")])
def test_numbers_read_as_people_write_them(value: float, text: str) -> None:
    """Whole numbers have no point, and zero keeps its sign."""
    assert text_of_number(value) == text


def test_own_keys_stay(library: Library) -> None:
    """Keys that begin with `x-` are kept as they are, after the others."""
    data = {"x-a": [1.0, {"b": None}], "graphfx": 1, "nodes": {"v": {"x-pos": [1, 2], "type": "camera"}, "x-note": "n"}}
    text = canonical(document_of(data), library)
    assert json.loads(text) == data and text.index("x-a") > text.index("nodes") and text.index("x-pos") > text.index("camera")


def test_shipped_graphs_are_canonical_and_right() -> None:
    """Every graph of the library is stored in its canonical form and passes the checks."""
    library = Library([bundled_root()])
    for path in sorted((bundled_root() / "graphs").rglob("*.json")):
        document = load_document(path)
        assert check(document, library) == []
        assert canonical(document, library) == path.read_text(encoding="utf-8"), path
