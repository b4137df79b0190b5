"""Splines of keys and ramps: what must be true of any cubic through points."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphfx.graph.values import Keys, Name, Ramp
from graphfx.node import Library, bundled_root
from graphfx.plan.splines import slopes

from .lowered import emitted, found, lowered

LIBRARY = Library([bundled_root()])
POINTS = [(0.0, 1.0), (1.0, 3.0), (4.0, 2.0), (4.5, -1.0)]


def at(x: float, points: list[tuple[float, Any]], precision: int = 64, kind: str = "float") -> Any:
    """Return a spline's value at x."""
    ramp = Ramp(kind, positions=tuple(x for x, _ in points), values=tuple(v for _, v in points),
                over=Name("age"), interpolation="spline")  # type: ignore[arg-type]
    return found(lowered({"v": ramp}), precision, age=x)["v"]


@pytest.mark.parametrize(("x", "value"), [*POINTS, (-3.0, 1.0), (9.0, -1.0)])
def test_it_passes_through_its_points_and_is_held_beyond(x: float, value: float) -> None:
    """At each point stands the point's value, exactly; before the first and after the last theirs."""
    assert at(x, POINTS) == value


def test_slopes_by_hand() -> None:
    """d = 2, -1/3, -6; at x = 1: (2 * 3 - 1/3 * 1) / 4, at x = 4: (-1/3 * 0.5 - 6 * 3) / 3.5; at the ends the interval's own."""
    assert slopes([x for x, _ in POINTS], [v for _, v in POINTS]) == pytest.approx([2, 17 / 12, -109 / 21, -6])


def test_a_value_by_hand() -> None:
    """Halfway between two points: (v0 + v1) / 2 + (m0 - m1) h / 8."""
    assert at(2.5, POINTS) == pytest.approx(2.5 + (17 / 12 + 109 / 21) * 3 / 8)


@pytest.mark.parametrize("x", [-1.0, 0.0, 0.3, 1.7, 4.2, 4.4999, 8.0])
def test_a_line_stays_a_line_and_a_constant_a_constant(x: float) -> None:
    """Points on a line give that line between them; equal points give the same bits everywhere."""
    line = [(x, 2.0 - 3.0 * x) for x, _ in POINTS]
    assert at(x, line) == pytest.approx(2.0 - 3.0 * min(max(x, 0.0), 4.5), abs=1e-12)
    assert at(x, [(x, 0.1) for x, _ in POINTS]) == 0.1


@pytest.mark.parametrize("joint", [1.0, 4.0])
def test_it_bends_without_a_corner(joint: float) -> None:
    """Slope before and after a point agree, where lines would have a corner."""
    step = 1e-6
    before, after = ((at(joint + s, POINTS) - at(joint + s - step, POINTS)) / step for s in (0.0, step))
    assert before == pytest.approx(after, abs=1e-4)


@settings(max_examples=60, deadline=None)
@given(values=st.lists(st.floats(-10, 10), min_size=1, max_size=6), x=st.floats(-1, 7))
def test_vectors_go_by_component(values: list[float], x: float) -> None:
    """A vector's spline is that of each of its components, in both precisions; of one point it is that point."""
    points = [(k * 1.25, v) for k, v in enumerate(values)]
    vectors = [(x, (v, 0.0, 1.0 - v)) for x, v in points]
    for precision in (32, 64):
        number, vector = at(x, points, precision), at(x, vectors, precision, "vec3")
        assert (vector[0], vector[1]) == (float(number), 0.0)


def test_keys_and_ramps_of_a_document_are_splines() -> None:
    """`"interpolation": "spline"` is known to both."""
    pairs = [[x, v] for x, v in POINTS]
    sets = {"mass": {"ramp": pairs, "over": "time", "interpolation": "spline"},
            "opacity": {"keys": pairs, "interpolation": "spline"}}
    values = emitted(LIBRARY, sets).sets
    assert isinstance(values["opacity"], Keys)
    results = found(lowered(values), time=2.5)
    assert results["mass"] == results["opacity"] == at(2.5, POINTS)
