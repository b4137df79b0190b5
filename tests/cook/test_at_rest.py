"""Particles that stand still, and spawns whose numbers mean nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.errors import LimitError
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

LIBRARY = Library([bundled_root()])


def effect(seen: str, **nodes: Any) -> Effect:
    """Return an effect of six frames that draws one of its nodes."""
    data = {"graphfx": 1, "time": {"frames": [0, 5], "precision": 64}, "nodes": {
        **nodes, "view": {"type": "camera"}, "frames": {"type": "image", "from": seen, "camera": "view"}}}
    return Effect(flatten(document_of(data), LIBRARY))


def test_what_stands_still_may_change_at_each_step() -> None:
    """Where nothing moves, a set at each step still acts, and adds up."""
    sets = {"type": "set", "from": "sky", "when": "step", "set": {"mass": {"expr": "mass + 1"}, "radius": {"expr": "mass"}}}
    found = effect("it", sky={"type": "emit", "count": 2}, it=sets).simulate(5)["sky"]["radius"]
    np.testing.assert_array_equal(found, [6.0, 6.0])


@pytest.mark.parametrize("rate", ["0 / 0", "mass - 9", "(mass - mass) / 0"])
def test_a_trail_of_no_sensible_rate_makes_nothing(rate: str) -> None:
    """A rate that is no number, or below 0, is none."""
    made = effect("it", sky={"type": "emit", "count": 2}, it={"type": "spawn", "from": "sky", "rate": {"expr": rate}})
    assert len(made.simulate(5)["it"]["birth"]) == 0


@pytest.mark.parametrize("rate", [1e30, "infinity"])
def test_an_endless_trail_is_refused(rate: Any) -> None:
    """So many children as would not fit are told before they are made."""
    made = effect("it", sky={"type": "emit", "count": 2}, it={"type": "spawn", "from": "sky", "rate": rate})
    with pytest.raises(LimitError, match="particles would be alive at once"):
        made.simulate(5)


def test_what_one_target_of_a_fade_reads_another_may_give() -> None:
    """Of two attributes that fade together, one is read by the other alone; what it is drawn by is stored too."""
    fade = {"type": "fade", "from": "sky", "rate": 100, "set": {
        "radius": {"expr": "mass"}, "mass": {"rand": [1, 2], "per": "part"}}}
    made = effect("it", sky={"type": "emit", "count": 4, "clusters": {"part": {"count": 2}}}, it=fade)
    found = made.simulate(5)["sky"]["radius"]
    assert ((found > 0.99) & (found < 2)).all() and len(set(np.round(found, 6))) == 2
