"""Particles that an applied velocity presses on a surface."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library


@pytest.mark.parametrize("friction", [0, 0.5])
def test_pressed_particle_slides_and_keeps_its_velocity(friction: float) -> None:
    """One that would leave at 1 m/s, and is driven down at 2 m/s, stays on the plane and goes along it; none is given up."""
    document = {
        "graphfx": 1,
        "time": {"frames": [1, 25], "precision": 64},
        "nodes": {
            "source": {"type": "emit", "rate": 1, "set": {"velocity": [0.3, 1, 0]}},
            "motion": {
                "type": "stack",
                "from": "source",
                "ops": [{"type": "translate", "rate": [0, -2, 0]}, {"type": "bounce_plane", "friction": friction}],
            },
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "motion", "camera": "view", "size": [16, 16]},
        },
    }
    simulation = Effect(flatten(document_of(document), Library())).simulation()
    for _ in simulation.frames(25):
        pass
    particles = simulation.particles["source"]
    x, y, _ = (array[0] for array in particles.store.column("position"))
    np.testing.assert_allclose([x, y], [0.3, 0.0], atol=1e-12)
    np.testing.assert_allclose([array[0] for array in particles.store.column("velocity")], [0.3, 1, 0], atol=1e-12)
    assert particles.unfinished == 0
