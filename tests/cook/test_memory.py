"""The memory that a cook is allowed decides in how many parts a picture is made, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook import pictures
from graphfx.cook.limits import CookLimits
from graphfx.cook.memory import LEFT, resident, working_memory
from graphfx.render import renderer

from .effects import effect, graph

EMIT = {"rate": 4000, "life": 1, "set": {"velocity": {"in_sphere": {"radius": 2}}, "radius": {"rand": [0.02, 0.1]}}}


def test_parts_of_a_picture_give_the_same_file(tmp_path, monkeypatch):
    """A picture made in many parts has the bytes of one made at once."""
    cooked = effect(graph([{"type": "gravity"}], EMIT, {"frames": [1, 8]}, {"shutter": 1}))
    cooked.cook(tmp_path / "whole", [8])
    monkeypatch.setattr(renderer, "LEAST_MEMORY", 20_000)
    asked: list[int | None] = []
    monkeypatch.setattr(pictures, "working_memory", lambda allowed, pixels: asked.append(allowed) or 0)
    cooked.cook(tmp_path / "parts", [8], limits=CookLimits(memory=10**9))
    assert asked == [10**9]
    whole, parts = (sorted((tmp_path / name).iterdir()) for name in ("whole", "parts"))
    assert [file.read_bytes() for file in whole] == [file.read_bytes() for file in parts]


def test_what_is_allowed_includes_what_is_there():
    """Of the memory allowed, what the process has, the film, and a reserve are taken off."""
    assert working_memory(resident() + LEFT + 16_000_000, 10**6) == pytest.approx(0, abs=20_000_000)
    assert working_memory(None, 100) > 0


def test_resident_memory_grows_with_arrays():
    """A hundred megabytes more are seen."""
    before = resident()
    held = np.ones(100_000_000, np.uint8)
    assert 80_000_000 < resident() - before < 160_000_000 and held[-1]
