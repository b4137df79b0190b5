"""Flattening: paths, parameters, gates, seeds."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from graphfx.errors import GraphError
from graphfx.graph.document import document_of, load_document
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.graph.limits import Limits
from graphfx.graph.values import Expression, Keys, Literal, Node, Random, Value, children
from graphfx.node import Library

GOOD = Path(__file__).parent / "good"
VORTEX = {"type": "vortex", "magnitude": {"rand": [1, 2]}}


def graph(nodes: dict[str, Any], **top: Any) -> dict[str, Any]:
    return {"graphfx": 1, **top, "nodes": nodes}


def flat(data: dict[str, Any], library: Library, limits: Limits | None = None, **overrides: Any) -> FlatGraph:
    return flatten(document_of(data, folder=GOOD, limits=limits), library, overrides)


def stack(*ops: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"sky": {"type": "emit"}, "fall": {"type": "stack", "from": "sky", "ops": list(ops), **more}}


def seeds(tree: Any) -> Iterator[str]:
    """Yield the seeds of all draws in a value."""
    if isinstance(tree, Random | Node):
        yield tree.seed
    for part in children(tree):
        yield from seeds(part)


def all_seeds(found: FlatGraph) -> dict[str, list[str]]:
    """Return the seeds of each node that draws."""
    lists = {node.path: [seed for value in (*node.arguments.values(), *node.sets.values()) for seed in seeds(value)]
             for node in found.nodes.values()}
    return {path: list_ for path, list_ in lists.items() if list_}


def test_an_empty_stack_passes_its_streams_on(library: Library) -> None:
    """What takes from a stack without operators takes from the stack's own sources, all of them."""
    nodes = {"a": {"type": "emit"}, "b": {"type": "emit"}, "both": {"type": "stack", "from": ["a", "b"], "ops": []},
             "turn": {"type": "vortex", "from": "both"}}
    assert flat(graph(nodes), library).nodes["turn"].sources == ("a", "b")


def test_operators_of_a_type_are_numbered(library: Library) -> None:
    """A second operator of a type that draws nothing needs no id of its own."""
    found = flat(graph(stack({"type": "vortex"}, {"type": "vortex"}, {"type": "vortex"})), library)
    assert [path for path in found.nodes if path != "sky"] == ["fall/vortex", "fall/vortex_2", "fall/vortex_3"]


def test_nodes_may_stand_in_any_order(library: Library) -> None:
    """A stream may be taken from a node, or a group, that the document names later."""
    nodes = {"last": {"type": "spiral", "from": "split.right"}, "split": {"type": "halves", "from": "turn"},
             "turn": {"type": "vortex", "from": "sky"}, "sky": {"type": "emit"}}
    found = flat(graph(nodes, use={"halves": "groups/halves.json"}), library)
    assert [(path, node.sources) for path, node in found.nodes.items() if node.sources] == [
        ("last", ("split/b",)), ("split/a", ("turn",)), ("split/b", ("turn",)), ("turn", ("sky",))]


def test_inserting_a_node_changes_no_seed(library: Library) -> None:
    """A new emitter, a new operator before others and a new parameter leave the seeds of the rest alone."""
    before = all_seeds(flat(graph(stack(VORTEX, {"type": "spiral", "speed": {"rand": [0, 1]}})), library))
    nodes = {"other": {"type": "emit", "life": {"rand": [1, 2]}}} | stack(
        {"type": "push", "by": [{"rand": [0, 1]}, 0, 0]}, VORTEX | {"lift": {"rand": [0, 1]}}, {"type": "spiral",
        "speed": {"rand": [0, 1]}})
    after = all_seeds(flat(graph(nodes), library))
    assert before == {"fall/vortex": ["fall/vortex/magnitude"], "fall/spiral": ["fall/spiral/speed"]}
    assert all(set(found) <= set(after[path]) for path, found in before.items())


def test_two_instances_of_a_group_draw_differently(library: Library) -> None:
    """Each instance has its own path, and so each draw inside it its own seed."""
    group = {"type": "push_twice", "way": {"rand": [[0, 1, 0], [1, 0, 0]]}}
    found = all_seeds(flat(graph(stack(group, group | {"id": "again"}), use={"push_twice": "groups/push_twice.json"}), library))
    assert found == {"fall/push_twice/both/push": ["fall/push_twice/way"],
        "fall/push_twice/both/push_once/once": ["fall/push_twice/way"],
                     "fall/again/both/push": ["fall/again/way"], "fall/again/both/push_once/once": ["fall/again/way"]}


def test_what_a_group_draws_itself_differs_by_instance(library: Library, tmp_path: Path) -> None:
    """A draw, and a named value, inside a group is keyed by the instance, or by the seed_key of the instance."""
    (tmp_path / "g.json").write_text(json.dumps(graph(
        {"v": VORTEX | {"from": "p", "lift": {"expr": "share"}}}, values={"share": {"rand": [0, 1]}}, inputs={"p": {}},
        outputs={"p": "v"})))
    data = graph(stack({"type": "g"}, {"type": "g", "id": "b"}, {"type": "g", "id": "c", "seed_key": "old"}), use={"g": "g.json"})
    assert all_seeds(flatten(document_of(data, folder=tmp_path), library)) == {
        f"fall/{name}/v": [f"{key}/v/magnitude", f"{key}/values.share"]
        for name, key in (("g", "fall/g"), ("b", "fall/b"), ("c", "old"))}


@pytest.mark.parametrize("where", ["op", "stack", "group", "inner"])
def test_one_disabled_place_disables_all_inside(where: str, library: Library, tmp_path: Path) -> None:
    """An operator acts only if it, its stack, its group and that group's own stack are all enabled."""
    off = {"enabled": False}
    inner = {"s": {"type": "stack", "from": "p", "ops": [VORTEX | (off if where == "op" else {})],
        **(off if where == "inner" else {})}}
    (tmp_path / "g.json").write_text(json.dumps(graph(inner, inputs={"p": {}}, outputs={"p": "s"})))
    nodes = stack({"type": "g"} | (off if where == "group" else {}), **(off if where == "stack" else {}))
    found = flatten(document_of(graph(nodes, use={"g": "g.json"}), folder=tmp_path), library).nodes
    assert (found["fall/g/s/vortex"].enabled, found["sky"].enabled) == (False, True)


def test_a_named_value_is_one_draw_wherever_it_is_used(library: Library) -> None:
    """Its seed is that of its name, not of the places that refer to it."""
    nodes = stack(VORTEX | {"magnitude": {"expr": "share"}, "lift": {"expr": "share * 2"}})
    found = flat(graph(nodes, values={"share": {"rand": [0, 1]}}), library)
    assert all_seeds(found) == {"fall/vortex": ["values.share", "values.share"]}


@pytest.mark.parametrize(("keys", "seed"), [({}, "fall/vortex/magnitude"), ({"id": "v"}, "fall/v/magnitude"),
                                            ({"id": "v", "seed_key": "old"}, "old/magnitude")])
def test_a_seed_key_stands_for_the_path(keys: dict[str, str], seed: str, library: Library) -> None:
    """A node that moved or was renamed keeps its numbers by stating its old path."""
    path = f"fall/{keys.get('id', 'vortex')}"
    assert all_seeds(flat(graph(stack(VORTEX | keys)), library)) == {path: [seed]}


def test_gates_of_stacks_and_groups_hold_for_what_they_contain(library: Library) -> None:
    """Intervals intersect, conditions are joined by `and`, and one `enabled: false` is enough."""
    inner = {"type": "push_twice", "during": [1, 5], "only": {"expr": "age > 1"}}
    nodes = stack(inner, VORTEX | {"enabled": False}, during=[2, 9], only={"expr": "age < 3"})
    found = flat(graph(nodes, use={"push_twice": "groups/push_twice.json"}), library).nodes
    push = found["fall/push_twice/both/push_once/once"]
    assert (push.during, push.enabled, found["fall/vortex"].enabled, found["fall/vortex"].during) == ((2.0, 5.0), True,
        False, (2.0, 9.0))
    assert isinstance(push.only, Expression) and push.only.tree.function == "and"


def test_intervals_that_do_not_meet_are_empty(library: Library) -> None:
    """An empty interval ends where it starts, and never before."""
    assert flat(graph(stack(VORTEX | {"during": [0, 1]}, during=[5, 6])), library).nodes["fall/vortex"].during == (5.0, 5.0)


@pytest.mark.parametrize(("only", "enabled"), [(True, True), (False, False), ({"expr": "1 > 2"}, False), ({"param": "on"}, True)])
def test_a_condition_known_before_the_cook_becomes_enabled(only: Any, enabled: bool, library: Library) -> None:
    """An operator whose condition is constant is left with no condition."""
    data = graph(stack(VORTEX | {"only": only}), params={"on": {"type": "bool", "default": True}})
    node = flat(data, library).nodes["fall/vortex"]
    assert (node.only, node.enabled) == (None, enabled)


def test_renders_of_a_group_stay_out(library: Library) -> None:
    """A group may carry its own preview; where it is used, only its outputs count."""
    nodes = {"sky": {"type": "emit"}, "split": {"type": "halves", "from": "sky"}}
    found = flat(graph(nodes, use={"halves": "groups/halves.json"}), library)
    assert "split/look" not in found.nodes and "split/a" in found.nodes


def test_exposed_parameters_stand_at_their_inner_default(library: Library) -> None:
    """`expose` gives the group a parameter with the inner one's type, and the value stated inside as its default."""
    use = {"push_once": "groups/push_once.json"}
    found = flat(graph(stack({"type": "push_once"}, {"type": "push_once", "id": "b", "by": [0, 0, 1]}), use=use), library).nodes
    values = [found[f"fall/{name}/once"].arguments["by"].value for name in ("push_once", "b")]  # type: ignore[attr-defined]
    assert values == [(1.0, 2.0, 3.0), (0.0, 0.0, 1.0)]


PARAMS = {"wind": {"type": "float", "default": 1, "min": 0}, "tint": {"type": "color", "default": "#000000"},
          "way": {"type": "vec3", "default": [0, 0, 0]}, "spell": {"type": "interval", "default": [0, 1]},
          "on": {"type": "bool", "default": True}, "often": {"type": "int", "default": 1}, "mode": {"type": "string",
          "default": "add"}}
PUSH = {"type": "push", "by": {"param": "way"}, "tint": {"param": "tint"}, "back": {"param": "on"}, "times": {"param": "often"},
        "mode": {"param": "mode"}, "span": {"param": "spell"}}


@pytest.mark.parametrize(("name", "text", "argument", "value"), [
    ("way", "1,2,3", "by", (1.0, 2.0, 3.0)), ("way", "[1, 2, 3]", "by", (1.0, 2.0, 3.0)), ("way", [1, 2, 3], "by", (1.0,
    2.0, 3.0)),
    ("tint", "#ffffff", "tint", (1.0, 1.0, 1.0)), ("tint", "1, 0.5, 0", "tint", (1.0, 0.5, 0.0)), ("on", "false", "back", False),
    ("often", "7", "times", 7), ("mode", "replace", "mode", "replace"), ("spell", "2,3", "span", (2.0, 3.0)),
    ("spell", "2, infinity", "span", (2.0, float("inf"))), ("spell", "-infinity,3", "span", (float("-inf"), 3.0))])
def test_a_parameter_can_be_set_for_one_cook(name: str, text: Any, argument: str, value: Any, library: Library) -> None:
    """`--set name=value` reads a value as its parameter's type says."""
    found = flat(graph(stack(PUSH), params=PARAMS), library, **{name: text}).nodes["fall/push"].arguments[argument]
    assert isinstance(found, Literal) and found.value == value and type(found.value) is type(value)


@pytest.mark.parametrize(("name", "text", "message"), [
    ("wind", "-1", "--set wind=-1: params.wind: -1 is out of range; wind must be at least 0"),
    ("wind", "fast",
    "--set wind=fast: params.wind: wind should be a number; here stands the text 'fast'; an expression is {\"expr\": \"fast\"}"),
    ("wnd", "1", "--set wnd=1: the graph has no parameter 'wnd'. Did you mean 'wind'?\n"
                 "  its parameters: wind, tint, way, spell, on, often, mode"),
    ("way", "1,2", "--set way=1,2: params.way: way should be a vector [x, y, z]; here stands a list of 2; "
                   'a value drawn between two is {"rand": [a, b]}'),
    ("on", "maybe", "--set on=maybe: params.on: on should be true or false; here stands the text 'maybe'"),
    ("often", "101", "g.json:1:1: x")])
def test_a_wrong_setting_is_told_at_the_option(name: str, text: str, message: str, library: Library) -> None:
    """The option is named with its value, what was wanted, and a suggestion."""
    with pytest.raises(GraphError) as caught:
        flat(graph(stack(PUSH), params=PARAMS), library, **{name: text})
    if name != "often":
        assert str(caught.value) == message
    else:
        assert "101 is out of range; times must lie between 1 and 100 (from the parameter 'often')" in str(caught.value)


@pytest.mark.parametrize("during", [[1, "infinity"], [{"expr": "1"}, "infinity"], {"param": "spell"}])
def test_an_interval_may_have_no_end(during: Any, library: Library) -> None:
    """From a second on for ever, written out or by a parameter."""
    nodes = stack(VORTEX | {"during": during})
    found = flat(graph(nodes, params={"spell": {"type": "interval", "default": [1, "infinity"]}}), library).nodes["fall/vortex"]
    assert found.during == (1.0, float("inf"))


def test_a_group_does_not_cook_alone(library: Library) -> None:
    """A graph that takes streams says that it must be used by another."""
    with pytest.raises(GraphError, match="this graph is a group, and its input 'particles' has no particles here"):
        flatten(GOOD / "groups/halves.json", library)


def test_a_parameter_without_default_must_be_set(library: Library) -> None:
    """What has no default is asked for by the option that gives it."""
    data = graph(stack(VORTEX | {"lift": {"param": "up"}}), params={"up": {"type": "float"}})
    with pytest.raises(GraphError, match=r"--set up=\.\.\."):
        flat(data, library)
    assert flat(data, library, up="2").nodes["fall/vortex"].arguments["lift"].value == 2.0  # type: ignore[attr-defined]


def test_everything_flattens(library: Library) -> None:
    """The graph with every part of the language gives these nodes, in the order of the document."""
    found = flatten(load_document(GOOD / "everything.json"), library)
    assert list(found.nodes) == [
        "sky", "fall/vortex", "fall/second", "fall/push_twice/both/push", "fall/push_twice/both/push_once/once", "fall/set",
        "fall/floor", "fall/comet", "fall/fade", "fall/kill", "fall/recycle", "fall/cling", "fall/push", "halves_of_sky/a",
        "halves_of_sky/b", "halves_of_sky/preview", "burst", "sparks", "trail", "low", "ball", "alone", "view", "frames"]
    assert isinstance(found.nodes["fall/second"].arguments["center"], Keys)
    assert list(found.nodes["sky"].sets) == [
        "velocity", "position", "color", "radius", "opacity", "mass", "heat", "normal"]


def test_what_is_the_same_for_all_is_computed_at_once(library: Library) -> None:
    """Arithmetic of parameters and constants becomes a literal; what reads time or a particle does not."""
    values = {"half": {"expr": "param.wind / 2"}}
    nodes = stack(VORTEX | {"magnitude": {"expr": "-half * 3 + max(1, 2)"},
        "center": {"expr": "vec(1, 0, 0) * half + vec(0, 1, 0)"},
                            "lift": {"expr": "half * time"},
                            "range": {"expr": "3 if half > 1 else time"}})
    found = flat(graph(nodes, values=values, params={"wind": {"type": "float", "default": 4}}),
        library).nodes["fall/vortex"].arguments
    literals: list[Value] = [found["magnitude"], found["center"]]
    assert found["range"].value == 3.0  # type: ignore[attr-defined]
    assert [value.value for value in literals] == [-4.0, (2.0, 1.0, 0.0)]  # type: ignore[attr-defined]
    assert isinstance(found["lift"], Expression)


def test_division_by_zero_is_left_to_the_program(library: Library) -> None:
    """What is not finite is computed as IEEE arithmetic says, not by Python, which would raise."""
    found = flat(graph(stack(VORTEX | {"lift": {"expr": "1 / 0"}})), library).nodes["fall/vortex"].arguments["lift"]
    assert isinstance(found, Expression)


def test_the_hash_follows_what_is_said_not_its_layout(library: Library, tmp_path: Path) -> None:
    """Spaces change no hash; a value in the graph or in a group that it uses does."""
    def digest(space: str, rate: int, lift: int) -> str:
        node = '"nodes": {"a": {"type": "emit", "rate": %d}}'
        (tmp_path / "g.json").write_text(f'{{"graphfx": 1, {space}{node % lift}}}')
        (tmp_path / "t.json").write_text(f'{{"graphfx": 1, {space}"use": {{"g": "g.json"}}, {node % rate}}}')
        return flatten(tmp_path / "t.json", library).document_hash

    assert digest("", 1, 1) == digest("\n  ", 1, 1)
    assert len({digest("", 1, 1), digest("", 2, 1), digest("", 1, 2)}) == 3
