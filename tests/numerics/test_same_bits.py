"""A particle moves with the same bits, whoever is there besides and however many threads there are."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.sample import Sample
from graphfx.cook.trial import Trials

from ..cook.effects import effect, graph, particles
from ..cook.test_same_bytes import EMIT, OPS

MANY = 100_000
CROWD = EMIT | {"rate": 0, "count": MANY, "life": 9}
TIME = {"frames": [0, 5], "substeps": 2}


@pytest.mark.parametrize("precision", [32, 64])
def test_a_particle_alone_moves_as_among_many(precision):
    """Particles 0, 1, 4711 and 99999 of a hundred thousand move, each alone, with the bits that they have among all."""
    flat = effect(graph([*OPS, {"type": "random_acceleration"}], CROWD, TIME | {"precision": precision})).flat
    whole = Trials(flat).run([5]).states["sky"][5]
    assert len(whole) == MANY
    for i in (0, 1, 4711, MANY - 1):
        alone = Trials(flat, Sample({"sky": np.array([i])})).run([5]).states["sky"][5]
        assert alone.ids.tolist() == [whole.ids[i]]
        assert alone.position.tobytes() == whole.position[i].tobytes()
        assert alone.velocity.tobytes() == whole.velocity[i].tobytes()


@pytest.mark.parametrize("precision", [32, 64])
def test_any_number_of_threads_moves_them_the_same(precision):
    """A hundred thousand particles have the same bits by 1, 2 and 7 threads."""
    document = graph(OPS, CROWD, TIME | {"precision": precision})
    one = particles(document, 5, threads=1)
    for threads in (2, 7):
        other = particles(document, 5, threads=threads)
        assert all(one[name].tobytes() == other[name].tobytes() for name in one)
