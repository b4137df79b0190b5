"""Depth of field: what is out of focus is larger and fainter, and keeps its total."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphfx.render import renderer
from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks

from .scenes import CAMERA, comets, cut, film, streaks
from .test_against_reference import LOOKS, hold

OPEN = replace(CAMERA, f_stop=0.02, focus_distance=6.0)
"""A point far away is spread over a disc of 8 pixels' radius."""


@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_blurred_streaks_are_what_the_reference_says(falloff, streak):
    """Before, behind and through the plane in focus, of every look."""
    hold(comets(50, falloff=falloff, streak=streak, length=1.0), camera=OPEN)


def test_focus_that_is_pulled_while_the_shutter_is_open():
    """Head and tail are out of focus by the camera of their own time; a lens that zooms magnifies each by its own."""
    hold(comets(51), camera=OPEN, tail_camera=replace(OPEN, focus_distance=4.5, lens=50.0, f_stop=0.05))


def test_blurred_streaks_through_the_near_plane():
    """Streaks are cut with the blur that they have there, large as it is."""
    camera = replace(OPEN, position=(0, 0, 1.0), near=0.25, f_stop=0.5)
    hold(comets(52, 100, length=0.8), camera=camera)


def test_blur_is_that_of_a_thin_lens():
    """c = F^2 |w - s| / (N w (s - F)): a point at 4 m, a 50 mm lens at f/2 focused at 2 m: 0.641 mm on a film of 36 mm."""
    camera = Camera(lens=50.0, f_stop=2.0, focus_distance=2.0)
    assert camera.confusion(360) * abs(1 - 2.0 / 4.0) * 2 / 10 == pytest.approx(0.05**2 * 2 / (2 * 4 * 1.95) * 1000)


@pytest.mark.parametrize("falloff", FALLOFFS)
def test_blurred_particle_keeps_total_and_gains_the_spread_of_the_disc(falloff):
    """Opacity summed over the picture stays; the mean of x^2 grows by a quarter of the disc's radius squared."""
    camera = Camera(position=(0, 0, 8.0), lens=36.0)
    radius, size = 0.4, (96, 96)
    point = Streaks(np.float32([[0.01], [0.02], [0]]), None, radius, head_opacity=0.7, falloff=falloff)
    sharp, soft = (
        film(point, camera=c, size=size).pixels[..., 3].astype(float)
        for c in (camera, replace(camera, f_stop=0.05, focus_distance=4.0))
    )
    confusion = replace(camera, f_stop=0.05, focus_distance=4.0).confusion(96) * (1 - 4.0 / 8.0)
    x = np.arange(96) + 0.5 - 48 - 0.01 * 12

    def spread(alpha):
        return (alpha.sum(0) * x**2).sum() / alpha.sum()

    assert confusion > 4
    assert soft.sum() == pytest.approx(sharp.sum(), rel=0.02)
    assert spread(soft) - spread(sharp) == pytest.approx(confusion**2 / 4, rel=0.03)


def test_what_is_exactly_in_focus_keeps_its_bytes():
    """Particles in the plane in focus are drawn as by a camera without depth of field."""
    scene = streaks(53)
    scene.head[2] = scene.tail[2] = 0.0
    square = Camera(position=(0.0, 0.0, 6.0), lens=40.0)
    sharp, focused = film(scene, camera=square), film(scene, camera=replace(square, f_stop=0.02, focus_distance=6.0))
    assert sharp.pixels.tobytes() == focused.pixels.tobytes()


def test_closed_lens_is_sharp():
    """The larger the f-number the sharper; the infinite one costs nothing and blurs nothing."""
    scene = streaks(54, length=0.3)
    sharp = film(scene).pixels
    away = [np.abs(film(scene, camera=replace(OPEN, f_stop=stop)).pixels - sharp).max() for stop in (0.02, 0.2, 2e3)]
    assert away[0] > away[1] > away[2] and away[2] < 1e-3
    assert film(scene, camera=replace(CAMERA, focus_distance=3.0)).pixels.tobytes() == sharp.tobytes()


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"f_stop": 0.0}, "f_stop is 0.0"),
        ({"f_stop": 2.0, "projection": "orthographic"}, "orthographic camera has no lens"),
        ({"f_stop": 2.0, "focus_distance": 0.05, "lens": 50.0}, "focus_distance is 0.05 m; .* more than the lens, 50 mm"),
        ({"f_stop": 2.0, "focus_distance": np.inf}, "focus_distance is inf"),
    ],
)
def test_impossible_lenses_are_refused(wrong, message):
    """Each with the number that is wrong."""
    with pytest.raises(ValueError, match=message):
        Camera(**wrong)


@pytest.mark.parametrize("memory", [1, 1 << 15])
def test_blur_and_joints_need_no_memory_at_once(memory, monkeypatch):
    """Patches and slabs of depth give the same bytes out of focus and in pieces, on any threads."""
    monkeypatch.setattr(renderer, "LEAST_MEMORY", 1)
    scene = [cut(comets(55, 200), 0.4), streaks(56, 100, blend="add")]
    whole, parts = (render(scene, OPEN, CAMERA, 45, 37, threads, memory=m) for threads, m in ((1, np.inf), (2, memory)))
    assert whole.pixels.tobytes() == parts.pixels.tobytes() and whole.fragments == parts.fragments
