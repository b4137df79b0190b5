"""What must hold for any graph of events."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.cook.paths import lives_of
from graphfx.cook.pictures import window_of
from graphfx.cook.streaks import streaks_of
from graphfx.errors import GraphfxError, LimitError
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


@pytest.mark.parametrize("seed", range(8, 24))
def test_pieces_of_every_way_take_all_of_its_time(seed: int) -> None:
    """Whatever happens while the shutter is open, the pieces of a particle's way take the time for which it is seen, no more."""
    made = effect(seed)
    if made is None:
        pytest.skip("this graph is refused")
    simulation, image = made.simulation(), made.plan.images[0]
    try:
        for frame in simulation.frames(LAST):
            window = window_of(image, simulation, frame)
            for drawn in image.streams:
                particles = simulation.particles[drawn.path]
                for each in (particles, particles.past) if particles.past is not None else (particles,):
                    share = np.maximum(lives_of(each, window, np.arange(each.store.count)).share, 0.0)
                    taken = np.zeros(each.store.count)
                    for shown in streaks_of(each, None, drawn.looks, window, True):
                        streaks = shown.streaks.drawn()
                        np.add.at(taken, shown.rows, np.broadcast_to(streaks.share * streaks.part, len(shown.rows)))
                    np.testing.assert_allclose(taken, share, rtol=0, atol=1e-5)
    except LimitError:
        pytest.skip("this graph passes a limit of its own")


def test_random_graphs_plan_or_are_told_what_is_wrong() -> None:
    """No graph ends in anything but a plan or a message."""
    plans = [effect(seed) is not None for seed in range(100, 220)]
    assert sum(plans) > 60
