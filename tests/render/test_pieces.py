"""Streaks in pieces: a path that bends, or that is longer than a frame."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS
from graphfx.render.streaks import Streaks

from .scenes import CAMERA, FLAT, comets, cut, film, path
from .test_against_reference import LOOKS, hold

PIXELS = Camera(projection="orthographic", view_width=64.0, position=(0, 0, 10))
TURNED = Camera(position=(0.5, 0.1, 5.0), target=(0.0, 0.2, 0.0), lens=35.0, f_stop=0.02, focus_distance=5.0)


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_pieces_are_what_the_reference_says(camera, falloff, streak):
    """Joined at either end, at both or at none, with parts of the time of their own."""
    scene = comets(40, 60, falloff=falloff, streak=streak, length=1.0)
    draw = np.random.default_rng(40)
    scene.part, scene.joined = draw.random(60, np.float32), draw.integers(0, 4, 60).astype(np.float32)
    hold(scene, camera=camera)


def test_pieces_see_the_camera_as_it_stands_between():
    """Heads and tails at any moments between the two cameras."""
    scene = comets(41, 80, length=1.0)
    draw = np.random.default_rng(41)
    scene.head_moment, scene.tail_moment = draw.random(80, np.float32), draw.random(80, np.float32)
    scene.joined = draw.integers(0, 4, 80).astype(np.float32)
    hold(scene, tail_camera=TURNED)


def _long(seed: int, radius: tuple[float, float], **look) -> Streaks:
    """Return comets of which every third is many times longer than wide, across the view and somewhat in depth."""
    whole = comets(seed, 12, blend="add", radius=radius, **look)
    angle = np.random.default_rng(seed).uniform(0, 6.28, 12)
    whole.tail = (whole.head + 3.0 * np.stack([np.cos(angle), np.sin(angle), 0.3 * np.sin(9 * angle)])).astype(np.float32)
    whole.tail_radius = whole.head_radius
    return whole


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("falloff, streak", LOOKS)
@pytest.mark.parametrize("moments", [(0.5,), (0.3,), (0.25, 0.6)])
def test_straight_streak_in_pieces_is_the_whole(camera, falloff, streak, moments):
    """Cut anywhere, a streak in even motion gives the same picture to 1e-5: no caps at joints, no other exposure."""
    whole = _long(42, (0.35, 0.45), falloff=falloff, streak=streak)
    got = film(cut(whole, *moments), camera=camera).pixels
    np.testing.assert_allclose(got, film(whole, camera=camera).pixels, rtol=0, atol=1e-5)


@pytest.mark.parametrize("streak", ["exposed", "solid"])
def test_falloff_of_ones_own_is_cut_as_others_are(streak):
    """Also a ring, whose opacity rises towards its edge, and out of focus."""
    whole = _long(42, (0.35, 0.45), falloff=((0, 0.2), (0.7, 0.4), (0.9, 1), (1, 0)), streak=streak)
    for camera in (FLAT, TURNED):
        got = film(cut(whole, 0.3), camera=camera).pixels
        np.testing.assert_allclose(got, film(whole, camera=camera).pixels, rtol=0, atol=1e-5)


@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_thin_straight_streak_in_pieces_is_the_whole(falloff, streak):
    """Under two pixels, where the sum over pixels is made even, too."""
    whole = _long(42, (0.02, 0.2), falloff=falloff, streak=streak, head_color=(1.0, 1.0, 1.0))
    whole.tail_color = None
    got, alone = (film(*each, camera=FLAT).pixels for each in ([cut(whole, 0.4)], [whole]))
    np.testing.assert_allclose(got, alone, rtol=0, atol=1e-5)


@pytest.mark.parametrize("streak", ["exposed", "solid"])
def test_still_particle_under_a_moving_camera_in_pieces(streak):
    """What stands still goes straight on the screen, however it is cut."""
    still = _long(43, (0.3, 0.4), streak=streak)
    still.tail = still.head.copy()
    opening = Camera(position=(4.0, 0.1, 5.0), target=(4.0, -0.5, 0.0), lens=35.0)
    whole = film(still, tail_camera=opening).pixels
    got = film(cut(still, 0.3, 0.75), tail_camera=opening).pixels
    np.testing.assert_allclose(got, whole, rtol=0, atol=1e-5)


def _bent(opacity: float, first: float, **look) -> Streaks:
    """Return a path of two pieces at a right angle, of which the head's takes the part `first` of the time."""
    places = ((-15.3, 12.1, 0), (0.2, -8.3, 0), (14.1, 6.2, 0))
    return path(places, 2.5, np.array([first, 1 - first]), head_opacity=opacity, **look)


@pytest.mark.parametrize("falloff", FALLOFFS)
def test_exposed_pieces_of_a_bend_keep_the_total_light(falloff):
    """A path of two pieces sends the light of a particle that stands still."""
    bend = film(_bent(0.4, 0.3, falloff=falloff, blend="add"), camera=PIXELS, size=(64, 64)).pixels[..., 0].sum()
    still = Streaks(np.float32([[0.2], [0.3], [0]]), None, 2.5, head_opacity=0.4, falloff=falloff, blend="add")
    assert bend == pytest.approx(film(still, camera=PIXELS, size=(64, 64)).pixels[..., 0].sum(), rel=0.02)


@pytest.mark.parametrize("turn", [0.3, 0.8, 1.5, 2.5])
def test_solid_bend_is_one_body(turn):
    """Where pieces of half opacity go on in each other there are no gaps and no beads: each pixel is covered once."""
    corner = np.array([0.3, -0.2, 0])
    ends = [corner + 20 * np.array([np.cos(angle), np.sin(angle), 0]) for angle in (np.pi, turn)]
    look = {"streak": "solid", "falloff": "disc", "head_opacity": 0.5}
    apart = [path([end, corner], 4.0, **look) for end in ends]
    joined = [path([ends[0], corner, ends[1]], 4.0, **look)]
    one, two = (film(*each, camera=PIXELS, size=(64, 64)).pixels[..., 3] for each in (joined, apart))
    most = np.maximum(*(film(each, camera=PIXELS, size=(64, 64)).pixels[..., 3] for each in apart))
    np.testing.assert_allclose(one, most, rtol=0, atol=1e-5)
    assert two.max() > 0.7


@pytest.mark.parametrize("streak", ["exposed", "solid"])
def test_camera_that_turns_round_while_the_shutter_is_open(streak):
    """What is behind the camera at the shutter's opening is cut at the near plane, as any streak is."""
    ahead, behind = Camera(position=(0, 0, 6)), Camera(position=(0, 0, 6), target=(0.3, 0.1, 12))
    got, _ = hold(comets(44, 60, streak=streak), camera=ahead, tail_camera=behind)
    assert got.pixels[..., 3].max() > 0
