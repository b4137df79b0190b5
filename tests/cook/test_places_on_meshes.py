"""Particles that begin on a mesh have its normal and tangent there, without being told."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.cook.effects import effect

BOX = {"box": {"type": "mesh_box"}}


def began(position: Any) -> dict[str, np.ndarray]:
    """Return particles at birth that fly along the normal of the place where they begin."""
    nodes = {
        **BOX,
        "sky": {"type": "emit", "count": 500, "set": {"position": position, "velocity": {"expr": "normal"}}},
        "view": {"type": "camera"},
        "out": {"type": "image", "from": "sky", "camera": "view"},
    }
    columns: dict[str, np.ndarray] = effect({"graphfx": 1, "nodes": nodes}).simulate(1)["sky"]
    return columns


def test_normal_comes_with_the_position() -> None:
    """On a box of side 1 the normal has one component of 1, where the position has 1/2 of the same sign."""
    columns = began({"on_surface": {"mesh": "box"}})
    normal, position = columns["velocity"], columns["position"]
    np.testing.assert_array_equal(np.abs(normal).sum(axis=1), 1)
    np.testing.assert_array_equal((normal * position).sum(axis=1), 0.5)
