"""What must hold for any graph of events."""

from __future__ import annotations

import pytest

from graphfx.cook.effect import Effect
from graphfx.errors import GraphfxError
from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

from .random_events import EventMaker
from .test_random_graphs import different

LIBRARY = Library([bundled_root()])
LAST = 4


def effect(seed: int) -> Effect | None:
    """Return a random effect, or None where the graph was told to be wrong."""
    document = document_of(EventMaker(seed).graph(), "random.json")
    try:
        made = Effect(flatten(document, LIBRARY))
        made.plan  # noqa: B018, it may tell what is wrong
    except GraphfxError as error:
        assert str(error)
        return None
    assert check(document, LIBRARY) == []
    return made


@pytest.mark.parametrize("seed", range(8))
def test_machine_gives_the_bits_of_plain_python(seed: int) -> None:
    """With births, hits, deaths and new lives the machine equals the plain-Python reference to the last bit."""
    made = effect(seed)
    if made is None:
        pytest.skip("this graph is refused")
    try:
        machine = made.simulate(LAST)
    except GraphfxError:
        pytest.skip("this graph passes a limit of its own")
    reference = made.simulate(LAST, reference=True)
    for path, columns in reference.items():
        assert {name: different(machine[path][name], columns[name]) for name in columns} == dict.fromkeys(columns, 0)


def test_random_graphs_plan_or_are_told_what_is_wrong() -> None:
    """No graph ends in anything but a plan or a message."""
    plans = [effect(seed) is not None for seed in range(100, 220)]
    assert sum(plans) > 60
