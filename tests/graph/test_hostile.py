"""Whatever a document says, the language answers with a graph or with problems, never with a traceback."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from graphfx.errors import GraphfxError
from graphfx.graph.check import check
from graphfx.graph.document import document_of, read_document
from graphfx.graph.flatten import flatten
from graphfx.graph.format import canonical
from graphfx.graph.names import TOP_KEYS
from graphfx.node import ATTRIBUTES, Library

GOOD = Path(__file__).parent / "good"
TEXT = (GOOD / "everything.json").read_text()
WORDS = st.sampled_from([
    *TOP_KEYS, *ATTRIBUTES, "type", "id", "from", "ops", "set", "when", "only", "during", "enabled", "seed_key", "emit",
    "stack", "vortex", "image",
    "camera", "push", "above", "param", "expr", "keys", "ramp", "rand", "per", "over", "gauss", "in_box", "min", "max",
    "default", "float", "vec3",
    "sky", "fall", "fall.a", "infinity", "#ff0000", "age + 1", "position", "param.wind", "groups/halves.json", "halves",
    "x-note", "hit", "", "clusters", "flicker", "count", "by", "nearest", "cluster", "all", "any", "not", "into", "inherit",
    "birth", "tail.radius", "heat", "mesh", "ball", "within", "on_ring", "spline", "interpolation", "spot.normal", "parent.heat"])
LEAVES = WORDS | st.none() | st.booleans() | st.integers(-3, 3) | st.floats() | st.text(max_size=6)
PARTS = st.recursive(LEAVES, lambda part: st.lists(part, max_size=4) | st.dictionaries(WORDS, part, max_size=4), max_leaves=12)
GENEROUS = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    max_examples=80,
                    phases=(Phase.explicit, Phase.reuse, Phase.generate, Phase.shrink))


def answer(text: str, library: Library) -> None:
    """Check, flatten and format; each problem must have a place."""
    try:
        document = read_document(text, "g.json", GOOD)
    except GraphfxError as error:
        assert error.problems
        return
    problems = check(document, library)
    assert all(problem.location.line and problem.message for problem in problems), problems
    try:
        flatten(document, library)
        assert not problems
    except GraphfxError as error:
        assert error.problems
    try:
        formatted = canonical(document, library)
    except GraphfxError:
        return
    assert canonical(read_document(formatted), library) == formatted


@GENEROUS
@given(data=st.dictionaries(WORDS, PARTS, max_size=6))
def test_random_documents(data: dict[str, Any], library: Library) -> None:
    """Random data under the language's own words."""
    answer(json.dumps({"graphfx": 1} | data), library)


@GENEROUS
@given(nodes=st.dictionaries(st.sampled_from(["sky", "fall", "a", "b"]), st.dictionaries(WORDS, PARTS, max_size=5).map(
    lambda node: {"type": "stack"} | node)), kind=st.sampled_from(["emit", "stack", "vortex", "push", "image", "camera",
    "set", "halves", "above", "spawn", "fade", "kill", "recycle", "within", "cling", "ball"]))
def test_random_nodes(nodes: dict[str, Any], kind: str, library: Library) -> None:
    """Random keys on nodes of every type."""
    nodes = {name: node | {"type": kind} for name, node in nodes.items()}
    answer(json.dumps({"graphfx": 1, "use": {"halves": "groups/halves.json"}, "nodes": nodes}), library)


@GENEROUS
@given(seed=st.integers(0, 2**32), part=PARTS)
def test_one_part_replaced(seed: int, part: Any, library: Library) -> None:
    """A right graph in which any one part is replaced by anything."""
    data = json.loads(TEXT)
    pick, place = random.Random(seed), data
    while True:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        key = pick.choice(keys)
        if not isinstance(place[key], dict | list) or not place[key] or pick.random() < 0.2:
            place[key] = part
            break
        place = place[key]
    answer(json.dumps(data), library)


@GENEROUS
@given(at=st.integers(0, len(TEXT) - 1), cut=st.integers(0, 30), put=st.text('{}[]",:0123456789.eE-\\/#N xyz', max_size=4))
def test_text_damaged(at: int, cut: int, put: str, library: Library) -> None:
    """A right graph with a piece of its text cut out and something else put in."""
    answer(TEXT[:at] + put + TEXT[at + cut:], library)


def test_long_chains(library: Library) -> None:
    """Thousands of nodes, stacks, groups and values, each after the last, in either order, exhaust no stack."""
    for step in (1, -1):
        count = 3000
        nodes: dict[str, Any] = {"n0": {"type": "emit"}}
        for index in range(1, count):
            kind: dict[str, Any] = [{"type": "stack", "ops": []}, {"type": "spiral"}, {"type": "twice"}][index % 3]
            nodes[f"n{index}"] = kind | {"from": f"n{index - 1}"}
        data = {"graphfx": 1, "use": {"twice": "groups/push_twice.json"}, "nodes": dict(list(nodes.items())[::step])}
        flat = flatten(document_of(data, folder=GOOD), library)
        assert len(flat.nodes) == 1 + 1000 + 2 * 1000  # an emitter, spirals, and two operators of each group
        values = {f"v{index}": {"expr": f"v{index - 1} + 1"} for index in range(1, 3000)} | {"v0": {"expr": "time"}}
        problems = check(document_of({"graphfx": 1, "values": dict(list(values.items())[::step]), "nodes": {}}), library)
        assert problems and "the limits are" in problems[0].message


def test_a_circle_of_thousands(library: Library) -> None:
    """A circle through very many nodes, and through very many values, is told once each."""
    nodes = {f"n{index}": {"type": "spiral", "from": f"n{(index + 1) % 2000}"} for index in range(2000)}
    values = {f"v{index}": {"expr": f"v{(index + 1) % 2000}"} for index in range(2000)}
    problems = check(document_of({"graphfx": 1, "values": values, "nodes": nodes}), library)
    assert ["in a circle" in problem.message for problem in problems] == [True, True]


def test_streams_that_merge_and_merge(library: Library) -> None:
    """Merging a stream with itself again and again makes it no longer."""
    nodes: dict[str, Any] = {"n0": {"type": "emit"}, "m": {"type": "emit"}}
    nodes |= {f"n{index}": {"type": "stack", "from": [f"n{index - 1}", f"n{index - 1}", "m"],
        "ops": []} for index in range(1, 60)}
    nodes["last"] = {"type": "spiral", "from": "n59"}
    assert flatten(document_of({"graphfx": 1, "nodes": nodes}), library).nodes["last"].sources == ("n0", "m")


def messages(data: dict[str, Any], library: Library) -> list[str]:
    return [problem.message for problem in check(document_of({"graphfx": 1, **data}), library)]


def test_thousands_of_conditions(library: Library) -> None:
    """A list of many conditions is one balanced tree; far too many, or a nest too deep, are refused."""
    sky = {"sky": {"type": "emit"}, "high": {"type": "above"}}
    for only, told in (({"any": ["high"] * 2500}, ""), ({"any": ["high"] * 6000}, "the limits are"),
                       (json.loads('{"not": ' * 50 + '"high"' + "}" * 50), "")):
        found = messages({"nodes": {**sky, "v": {"type": "spiral", "from": "sky", "only": only}}}, library)
        assert (told in found[0]) if told else found == []


def test_thousands_of_attributes(library: Library) -> None:
    """Each read by the next, in either order of the document; a circle of them is told once."""
    for step, last in ((1, {"expr": "1"}), (-1, {"expr": "1"}), (1, {"expr": "a1999"})):
        sets = {"a0": last} | {f"a{k}": {"expr": f"a{k - 1}"} for k in range(1, 2000)}
        data = {"attributes": {name: {"type": "float"} for name in sets}, "nodes": {"sky": {
            "type": "emit", "set": dict(list(sets.items())[::step])}}}
        found = messages(data, library)
        assert found == [] if last["expr"] == "1" else len(found) == 1 and "in a circle" in found[0]


def test_thousands_of_selectors_clusters_and_spawns(library: Library) -> None:
    """Long chains of each are read; a circle through selectors and spawns is told, one through `into` is none."""
    count = 2000
    nodes: dict[str, Any] = {"n0": {"type": "emit", "clusters": {f"c{k}": {"count": 2} for k in range(count)}}}
    for index in range(1, count):
        kinds: list[dict[str, Any]] = [{"type": "above"}, {"type": "spawn", "when": "death", "into": "n0"},
                                       {"type": "spiral", "speed": {"rand": [0, 1], "per": f"c{index}"}}]
        nodes[f"n{index}"] = kinds[index % 3] | {"from": f"n{index - 1}"}
    assert messages({"nodes": nodes}, library) == []
    ring = {f"n{index}": [{"type": "above"}, {"type": "spawn", "rate": 1}][index % 2] | {"from": f"n{(index + 1) % 1000}"}
            for index in range(1000)}
    found = messages({"nodes": ring}, library)
    assert len(found) == 1 and "in a circle" in found[0]


def test_many_surfaces_of_many_hits(library: Library) -> None:
    """A stack of very many surfaces, named by very many operators, is refused or flattened soon."""
    floors = [{"type": "bounce_plane", "id": f"f{k}"} for k in range(1000)]
    nodes: dict[str, Any] = {"sky": {"type": "emit"}, "s": {"type": "stack", "from": "sky", "ops": floors}}
    nodes |= {f"k{k}": {"type": "kill", "from": "s", "when": {"hit": ["s", "s/f3"]}} for k in range(300)}
    assert messages({"nodes": nodes}, library) == []
