"""Value nodes of several results: one call and one draw, however many of them are used."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphfx.node import Library, bundled_root

from .lowered import calls, emitted, found, lowered

LIBRARY = Library([Path(__file__).parent.parent / "graph/library", bundled_root()])
SPOT = {"spot": {"on_ring": {"radius": 3}}}


def test_a_ring_gives_a_point_and_its_normal() -> None:
    """The named value is the first result; the others belong to the same draw."""
    sets = {"position": {"expr": "spot"}, "velocity": {"expr": "spot.normal * 2"}, "mass": {"expr": "spot.turn"},
            "radius": {"expr": "spot.point.x + spot.normal.y"}}
    program = lowered(emitted(LIBRARY, sets, values=SPOT).sets)
    results = found(program)
    assert results["velocity"] == pytest.approx([2 / 3 * part for part in results["position"]])
    assert (results["radius"], 0 < results["mass"] < 1) == (results["position"][0], True)
    assert calls(program).count("on_ring") == 1


def test_used_directly_it_is_its_first_result() -> None:
    """`{"on_ring": {}}` is a point."""
    direct = found(lowered(emitted(LIBRARY, {"position": {"on_ring": {"radius": 3}}}).sets))["position"]
    assert sum(part * part for part in direct) == pytest.approx(9.0)


def test_two_named_values_are_two_draws() -> None:
    """Each value node draws for itself."""
    sets = {"position": {"expr": "spot"}, "velocity": {"expr": "other.normal"}}
    program = lowered(emitted(LIBRARY, sets, values={**SPOT, "other": {"on_ring": {}}}).sets)
    assert calls(program).count("on_ring") == 2
