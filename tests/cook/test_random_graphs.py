"""What must hold for any graph."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.errors import GraphfxError
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library

from .random_graphs import GraphMaker

LIBRARY = Library()
LAST = 5


def effect(seed: int) -> Effect | None:
    """Return a random effect, or None where the graph was told to be wrong."""
    try:
        made = Effect(flatten(document_of(GraphMaker(seed).graph(), "random.json"), LIBRARY))
        made.plan  # noqa: B018, it may tell what is wrong
    except GraphfxError as error:
        assert str(error)
        return None
    return made


def different(a: np.ndarray, b: np.ndarray) -> int:
    """Return how many values differ in any bit; a NaN is a NaN."""
    same = a.view(np.dtype(f"u{a.itemsize}")) == b.view(np.dtype(f"u{b.itemsize}"))
    if a.dtype.kind == "f":
        same |= np.isnan(a) & np.isnan(b)
    return int((~same).sum())


@pytest.mark.parametrize("seed", range(24))
def test_machine_gives_the_bits_of_plain_python(seed: int) -> None:
    """The block machine equals the plain-Python reference to the last bit, whatever the graph."""
    made = effect(seed)
    if made is None:
        pytest.skip("this graph is refused")
    machine, reference = made.simulate(LAST), made.simulate(LAST, reference=True)
    for path, columns in reference.items():
        assert {name: different(machine[path][name], columns[name]) for name in columns} == dict.fromkeys(columns, 0)


def test_random_graphs_plan_or_are_told_what_is_wrong() -> None:
    """No graph ends in anything but a plan or a message."""
    plans = [effect(seed) is not None for seed in range(100, 300)]
    assert sum(plans) > 100
