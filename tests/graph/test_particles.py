"""Flattening of what makes, tells apart and changes particles: selectors, moments, spawns, clusters, own attributes."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.graph.flat import Cluster, FlatGraph, FlatNode
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


def test_clusters_are_counted_when_the_graph_is_flat(library: Library) -> None:
    """Their number and their way may come from parameters."""
    clusters = {"flicker": {"count": {"param": "many"}, "by": {"param": "way"}}, "region": {"count": 3}}
    params = {"many": {"type": "int", "default": 60}, "way": {"type": "string", "default": "nearest"}}
    found = node({"type": "emit", "clusters": clusters, "life": {"rand": [1, 2], "per": "flicker"}}, library, params=params)
    assert found.clusters == {"flicker": Cluster("flicker", 60, "nearest"), "region": Cluster("region", 3, "turn")}
    assert found.arguments["life"].per == "flicker"  # type: ignore[attr-defined]


def test_all_particles_of_a_stream_must_be_in_the_cluster(library: Library) -> None:
    """A value that names a cluster is told of each emitter upstream that has none of that name, spawns between or not."""
    draw = {"rand": [1, 2], "per": "flicker"}
    nodes = {"fire": {"type": "emit", "clusters": {"flicker": {"count": 3}}, "set": {"mass": {"expr": "flicker"}}},
             "rain": {"type": "emit", "life": draw}, "trail": {"type": "spawn", "from": ["fire"], "rate": 1, "life": draw},
             "both": {"type": "spiral", "from": ["trail", "rain"]},
             "turn": {"type": "spiral", "from": "both", "speed": draw},
             "some": {"type": "spiral", "from": "fire", "only": {"expr": "flicker == 2"}}}
    told = check(document_of({"graphfx": 1, "nodes": nodes}), library)
    message = "the particles of 'rain' are in no cluster 'flicker'; write \"clusters\": {\"flicker\": {\"count\": ...}} there too"
    assert [(problem.path, problem.message) for problem in told] == [
        ("nodes.rain.life", message), ("nodes.turn.speed", message)]


def test_what_follows_the_nearest_seed_comes_after_the_position(library: Library) -> None:
    """A draw for each cluster of the nearest seed waits for the position; clusters in turn wait for nothing."""
    sets = {"radius": {"rand": [1, 2], "per": "a"}, "mass": {"expr": "a"}, "opacity": {"expr": "b"}, "position": [1, 2, 3]}
    clusters = {"a": {"count": 3, "by": "nearest"}, "b": {"count": 3}}
    found = node({"type": "emit", "clusters": clusters, "set": sets}, library)
    assert list(found.sets) == ["position", "radius", "mass", "opacity"]


def test_own_attributes_are_read_and_set_like_any(library: Library) -> None:
    """They have a type and a default, and stand in expressions, at birth, in a parent, in `set` and in `fade`."""
    declared = {"heat": {"type": "float", "default": 300, "unit": "K", "doc": "Temperature."}, "way": {"type": "direction"}}
    nodes = {"hot": {"type": "emit", "set": {"heat": 400, "radius": {"expr": "heat / 1e4"}, "way": [1, 0, 0]}},
             "cool": {"type": "fade", "from": "hot", "set": {"heat": {"expr": "birth.heat / 2"}}},
             "it": {"type": "spawn", "from": "cool", "when": "death", "set": {"heat": {"expr": "parent.heat + heat * way.x"}}}}
    found = flat(nodes, library, attributes=declared)
    heat = found.attributes["heat"]
    assert (heat.type, heat.default, heat.unit, heat.doc, found.attributes["way"].default) == (
        "float", 300.0, "K", "Temperature.", (0.0, 1.0, 0.0))
    assert list(found.nodes["hot"].sets) == ["heat", "radius", "way"]
    names = [part.name for part in parts(found.nodes["it"].sets["heat"]) if isinstance(part, Name)]
    assert names == ["parent.heat", "parent.heat", "way"]


GROUP = {"graphfx": 1, "inputs": {"p": {}}, "outputs": {"p": "v"}, "attributes": {"heat": {"type": "float", "default": 1}},
         "nodes": {"v": {"type": "spiral", "from": "p", "speed": {"expr": "heat"}}}}


def test_a_group_brings_its_attributes(library: Library, tmp_path: Path) -> None:
    """They are joined with the outer graph's, whose default holds where both declare one; reading one takes a declaration."""
    (tmp_path / "g.json").write_text(json.dumps(GROUP))
    nodes: dict[str, Any] = {**SKY, "v": {"type": "g", "from": "sky"}}
    use = {"g": "g.json"}
    assert flat(nodes, library, tmp_path, use=use).attributes["heat"].default == 1.0
    assert flat(nodes, library, tmp_path, use=use, attributes={"heat": {"type": "float"}}).attributes["heat"].default == 0.0
    nodes["sky"] = {"type": "emit", "set": {"heat": 2}}
    told = check(document_of({"graphfx": 1, "use": use, "nodes": nodes}, folder=tmp_path), library)
    assert [problem.message for problem in told] == [
        "'heat' is the attribute of a group; declare it here too: \"attributes\": {\"heat\": {\"type\": \"float\"}}"]


def test_an_attribute_of_two_types_is_told(library: Library, tmp_path: Path) -> None:
    """A name cannot be a number here and a vector, or a cluster, in a group."""
    (tmp_path / "g.json").write_text(json.dumps(GROUP))
    for top, nodes in (({"attributes": {"heat": {"type": "vec3"}}}, SKY),
                       ({}, {"sky": {"type": "emit", "clusters": {"heat": {"count": 3}}}})):
        kind = "vec3" if top else "cluster"
        told = check(document_of({"graphfx": 1, "use": {"g": "g.json"}, **top, "nodes": nodes}, folder=tmp_path), library)
        assert [problem.message for problem in told] == [
            f"'heat' is of type {kind} in graph.json and float in {tmp_path / 'g.json'}; it is one attribute, "
            "so declare it alike, or rename one"]


def test_a_group_may_use_a_cluster_that_it_declares(library: Library, tmp_path: Path) -> None:
    """An attribute of type cluster is a cluster of some emitter outside; it is no stored attribute of the graph's."""
    group = GROUP | {"attributes": {"flicker": {"type": "cluster"}},
                     "nodes": {"v": {"type": "spiral", "from": "p", "speed": {"rand": [1, 2], "per": "flicker", "vary": 0.1}}}}
    (tmp_path / "g.json").write_text(json.dumps(group))
    nodes = {"sky": {"type": "emit", "clusters": {"flicker": {"count": 3}}}, "v": {"type": "g", "from": "sky"}}
    found = flat(nodes, library, tmp_path, use={"g": "g.json"})
    assert found.nodes["v/v"].arguments["speed"].per == "flicker" and found.attributes == {}  # type: ignore[attr-defined]


def test_a_cluster_of_a_group_is_made_known_by_declaring_it(library: Library, tmp_path: Path) -> None:
    """Without that the graph is told how; with it, the cluster is one of those that the group's emitter numbers."""
    (tmp_path / "fire.json").write_text(json.dumps({
        "graphfx": 1, "outputs": {"f": "e"}, "nodes": {"e": {"type": "emit", "clusters": {"flicker": {"count": 3}}}}}))
    nodes = {"f": {"type": "fire"}, "v": {"type": "spiral", "from": "f", "speed": {"rand": [0, 1], "per": "flicker"},
                                          "only": {"expr": "flicker == 1"}}}
    top = {"use": {"fire": "fire.json"}, "nodes": nodes}
    told = check(document_of({"graphfx": 1, **top}, folder=tmp_path), library)
    assert [problem.message for problem in told] == [
        "'flicker' is the cluster of a group; declare it here too: \"attributes\": {\"flicker\": {\"type\": \"cluster\"}}"] * 2
    declared = {"flicker": {"type": "cluster"}}
    assert check(document_of({"graphfx": 1, "attributes": declared, **top}, folder=tmp_path), library) == []


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
