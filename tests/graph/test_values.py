"""Values: colours, limits, what may vary where, what reads what."""

from __future__ import annotations

from typing import Any

import pytest

from graphfx.errors import GraphError
from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.graph.limits import Limits
from graphfx.graph.literals import color
from graphfx.graph.values import Literal
from graphfx.node import Library


def told(nodes: dict[str, Any], library: Library, limits: Limits | None = None, **top: Any) -> list[str]:
    """Return the messages about a graph of these nodes."""
    return [problem.message for problem in check(document_of({"graphfx": 1, **top, "nodes": nodes}, limits=limits), library)]


@pytest.mark.parametrize(("text", "linear"), [
    ("#000000", (0.0, 0.0, 0.0)), ("#ffffff", (1.0, 1.0, 1.0)), ("#f00", (1.0, 0.0, 0.0)), ("#808080", (0.21586050,) * 3),
    ("#0a0A0a", (0.00303527,) * 3), ("#0b0b0b", (0.00334654,) * 3), ("ff0000", None), ("#ff00", None), ("#gg0000", None)])
def test_colours_are_made_linear(text: str, linear: tuple[float, ...] | None) -> None:
    """sRGB channels become linear light [IEC 61966-2-1], below and above the joint at 10.3 / 255."""
    found = color(text)
    assert found == linear if linear is None or found is None else found == pytest.approx(linear, abs=1e-8)


@pytest.mark.parametrize("value", [
    {"rand": [1, 2]}, {"rand": [1, 2], "per": "particle"}, {"gauss": {}}, {"height": {"scale": 2}}, {"expr": "mine"},
    {"ramp": [[0, 1], [1, 2]], "over": {"rand": [0, 1]}}])
def test_what_varies_by_particle_fits_no_camera(value: Any, library: Library) -> None:
    """Draws per particle, attributes and named values that read them are refused where there is no particle."""
    messages = told({"v": {"type": "camera", "lens": value}}, library, values={"mine": {"expr": "age * 2"}})
    assert len(messages) == 1 and "camera has no particle to read" in messages[0]


@pytest.mark.parametrize("value", [
    {"rand": [1, 2], "per": "graph"}, {"rand": [1, 2], "per": "frame"}, {"gauss": {"mean": 30}, "per": "frame"},
    {"expr": "30 + time"},
    {"keys": [[0, 20], [1, 50]]}, {"ramp": [[0, 20], [1, 50]], "over": "time"}])
def test_what_is_the_same_for_all_fits_a_camera(value: Any, library: Library) -> None:
    """Draws per frame or graph, time and keys may stand where there is no particle."""
    assert told({"v": {"type": "camera", "lens": value}}, library) == []


def test_life_varies_by_particle_and_rate_does_not(library: Library) -> None:
    """An emitter's parameters that are attributes belong to each particle, the others to the emitter."""
    assert told({"a": {"type": "emit", "life": {"rand": [1, 2]}}}, library) == []
    assert "rate is one for the whole emitter" in told({"a": {"type": "emit", "rate": {"rand": [1, 2]}}}, library)[0]


def test_attributes_come_after_those_that_they_read(library: Library) -> None:
    """Inside `set` the order of the document does not matter; dependence does, through value nodes too."""
    sets = {"opacity": {"expr": "radius + mass"}, "mass": {"height": {"scale": 1}}, "radius": {"expr": "mass"},
        "position": [0, 1, 0]}
    flat = flatten(document_of({"graphfx": 1, "nodes": {"a": {"type": "emit", "set": sets}}}), library)
    assert list(flat.nodes["a"].sets) == ["position", "mass", "radius", "opacity"]


def test_the_operator_set_may_read_what_it_sets(library: Library) -> None:
    """`radius * 0.9` is the radius before; at birth there is none before."""
    sets = {"set": {"radius": {"expr": "radius * 0.9"}}}
    assert told({"a": {"type": "emit"}, "b": {"type": "set", "from": "a", **sets}}, library) == []
    assert told({"a": {"type": "emit", **sets}}, library) == [
        "'radius' reads itself, and at birth it has no value yet; let it read others"]


def test_values_of_an_emitter_are_its_own(library: Library) -> None:
    """A named value of an emitter is known to that emitter and to no other node; it hides the graph's of that name."""
    nodes = {"a": {"type": "emit", "values": {"mine": 2}, "life": {"expr": "mine"}}, "b": {"type": "emit",
        "life": {"expr": "mine"}}}
    assert told(nodes, library) == ["there is no name 'mine'."]
    flat = flatten(document_of({"graphfx": 1, "values": {"mine": 3}, "nodes": nodes}), library)
    lives = [flat.nodes[name].arguments["life"] for name in "ab"]
    assert [life.value for life in lives if isinstance(life, Literal)] == [2.0, 3.0]


@pytest.mark.parametrize(("limit", "text"), [("expression", "1 + 2"), ("expression_depth", "1 + (2 + time)"),
    ("value_size", "time + 2")])
def test_expressions_have_limits(limit: str, text: str, library: Library) -> None:
    """An expression may be exactly as long, as deep and as large as the limits say."""
    exact = {"expression": 5, "expression_depth": 3, "value_size": 4}[limit]
    nodes = {"a": {"type": "emit", "rate": {"expr": text}}}
    assert told(nodes, library, Limits(**{limit: exact})) == []
    assert len(told(nodes, library, Limits(**{limit: exact - 1}))) == 1


@pytest.mark.parametrize("text", ["'; import os", "__class__", "().__class__", "time.real", "eval('1')", "time if",
    "0x10", "1_000", "a:=1", "\\u0061"])
def test_expressions_are_not_python(text: str, library: Library) -> None:
    """What only Python would take is refused."""
    with pytest.raises(GraphError):
        flatten(document_of({"graphfx": 1, "nodes": {"a": {"type": "emit", "rate": {"expr": text}}}}), library)
