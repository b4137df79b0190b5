"""What the groups of the library promise, measured on the particles that they make."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

LIBRARY = Library([bundled_root()])


def state(frame: int, nodes: dict[str, Any], *use: str) -> dict[str, dict[str, np.ndarray]]:
    """Return the particles of each emitter at a frame (24 a second, frame 0 at the start)."""
    data = {"graphfx": 1, "time": {"frames": [0, frame], "precision": 64},
            "use": {name: f"groups/{name}.json" for name in use},
            "nodes": {**nodes, "view": {"type": "camera"}, "frames": {"type": "image", "from": "it", "camera": "view"}}}
    return Effect(flatten(document_of(data, folder=Path(bundled_root())), LIBRARY)).simulate(frame)


def test_a_fountain_rises_to_its_height() -> None:
    """Straight up, the fastest drops reach the height and none passes it, whatever the gravity."""
    for weight in (9.81, 3.0):
        nodes = {"it": {"type": "fountain", "height": 2, "angle": 0, "width": 0, "weight": weight, "rate": 3000}}
        height = state(30, nodes, "fountain")["it/drops"]["position"][:, 1].max()
        assert 1.99 < height <= 2.0 + 1e-9


def test_an_explosion_is_one_burst_at_its_time() -> None:
    """No piece before it, all at it, and none more than speed * t from the center."""
    nodes = {"it": {"type": "explosion", "at": 0.5, "pieces": 500, "ball": 0, "slowing": 0, "weight": 0, "speed": 3}}
    assert len(state(11, nodes, "explosion").get("it/blast", {"position": ()})["position"]) == 0
    away = np.linalg.norm(state(18, nodes, "explosion")["it/blast"]["position"] - [0, 1, 0], axis=1)
    assert len(away) == 500 and 0.6 < away.max() <= 0.75 + 1e-9


@pytest.mark.parametrize("falloff", [0, 1, 2, 3])
def test_an_orbit_keeps_its_distance(falloff: float) -> None:
    """At any power of the distance the velocity given at birth is that of a circle, softened or not."""
    nodes = {"dust": {"type": "emit", "count": 50, "set": {"position": {"in_disc": {"radius": 1.5}}}},
             "it": {"type": "orbit", "from": "dust", "falloff": falloff, "softening": 0.5, "center": [0, 0, 0]}}
    first, last = (state(frame, nodes, "orbit")["dust"]["position"] for frame in (0, 24))
    before, after = (np.linalg.norm(where, axis=1) for where in (first, last))
    np.testing.assert_allclose(after, before, atol=0.01)
    assert np.abs(last - first).max() > 0.3


def test_an_orbit_at_its_own_center_stays_finite() -> None:
    """A particle that is born at the centre, without softening, has no direction to go, and stays."""
    nodes = {"dust": {"type": "emit", "count": 1}, "it": {"type": "orbit", "from": "dust", "softening": 0}}
    assert np.isfinite(state(5, nodes, "orbit")["dust"]["position"]).all()


def test_a_tornado_lifts_what_it_turns() -> None:
    """Dust within its reach rises and goes around by the right hand; beyond it nothing rises."""
    ring = {"type": "emit", "count": 40, "set": {"position": {"in_disc": {"radius": 2}}}}
    nodes = {"dust": ring, "it": {"type": "tornado", "from": "dust", "strength": 1, "pull": 0}}
    first, last = (state(frame, nodes, "tornado")["dust"]["position"] for frame in (0, 6))
    assert (last[:, 1] > 0.05).all()
    turned = first[:, 2] * last[:, 0] - first[:, 0] * last[:, 2]
    assert (turned > 0).all()
    nodes["it"]["reach"] = 0.001
    assert state(6, nodes, "tornado")["dust"]["position"][:, 1].max() == 0


def test_splats_lie_in_the_surface() -> None:
    """Each hit makes so many pieces; they spread along the wall and never leave it."""
    nodes = {"throw": {"type": "emit", "count": 3, "set": {"velocity": [5, 0, 0], "position": {"in_disc": {"axis": [1, 0, 0]}}}},
             "wall": {"type": "bounce_plane", "from": "throw", "point": [1, 0, 0], "normal": [-1, 0, 0]},
             "it": {"type": "splat", "from": "wall", "pieces": 7, "slowing": 0, "speed": 2}}
    pieces = state(12, nodes, "splat")["it/drops"]["position"]
    assert len(pieces) == 21
    np.testing.assert_allclose(pieces[:, 0], 1.0, atol=1e-6)
    assert np.ptp(pieces[:, 1]) > 0.5


def test_flames_of_one_flicker_are_alike() -> None:
    """Lives of a flicker differ by the share that varies; those of the whole fire differ more."""
    nodes = {"it": {"type": "flicker", "flickers": 5, "rate": 4000}}
    fire = state(8, nodes, "flicker")["it/fire"]
    lives = [fire["life"][fire["flicker"] == number] for number in range(5)]
    assert sum(map(len, lives)) == len(fire["life"]) > 1000
    assert max(np.ptp(each) for each in lives) <= 0.2 * 0.8 * 1.2 < np.ptp(fire["life"])


def test_flames_gather_above_their_base() -> None:
    """Flames do not spread like a fan: in still air old ones stand closer together than those that have just begun."""
    calm = {"unrest": 0, "curl": 0, "rate": 4000, "base": 1}
    fire = state(40, {"it": {"type": "flicker", **calm}}, "flicker")["it/fire"]
    place, age = fire["position"], 40 / 24 - fire["birth"]
    across = np.linalg.norm(place[:, ::2], axis=1)
    old, young = age > 0.7 * fire["life"], age < 0.2 * fire["life"]
    assert np.mean(across[old]) < 0.8 * np.mean(across[young]) and np.mean(place[old, 1]) > 1
