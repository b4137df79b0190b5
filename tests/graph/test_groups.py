"""Groups: parameters promoted through levels, streams out of nothing, several instances, spawns inside."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from graphfx.graph.check import check
from graphfx.graph.check_document import read_graph
from graphfx.graph.checking import Checking
from graphfx.graph.document import document_of, load_document
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.graph.values import Literal, Random
from graphfx.node import Library, Parameter

SKY = {"sky": {"type": "emit"}}
THROUGH = {"inputs": {"p": {"doc": "Any."}}}


def put(folder: Path, name: str, nodes: dict[str, Any], **top: Any) -> None:
    """Write a group beside the graphs of a test."""
    (folder / f"{name}.json").write_text(json.dumps({"graphfx": 1, **top, "nodes": nodes}))


def use(*names: str) -> dict[str, str]:
    return {name: f"{name}.json" for name in names}


def flat(folder: Path, library: Library, nodes: dict[str, Any], **top: Any) -> FlatGraph:
    return flatten(document_of({"graphfx": 1, **top, "nodes": nodes}, folder=folder), library)


def told(folder: Path, library: Library, nodes: dict[str, Any], **top: Any) -> list[str]:
    return [problem.message for problem in check(document_of({"graphfx": 1, **top, "nodes": nodes}, folder=folder), library)]


@pytest.fixture
def levels(tmp_path: Path) -> Path:
    """Three groups, each around the next: `inner` exposes a vortex's, `middle` inner's in a stack, `outer` middle's."""
    put(tmp_path, "inner", {"left": {"type": "vortex", "from": "p", "tightness": 2}}, **THROUGH, outputs={"p": "left"},
        expose=["left.tightness", "left.lift"])
    put(tmp_path, "middle", {"fall": {"type": "stack", "from": "p", "ops": [{"type": "inner"}, {"type": "inner", "id": "two"}]}},
        **THROUGH, use=use("inner"), outputs={"p": "fall"}, expose=["fall/inner.tightness", "fall/two.lift"])
    put(tmp_path, "outer", {"one": {"type": "middle", "from": "p", "tightness": 3}}, **THROUGH, use=use("middle"),
        outputs={"p": "one"}, expose=["one.tightness", "one.lift"])
    return tmp_path


def test_a_promoted_parameter_keeps_its_declaration(levels: Path, library: Library) -> None:
    """Through three levels go type, unit, range and doc; the default is the one stated nearest."""
    checking = Checking(library)
    params = read_graph(load_document(levels / "outer.json"), checking).params
    doc = library["vortex"].parameters["tightness"].doc
    assert checking.problems == []
    assert params["tightness"] == Parameter("tightness", "float", 3.0, "", 0, 8, (), doc)
    assert (params["lift"].unit, params["lift"].default) == ("m/s", 0.0)


def test_a_promoted_parameter_reaches_the_inmost_node(levels: Path, library: Library) -> None:
    """What the outmost instance is given stands at the node three levels in, and at no other."""
    nodes = {**SKY, "a": {"type": "outer", "from": "sky"},
             "b": {"type": "outer", "from": "a", "tightness": 5, "lift": {"expr": "age"}}}
    found = flat(levels, library, nodes, use=use("outer")).nodes
    tightness = {path: node.arguments["tightness"].value for path, node in found.items() if "tightness" in node.arguments}  # type: ignore[attr-defined]
    assert tightness == {"a/one/fall/inner/left": 3.0, "a/one/fall/two/left": 2.0, "b/one/fall/inner/left": 5.0,
                         "b/one/fall/two/left": 2.0}
    lifts = [isinstance(node.arguments["lift"], Literal) for path, node in found.items() if path.startswith("b/")]
    assert lifts == [True, False]


def test_the_range_holds_at_every_level(levels: Path, library: Library) -> None:
    """A value out of the inmost range is told where it is written."""
    nodes = {**SKY, "a": {"type": "outer", "from": "sky", "tightness": 9}}
    assert told(levels, library, nodes, use=use("outer")) == ["9 is out of range; tightness must lie between 0 and 8"]


def test_two_exposed_parameters_of_one_name_are_told(levels: Path, library: Library) -> None:
    """A graph has one parameter of a name; which of two is meant must be said by `params`."""
    nodes = {**SKY, "a": {"type": "inner", "from": "sky"}, "b": {"type": "inner", "from": "a"}}
    assert told(levels, library, nodes, use=use("inner"), expose=["a.tightness", "b.tightness"]) == [
        "the graph has a parameter 'tightness' already; one of the two must go"]


def test_a_group_may_make_its_own_stream(library: Library, tmp_path: Path) -> None:
    """A group with outputs alone is a source; each instance is an emitter of its own, with its own numbers."""
    put(tmp_path, "jet", {"drops": {"type": "emit", "life": {"rand": [1, 2]}}, "v": {"type": "spiral", "from": "drops"}},
        outputs={"water": "v"})
    nodes = {"a": {"type": "jet"}, "b": {"type": "jet"}, "all": {"type": "vortex", "from": ["a", "b.water"]}}
    found = flat(tmp_path, library, nodes, use=use("jet")).nodes
    assert found["all"].sources == ("a/v", "b/v")
    lives = [found[path].arguments["life"] for path in ("a/drops", "b/drops")]
    assert [life.seed for life in lives if isinstance(life, Random)] == ["a/drops/life", "b/drops/life"]


def test_a_group_may_spawn(library: Library, tmp_path: Path) -> None:
    """One stream in, and out both what came in and what was made of it; alone it may stand in a stack."""
    spawn = {"type": "spawn", "from": "p", "when": "hit", "count": {"param": "many"}, "probability": {"expr": "parent.mass"}}
    params = {"many": {"type": "int", "default": 3, "min": 1}}
    put(tmp_path, "splash", {"drops": spawn}, **THROUGH, params=params, outputs={"drops": "drops"})
    put(tmp_path, "both", {"drops": spawn}, **THROUGH, params=params, outputs={"all": "p", "drops": "drops"})
    nodes = {**SKY, "s": {"type": "stack", "from": "sky", "ops": [{"type": "splash", "many": 5}, {"type": "spiral"}]},
             "b": {"type": "both", "from": "sky"}, "v": {"type": "vortex", "from": "b.all"},
             "w": {"type": "vortex", "from": "b.drops"}}
    found = flat(tmp_path, library, nodes, use=use("splash", "both")).nodes
    assert {path: found[path].sources for path in ("s/splash/drops", "s/spiral", "v", "w")} == {
        "s/splash/drops": ("sky",), "s/spiral": ("s/splash/drops",), "v": ("sky",), "w": ("b/drops",)}
    assert found["s/splash/drops"].arguments["count"].value == 5  # type: ignore[attr-defined]


def test_what_joins_an_emitter_of_its_group_joins_the_instances(library: Library, tmp_path: Path) -> None:
    """`into` names the emitter of the same instance."""
    put(tmp_path, "chain", {"a": {"type": "emit"}, "b": {"type": "spawn", "from": "a", "when": "death", "into": "a"}},
        outputs={"a": "a"})
    found = flat(tmp_path, library, {"x": {"type": "chain"}, "y": {"type": "chain"}}, use=use("chain")).nodes
    assert [found[path].references for path in ("x/b", "y/b")] == [{"into": "x/a"}, {"into": "y/a"}]


def test_a_group_gates_its_spawns(library: Library, tmp_path: Path) -> None:
    """`only`, `during` and `enabled` of an instance hold for the spawns inside it; a selector's test is its own."""
    put(tmp_path, "g", {"s": {"type": "above", "from": "p"}, "b": {"type": "spawn", "from": "s", "when": "birth"}}, **THROUGH,
        outputs={"b": "b"})
    nodes = {**SKY, "g": {"type": "g", "from": "sky", "only": {"expr": "mass > 1"}, "during": [1, 2], "enabled": False}}
    found = flat(tmp_path, library, nodes, use=use("g")).nodes
    assert (found["g/b"].during, found["g/b"].enabled, found["g/b"].only is not None) == ((1.0, 2.0), False, True)
    assert found["g/s"].only.node_type.name == "above" and found["g/s"].enabled is False  # type: ignore[union-attr]
