"""The selectors of the library: what passes, at their very edges too."""

from __future__ import annotations

from typing import Any

import pytest

from graphfx.math import Vec3
from graphfx.node import Library, bundled_root

LIBRARY = Library([bundled_root()])


def passes(name: str, *state: Any, **given: Any) -> bool:
    """Return whether a particle of some state passes, the parameters that are not given at their defaults."""
    node_type = LIBRARY[name]
    defaults = {parameter.name: parameter.default for parameter in node_type.parameters.values()} | given
    arguments = {key: Vec3(*value) if isinstance(value, tuple) else value for key, value in defaults.items()}
    return bool(node_type.function(*state, **arguments))


@pytest.mark.parametrize(("position", "inside"), [
    ((0, 0, 0), True), ((1, 1, 1), True), ((-1, -1, -1), True), ((1.001, 0, 0), False),
    ((0, -1.001, 0), False), ((0, 0, 2), False)])
def test_inside_box(position: tuple[float, ...], inside: bool) -> None:
    """A box holds its corners and nothing beyond any of its six sides."""
    assert passes("inside_box", Vec3(*position)) is inside


@pytest.mark.parametrize(("position", "inside"), [
    ((1, 2, 3), True), ((3, 2, 3), True), ((1, 2, 5.001), False), ((2.5, 3.5, 3), False)])
def test_inside_sphere(position: tuple[float, ...], inside: bool) -> None:
    """A sphere holds what is at most its radius from its center."""
    assert passes("inside_sphere", Vec3(*position), center=(1, 2, 3), radius=2.0) is inside


@pytest.mark.parametrize(("position", "above"), [((0, 1.1, 5), True), ((9, 0.9, 0), False), ((4, 1, 4), False)])
def test_above_plane(position: tuple[float, ...], above: bool) -> None:
    """Above is the side of the normal; the plane itself is not above."""
    assert passes("above_plane", Vec3(*position), point=(7, 1, 7)) is above
    assert passes("above_plane", Vec3(*position), point=(7, 1, 7), normal=(0, -1, 0)) is (not above and position[1] != 1)


@pytest.mark.parametrize(("name", "state", "given", "result"), [
    ("of_type", 2.0, {"number": 2.0}, True), ("of_type", 2.0, {}, False),
    ("older_than", 1.0, {"seconds": 1.0}, False), ("older_than", 1.01, {"seconds": 1.0}, True),
    ("just_born", 0.0, {}, True), ("just_born", 0.05, {}, False), ("just_born", 0.05, {"seconds": 0.1}, True),
    ("was_hit", 0.0, {}, False), ("was_hit", 1.0, {}, True), ("was_hit", 1.0, {"times": 2.0}, False)])
def test_of_one_number(name: str, state: float, given: dict[str, Any], result: bool) -> None:
    """What compares one attribute with one parameter, at and beyond the edge."""
    assert passes(name, state, **given) is result


@pytest.mark.parametrize(("slowest", "fastest", "result"), [
    (5.0, 5.0, True), (0.0, 4.9, False), (5.1, 9.0, False), (1.0, 9.0, True)])
def test_speed_between(slowest: float, fastest: float, result: bool) -> None:
    """The speed is the length of the velocity, and both limits pass."""
    assert passes("speed_between", Vec3(3.0, 0.0, -4.0), slowest=slowest, fastest=fastest) is result


@pytest.mark.parametrize(("fraction", "draw", "result"), [
    (0.0, 0.0, False), (1.0, 1.0 - 2**-24, True), (0.3, 0.29, True), (0.3, 0.3, False)])
def test_share(fraction: float, draw: float, result: bool) -> None:
    """A share of 0 passes nobody, one of 1 everybody: numbers drawn are at least 0 and below 1."""
    assert passes("share", (draw, 0.0, 0.0, 0.0), fraction=fraction) is result


@pytest.mark.parametrize("name", [name for name in LIBRARY if LIBRARY.kind_of(name) == "selectors"])
def test_a_selector_gives_a_condition(name: str) -> None:
    """Each selector declares that it gives a condition, writes nothing, and does not read the clock."""
    node_type = LIBRARY[name]
    assert (node_type.result, node_type.writes, set(node_type.reserved) <= {"draw"}) == (("bool",), (), True)
