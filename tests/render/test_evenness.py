"""Small particles keep their light wherever they are among the pixels, however they are streaked."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks

PIXELS = Camera(projection="orthographic", view_width=128.0, position=(0, 0, 10))
"""One pixel a metre, 128 wide."""


def total(head, tail, radius, **look) -> float:
    """Return the sum of alpha of one streak."""
    points = (np.array([point], np.float64).T for point in ((*head, 0.0), (*tail, 0.0)))
    film = render([Streaks(*points, radius, **look)], PIXELS, None, 128, 128)
    return float(film.pixels[..., 3].sum(dtype=float))


@pytest.mark.parametrize("falloff", FALLOFFS)
@pytest.mark.parametrize("length", [10.0, 30.0, 60.0])
def test_long_thin_streaks_are_even_along_the_pixels_and_across(falloff, length):
    """Along a row, along a diagonal and between, at any place: to 1 %."""
    wanted = 0.3 * FALLOFFS[falloff].area * 0.5**2
    for angle in (0.0, 0.02, np.pi / 4, np.pi / 2):
        for place in (0.0, 0.25, 0.5):
            head = (-30.0 + place, -30.0 + place)
            tail = (head[0] + length * np.cos(angle), head[1] + length * np.sin(angle))
            assert total(head, tail, 0.5, falloff=falloff, head_opacity=0.3) == pytest.approx(wanted, rel=0.01)


@pytest.mark.parametrize("falloff", FALLOFFS)
@pytest.mark.parametrize("length", [0.3, 0.9, 6.0])
def test_fading_specks_are_even(falloff, length):
    """A speck whose opacity changes from head to tail has the light of the mean, wherever it is."""
    for place in np.linspace(0, 1, 9):
        got = total((place, 0.5), (place + length, 0.5), 0.5, falloff=falloff, head_opacity=0.2, tail_opacity=0.0)
        assert got == pytest.approx(0.1 * FALLOFFS[falloff].area * 0.25, rel=0.01)


@pytest.mark.parametrize("length", [0.0, 1.0, 8.0, 40.0])
def test_tapering_streaks_have_the_mean_of_their_way(length):
    """From radius 0.8 to nothing in even motion: area times the mean of r^2, whatever the length."""
    got = total((0.2, 0.3), (0.2 + length, 0.3), 0.8, tail_radius=0.0 if length else 0.8, head_opacity=0.3)
    mean = 0.8**2 / 3 if length else 0.8**2
    assert got == pytest.approx(0.3 * FALLOFFS["linear"].area * mean, rel=0.01)


def test_solid_streaks_have_their_area():
    """A thin solid capsule has width r L + area r^2, along the pixels too."""
    for falloff, (_, width, area, *_rest) in FALLOFFS.items():
        got = [total((-20.0, y), (20.0, y), 0.5, falloff=falloff, streak="solid", head_opacity=0.3) for y in (0.0, 0.3, 0.5)]
        assert got == pytest.approx([0.3 * (width * 0.5 * 40 + area * 0.25)] * 3, rel=0.01)
