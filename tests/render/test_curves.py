"""Falloffs of one's own: straight lines between points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS, curve_of
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks

from .scenes import CAMERA, comets, film, streaks

PIXELS = Camera(projection="orthographic", view_width=64.0, position=(0, 0, 10))
RING = ((0.2, 0.0), (0.7, 1.0), (0.9, 0.25))


def still(radius, falloff, **look) -> np.ndarray:
    """Return alpha of a particle at the centre of a pixel of 64 x 64."""
    head = np.float32([[0.5], [0.5], [0.0]])
    return render([Streaks(head, None, radius, falloff=falloff, **look)], PIXELS, None, 64, 64).pixels[..., 3]


@pytest.mark.parametrize("streak", ["exposed", "solid"])
def test_a_straight_line_is_the_linear_falloff(streak):
    """From 1 at the centre to 0 at the edge: the same picture, small particles and comets included."""
    for scene in (comets(1), streaks(2, radius=(0.001, 0.06)), streaks(3, streak=streak)):
        linear = film(scene).pixels
        scene = Streaks(**{name: getattr(scene, name) for name in scene.__dataclass_fields__} | {"falloff": ((0, 1), (1, 0))})
        np.testing.assert_allclose(film(scene).pixels, linear, rtol=0, atol=2e-6)


def test_a_particle_shows_its_curve():
    """At every distance opacity is the curve's: level before the first point and after the last, nothing beyond the edge."""
    alpha = still(20.0, RING)
    y, x = np.mgrid[:64, :64]
    distance = np.hypot(x - 32, y - 31) / 20
    wanted = np.where(distance < 1, np.interp(distance, *zip(*RING, strict=True)), 0)
    np.testing.assert_allclose(alpha, wanted, rtol=0, atol=2e-6)


def test_integrals_are_those_of_the_curve():
    """Width, area and moment agree with sums over a fine grid, and with those of the linear falloff."""
    q = (np.arange(200_000) + 0.5) / 200_000
    value = np.interp(q, *zip(*RING, strict=True))
    falloff = curve_of(RING)
    assert falloff.width == pytest.approx(2 * value.mean(), rel=1e-8)
    assert falloff.area == pytest.approx(2 * math.pi * (q * value).mean(), rel=1e-8)
    assert falloff.moment == pytest.approx((q**3 * value).mean() / (2 * (q * value).mean()), rel=1e-8)
    linear = FALLOFFS["linear"]
    assert curve_of(((0, 1), (1, 0)))[1:4] == pytest.approx(linear[1:4], rel=1e-12)


@pytest.mark.parametrize("radius, length", [(0.3, 0.0), (0.3, 5.0), (4.0, 0.0), (4.0, 20.0)])
def test_total_of_an_exposed_streak_is_kept(radius, length):
    """The light of a ring, still or moving, under a pixel or over it, is its area's."""
    head = np.float32([[-10.2], [0.3], [0.0]])
    streak = Streaks(head, head + np.float32([[length], [0.1], [0]]), radius, falloff=RING, head_opacity=0.3)
    total = float(film(streak, camera=PIXELS, size=(64, 64)).pixels[..., 3].sum(dtype=float))
    assert total == pytest.approx(0.3 * curve_of(RING).area * radius**2, rel=0.03)


def test_curves_of_several_streams_are_their_own():
    """Two rings and a disc keep their shapes beside each other, in patches too."""
    alone = [still(9.0, RING), still(9.0, ((0, 0.5), (1, 0.5)))]
    head = np.float32([[0.5 - 20, 0.5 + 20], [0.5, 0.5], [0, 0]])
    scene = [Streaks(head[:, :1], None, 9.0, falloff=RING), Streaks(head[:, 1:], None, 9.0, falloff=((0, 0.5), (1, 0.5)))]
    both = render(scene, PIXELS, None, 64, 64).pixels[..., 3]
    np.testing.assert_array_equal(both[:, 2:22], alone[0][:, 22:42])
    np.testing.assert_array_equal(both[:, 42:62], alone[1][:, 22:42])


@pytest.mark.parametrize(
    "points", [(), ((0.5, 1), (0.5, 0)), ((0, 2),), ((0, -1),), ((1.5, 1),), ((0, math.nan),), ((0, 0), (1, 0))]
)
def test_what_is_no_curve_is_refused(points):
    """Points out of order or out of range, and a curve that shows nothing."""
    with pytest.raises(ValueError, match="falloff"):
        film(Streaks(np.zeros((3, 1), np.float32), None, 1.0, falloff=points), camera=CAMERA)
