"""Particles that an applied velocity presses on a surface."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library

from .many_particles import carried, states, walk


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


def test_who_is_turned_into_a_floor_goes_along_it():
    """30,000 particles thrown about under a turn that leads into the floor use up no more contacts than they have."""
    chance, count = np.random.default_rng(1), 30_000
    place, velocity = chance.uniform([-2, 0, -2], [2, 1, 2], (count, 3)), chance.normal(0, 2, (count, 3))
    turn = {"type": "rotate", "center": [0, 0.5, 0], "axis": [0, 0, 1], "speed": 6}
    ops = [{"type": "gravity"}, turn, {"type": "bounce_plane", "resilience": 0.3}]
    *_, simulation = walk(ops, place, velocity, frames=3, precision=32, method="strang")
    assert simulation.particles["one"].unfinished == 0


def test_the_way_along_a_ball_is_of_second_order():
    """Who slides down a ball without friction keeps its energy, and is where it should be, to the square of the step."""
    chance, count = np.random.default_rng(2), 40
    place, velocity = chance.uniform([-0.5, 1.3, -0.5], [0.5, 2, 0.5], (count, 3)), chance.normal(0, 0.3, (count, 3))
    ops = [{"type": "gravity"}, {"type": "bounce_sphere", "resilience": 0}]

    def after(substeps: int) -> np.ndarray:
        return carried(ops, place, velocity, frames=24, method="exact", substeps=substeps)[0]

    true = after(96)
    off = [float(np.median(np.linalg.norm(after(count) - true, axis=1))) for count in (1, 4, 16)]
    assert off[0] < 0.005 and off[0] > 10 * off[1] > 100 * off[2]


def test_a_slide_in_a_hollow_keeps_its_energy():
    """Who slides to and fro in a frictionless bowl under gravity comes back as high, to the square of the step."""
    ops = [{"type": "gravity"}, {"type": "bounce_sphere", "inside": True, "resilience": 0}]
    lost = []
    for substeps in (2, 8):
        states_ = [states(each) for each in walk(ops, (1, 0, 0), (0, 0, 0), frames=96, substeps=substeps, method="exact")]
        energy = [float((v[0] ** 2).sum() / 2 + 9.81 * x[0, 1]) for x, v in states_[12:]]
        lost.append(max(abs(energy[0] - each) for each in energy))
    assert lost[0] < 0.05 and lost[1] < lost[0] / 8
