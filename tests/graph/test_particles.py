"""Flattening of what makes, tells apart and changes particles: selectors, moments, spawns, meshes."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.flatten import flatten
from graphfx.graph.values import Call, Expression, Literal, Name, Node, Value, children
from graphfx.node import Library

SKY = {"sky": {"type": "emit"}}
HIGH = {"high": {"type": "above", "height": 2}}


def flat(nodes: dict[str, Any], library: Library, folder: Path | None = None, **top: Any) -> FlatGraph:
    return flatten(document_of({"graphfx": 1, **top, "nodes": nodes}, folder=folder), library)


def node(entry: dict[str, Any], library: Library, nodes: dict[str, Any] | None = None, **top: Any) -> FlatNode:
    """Return one flat node among an emitter, a selector and others."""
    return flat({**SKY, **HIGH, **(nodes or {}), "it": entry}, library, **top).nodes["it"]


def shown(tree: Any) -> str:
    """Return a condition as nested calls, a selector by its name and its seed."""
    if isinstance(tree, Expression):
        return shown(tree.tree)
    if isinstance(tree, Call):
        return f"{tree.function}({', '.join(map(shown, tree.arguments))})"
    if isinstance(tree, Node) and tree.node_type is not None:
        return f"{tree.node_type.name} by {tree.seed}"
    return tree.name if isinstance(tree, Name) else f"{tree:g}"


def parts(tree: Any) -> Iterator[Any]:
    yield tree
    for part in children(tree):
        yield from parts(part)


@pytest.mark.parametrize(("only", "means"), [
    ("high", "above by high"),
    ({"above": {"height": 1}}, "above by it/only"),
    ({"not": "high"}, "not(above by high)"),
    ({"all": ["high"]}, "above by high"),
    ({"all": ["high", {"expr": "age > 1"}]}, "and(above by high, greater(age, 1))"),
    ({"any": ["high", {"above": {}}, {"not": {"all": ["high", "high"]}}]},
     "or(above by high, or(above by it/only.any[1], not(and(above by high, above by high))))"),
    ({"expr": "tall or age > 1"}, "or(above by values.tall, greater(age, 1))"),
])
def test_only_becomes_one_condition(only: Any, means: str, library: Library) -> None:
    """Selector nodes, inline selectors, expressions and their combinations are all one condition of the flat node."""
    found = node({"type": "spiral", "from": "sky", "only": only}, library, values={"tall": {"above": {"height": 9}}}).only
    assert found is not None and (found.type, shown(found)) == ("bool", means)


def test_a_selector_is_one_test_wherever_it_is_used(library: Library) -> None:
    """Its draws are keyed by its own path, and inside a group by the instance's."""
    nodes = {**SKY, **HIGH, "a": {"type": "spiral", "from": "sky", "only": "high"},
             "b": {"type": "vortex", "from": "a", "only": {"not": "high"}}, "c": {"type": "spiral", "from": "some"},
             "some": {"type": "above", "from": "b", "seed_key": "old"}}
    found = flat(nodes, library).nodes
    seeds = [part.seed for path in ("a", "b", "some") for part in parts(found[path].only) if isinstance(part, Node)]
    assert seeds == ["high", "high", "old"]


def test_a_selector_of_a_group_is_the_instances_own(library: Library, tmp_path: Path) -> None:
    """Two instances of a group have two selectors."""
    group = {"graphfx": 1, "inputs": {"p": {}}, "outputs": {"p": "v"},
             "nodes": {"high": {"type": "above"}, "v": {"type": "spiral", "from": "p", "only": "high"}}}
    (tmp_path / "g.json").write_text(json.dumps(group))
    nodes = {**SKY, "one": {"type": "g", "from": "sky"}, "two": {"type": "g", "from": "one"}}
    found = flat(nodes, library, tmp_path, use={"g": "g.json"}).nodes
    assert [shown(found[f"{name}/v"].only) for name in ("one", "two")] == ["above by one/high", "above by two/high"]


def test_a_selector_in_a_stream_stays_a_node(library: Library) -> None:
    """It has sources and its own test; one that no stream flows through is only a condition."""
    nodes = {**SKY, **HIGH, "some": {"type": "above", "from": "sky", "height": 3, "per": "frame"},
             "turn": {"type": "spiral", "from": "some", "only": "high"}}
    found = flat(nodes, library).nodes
    some = found["some"].only
    assert list(found) == ["sky", "some", "turn"] and found["turn"].sources == ("some",)
    assert isinstance(some, Node) and (some.per, dict(some.arguments)["height"].value) == ("frame", 3.0)  # type: ignore[attr-defined]


@pytest.mark.parametrize(("when", "moment", "surfaces"), [
    ("frame", "", ()), ("birth", "birth", ()), ("hit", "hit", ()),
    ({"hit": ["fall/low"]}, "hit", ("fall/low",)), ({"hit": ["fall"]}, "hit", ("fall/low", "fall/bounce_plane")),
    ({"hit": ["floor", "fall/low"]}, "hit", ("fall/low", "floor/ground")),
])
def test_when_names_the_surfaces_themselves(when: Any, moment: str, surfaces: tuple[str, ...], library: Library,
                                            tmp_path: Path) -> None:
    """A stack or a group stands for the surfaces inside it; the default moment is no moment."""
    (tmp_path / "floor.json").write_text(json.dumps({
        "graphfx": 1, "inputs": {"p": {}}, "outputs": {"p": "ground"},
        "nodes": {"ground": {"type": "bounce_plane", "from": "p"}}}))
    nodes = {**SKY, "fall": {"type": "stack", "from": "sky", "ops": [{"type": "bounce_plane", "id": "low"}, {"type": "spiral"},
                                                                   {"type": "bounce_plane"}]},
             "floor": {"type": "floor", "from": "fall"},
             "falling": {"type": "stack", "from": "fall", "ops": [{"type": "bounce_plane"}]},
             "it": {"type": "set", "from": "floor", "when": when, "set": {"radius": 1}}}
    found = flat(nodes, library, tmp_path, use={"floor": "floor.json"}).nodes["it"]
    assert (found.when, found.surfaces) == (moment, surfaces)


def test_a_spawn_takes_from_parents_and_makes_a_stream(library: Library) -> None:
    """Its condition is on the parents; what follows takes from it."""
    entry = {"type": "spawn", "from": "sky", "when": "hit", "only": "high", "into": "sky", "inherit": ["color", "heat"],
             "count": {"expr": "1 + floor(parent.mass) + birth.mass + hit.speed"},
             "set": {"radius": {"expr": "radius * parent.radius + parent.age"}, "position": {"expr": "hit.point"}}}
    found = flat({**SKY, **HIGH, "it": entry, "turn": {"type": "spiral", "from": "it"}}, library,
                 attributes={"heat": {"type": "float"}}).nodes
    it = found["it"]
    assert (it.sources, it.when, it.references, shown(it.only)) == (("sky",), "hit", {"into": "sky"}, "above by high")
    assert it.arguments["inherit"].value == ("color", "heat") and found["turn"].sources == ("it",)  # type: ignore[attr-defined]
    own = node({"type": "spawn", "from": "sky", "when": "hit", "values": {"way": {"expr": "hit.normal * parent.mass"}},
                "set": {"velocity": {"expr": "way"}}}, library)
    assert [part.name for part in parts(own.sets["velocity"]) if isinstance(part, Name)] == ["hit.normal", "parent.mass"]
    assert [part.name for part in parts(it.sets["radius"]) if isinstance(part, Name)] == ["parent.radius", "parent.age"]


def test_a_spawn_into_its_own_emitter_is_no_circle(library: Library) -> None:
    """Joining is no stream: the emitter takes nothing from it."""
    nodes = {"sky": {"type": "emit"}, "turn": {"type": "spiral", "from": "sky"},
             "more": {"type": "spawn", "from": "turn", "when": "death", "into": "sky"}}
    assert check(document_of({"graphfx": 1, "nodes": nodes}), library) == []


def test_without_a_life_of_its_own_a_child_has_its_parents(library: Library) -> None:
    """The parent's life is what a spawn's life is where the document states none."""
    life = node({"type": "spawn", "from": "sky", "when": "birth"}, library).arguments["life"]
    assert isinstance(life, Expression) and life.tree == Name("parent.life")
    assert node({"type": "spawn", "from": "sky", "rate": 3, "life": 2}, library).arguments["life"].value == 2.0  # type: ignore[attr-defined]


@pytest.mark.parametrize(("given", "rate"), [({}, 100.0), ({"count": 5}, 0.0), ({"count": 5, "rate": 100}, 100.0),
                                             ({"count": 0}, 100.0)])
def test_a_burst_has_no_rate_unless_it_is_stated(given: dict[str, Any], rate: float, library: Library) -> None:
    """`count` without `rate` makes nothing besides."""
    assert node({"type": "emit", **given}, library).arguments["rate"].value == rate  # type: ignore[attr-defined]


def test_the_tail_is_set_after_what_it_reads(library: Library) -> None:
    """`tail.radius` has the type of the radius and may read the head's new one."""
    sets = {"tail.radius": {"expr": "radius / 2"}, "radius": 3, "tail.color": "#fff"}
    found = node({"type": "set", "from": "sky", "set": sets}, library)
    assert list(found.sets) == ["radius", "tail.radius", "tail.color"]
    tail: Value = found.sets["tail.color"]
    assert isinstance(tail, Literal) and (tail.type, tail.value) == ("color", (1.0, 1.0, 1.0))


def meshes(tree: Any) -> list[str]:
    """Return the meshes that a value names."""
    return [part.value for part in parts(tree) if isinstance(part, Literal) and part.type == "mesh"]


def test_meshes_are_paths_wherever_they_are_named(library: Library, tmp_path: Path) -> None:
    """In operators, values, selectors, and inside a group: its own geometry, or one that a parameter brings."""
    inner = {"v": {"type": "cling", "from": "p", "mesh": {"param": "shape"}, "only": "near"},
             "near": {"type": "within", "mesh": "own"}, "own": {"type": "ball"},
             "w": {"type": "push", "from": "v", "by": {"spot_on": {"mesh": {"param": "shape"}}},
                   "only": {"within": {"mesh": {"param": "shape"}}}},
             "x": {"type": "push", "from": "w", "by": {"spot_on": {"mesh": "own"}}}}
    group = {"graphfx": 1, "params": {"shape": {"type": "mesh"}}, "inputs": {"p": {}}, "outputs": {"p": "w"}, "nodes": inner}
    (tmp_path / "g.json").write_text(json.dumps(group))
    (tmp_path / "outer.json").write_text(json.dumps(group | {"use": {"g": "g.json"}, "nodes": {
        "w": {"type": "g", "from": "p", "shape": {"param": "shape"}, "seed_key": "other"}}}))
    nodes = {"sky": {"type": "emit", "set": {"position": {"spot_on": {"mesh": "round"}}}}, "round": {"type": "ball"},
             "one": {"type": "g", "from": "sky", "shape": "round"}, "two": {"type": "outer", "from": "one", "shape": "round"},
             "last": {"type": "cling", "from": "two", "mesh": "round"}}
    found = flat(nodes, library, tmp_path, use={"g": "g.json", "outer": "outer.json"}).nodes
    assert meshes(found["sky"].sets["position"]) == ["round"]
    assert [found[path].references["mesh"] for path in ("last", "one/v", "two/w/v")] == ["round"] * 3
    assert [meshes(found[path].only) for path in ("one/v", "two/w/v", "two/w/w")] == [["one/own"], ["two/w/own"], ["round"]]
    assert [meshes(found[path].arguments["by"]) for path in ("two/w/w", "two/w/x")] == [["round"], ["two/w/own"]]


def test_a_group_that_needs_a_mesh_says_so(library: Library, tmp_path: Path) -> None:
    """A parameter of type mesh has no default."""
    group = {"graphfx": 1, "params": {"shape": {"type": "mesh", "doc": "What it clings to."}}, "inputs": {"p": {}},
             "outputs": {"p": "v"}, "nodes": {"v": {"type": "cling", "from": "p", "mesh": {"param": "shape"}}}}
    (tmp_path / "g.json").write_text(json.dumps(group))
    for given, message in (({}, "g needs 'shape': What it clings to."), (
            {"shape": "sky"}, "shape should be the id of a geometry node; 'sky' is a node of type emit")):
        nodes = {**SKY, "v": {"type": "g", "from": "sky", **given}}
        told = check(document_of({"graphfx": 1, "use": {"g": "g.json"}, "nodes": nodes}, folder=tmp_path), library)
        assert [problem.message for problem in told] == [message]


@pytest.mark.parametrize(("inherit", "reads"), [
    (None, ["parent.mass", "parent.mass"]), (["mass"], ["parent.mass", "parent.mass"]), ([], ["parent.mass"])])
def test_a_spawn_that_reads_what_it_sets_reads_what_was_inherited(inherit: Any, reads: list[str], library: Library) -> None:
    """The name stands for the parent's, wherever it stands in the value, or for the default where it is not passed on."""
    sets = {"mass": {"rand": [{"expr": "mass + parent.mass"}, {"ramp": [[0, 1], [1, 2]], "over": "time"}]},
            "radius": {"expr": "mass"}}
    found = node({"type": "spawn", "from": "sky", "rate": 1, "set": sets, "life": {"expr": "life / 2"},
                  **({"inherit": inherit} if inherit is not None else {})}, library)
    assert [part.name for part in parts(found.sets["mass"]) if isinstance(part, Name) and part.name != "time"] == reads
    assert [part.name for part in parts(found.sets["radius"]) if isinstance(part, Name)] == ["mass"]
    assert [part.name for part in parts(found.arguments["life"]) if isinstance(part, Name)] == ["parent.life"]
    assert list(found.sets) == ["mass", "radius"]
