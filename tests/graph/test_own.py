"""Flattening of what a graph declares of its particles: clusters and attributes of its own."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.graph.flat import Cluster, FlatGraph, FlatNode
from graphfx.graph.flatten import flatten
from graphfx.graph.values import Name, children
from graphfx.node import Library

SKY = {"sky": {"type": "emit"}}


def flat(nodes: dict[str, Any], library: Library, folder: Path | None = None, **top: Any) -> FlatGraph:
    return flatten(document_of({"graphfx": 1, **top, "nodes": nodes}, folder=folder), library)


def node(entry: dict[str, Any], library: Library, **top: Any) -> FlatNode:
    """Return one flat node."""
    return flat({"it": entry}, library, **top).nodes["it"]


def parts(tree: Any) -> Iterator[Any]:
    yield tree
    for part in children(tree):
        yield from parts(part)


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
