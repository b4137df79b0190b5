"""The crashing head has its shape until it lands, breaks into rigid pieces, and comes to rest on the ground."""

import functools

import numpy as np
import pytest

import graphfx
from tests.effects.goldens import EFFECTS

START, LANDED = 0.5, 0.5 + np.sqrt(3.24 / 5)


@functools.cache
def at(frame):
    return graphfx.load(EFFECTS["crashing_head"], set={"amount": "0.01", "dust": "0"}).simulate(frame)["head/solid"]


def test_it_falls_as_a_whole():
    """Until the crack begins, every particle has fallen g t^2 / 2 from its place, and turned nowhere."""
    whole, falling = at(1)["position"], at(26)["position"]
    way = 0.5 * 5 * (25 / 24 - START) ** 2
    assert np.allclose(falling, whole - np.array([0, way, 0]), atol=1e-3)


def test_pieces_are_rigid_in_flight():
    """Two particles of a piece keep their distance from the break until one of them hits the ground."""
    early, late = at(40), at(43)
    flying = np.isfinite(early["broke"]) & (late["hits"] == 0)
    pieces, number = np.unique(early["launch"][flying].round(4), axis=0, return_inverse=True)
    assert len(pieces) > 20
    for piece in range(len(pieces)):
        before, after = (state["position"][flying][number.ravel() == piece].astype(float) for state in (early, late))
        spans = [np.linalg.norm(where - where[0], axis=1) for where in (before, after)]
        assert np.allclose(*spans, atol=3e-3)


@pytest.mark.parametrize("frame", [37, 46, 120])
def test_nothing_is_below_the_ground(frame):
    """All particles are at or above y = 0."""
    assert at(frame)["position"][:, 1].min() >= -1e-4


def test_most_come_to_rest():
    """In the last second nine of ten particles lie still; some still slide."""
    assert np.quantile(np.linalg.norm(at(120)["position"] - at(96)["position"], axis=1), 0.9) < 0.01
