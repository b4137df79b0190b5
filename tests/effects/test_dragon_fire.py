"""The dragon's fire comes out of its mouth, wherever that is, and dies away when the mouth is shut."""

import functools

import numpy as np
import pytest

import graphfx
from tests.effects.goldens import EFFECTS

HINGE = np.array([-2.8, 2.15, 0.0])


@functools.cache
def at(frame):
    return graphfx.load(EFFECTS["dragon_fire"], set={"amount": "0.05"}).simulate(frame)


def way(time):
    """Return where the mouth points at a time [s]."""
    def soft(low, high):
        t = np.clip((time - low) / (high - low), 0, 1)
        return t * t * (3 - 2 * t)

    pitch = np.radians(8 - 16 * soft(0.1, 0.65) + 18 * soft(0.66, 1.0) - 6 * soft(1, 3))
    yaw = np.radians(9 * np.sin(2 * (time - 0.9)) * soft(0.9, 1.5))
    return np.array([np.cos(pitch) * np.cos(yaw), -np.sin(pitch), -np.cos(pitch) * np.sin(yaw)])


@pytest.mark.parametrize("frame", [30, 48, 66])
def test_fire_leaves_along_the_mouth(frame):
    """What is youngest lies along the way that the mouth points now, within the jet's cone and bore."""
    fire = at(frame)["jet/fire"]
    off = fire["position"][np.argsort(fire["id"])[-60:]] - HINGE
    along = off @ way((frame - 1) / 24)
    assert (along > 0.2).all() and (along < 1.3).all()
    assert np.linalg.norm(off - along[:, None] * way((frame - 1) / 24), axis=1).max() < 0.3


def test_no_fire_before_and_none_at_the_end():
    """Before the mouth opens there is no flame, and when smoke remains there is none any more."""
    assert len(at(18)["jet/fire"]["id"]) == 0
    assert len(at(120)["jet/fire"]["id"]) == 0 and len(at(120)["ash"]["position"]) > 0
