"""Leaving out what is nearly hidden, for those who ask for it."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.renderer import render

from .scenes import CAMERA, HEIGHT, WIDTH, comets, streaks

CROWD = [streaks(1, 6000, radius=(0.2, 0.6), head_opacity=0.5), comets(2, 300, blend="add")]


def drawn(cutoff: float, threads: int = 1, memory: float = np.inf):
    return render(CROWD, CAMERA, None, WIDTH, HEIGHT, threads, memory=memory, cutoff=cutoff)


@pytest.mark.parametrize("cutoff", [1 / 512, 0.1])
def test_what_is_left_out_is_bounded(cutoff):
    """No pixel is wrong by more than the light that the cutoff lets through, of colours up to 1; fragments are saved."""
    exact, fast = drawn(0.0), drawn(cutoff)
    assert 0 < np.abs(exact.pixels - fast.pixels).max() <= cutoff
    assert fast.fragments < 0.6 * exact.fragments


def test_the_cutoff_knows_neither_threads_nor_memory(monkeypatch):
    """What is left out depends on the pixels alone."""
    monkeypatch.setattr("graphfx.render.renderer.LEAST_MEMORY", 1)
    once = drawn(0.01)
    for other in (drawn(0.01, 3), drawn(0.01, memory=60_000), drawn(0.01, memory=4_000)):
        assert other.pixels.tobytes() == once.pixels.tobytes() and other.fragments == once.fragments
