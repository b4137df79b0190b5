"""Motion on the screen and in the world, where it is known."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.motion import screen_motion, world_motion
from graphfx.render.streaks import Streaks

AHEAD = Camera(position=(0, 0, 0), target=(0, 0, -1), lens=36.0, near=0.5, far=100.0)
"""One metre at a depth of one metre is as wide as the picture."""
FLAT = Camera(position=(0, 0, 0), target=(0, 0, -1), projection="orthographic", view_width=10.0, near=-50, far=50)


def one(head, tail, share=1.0):
    return Streaks(np.array([head], np.float32).T, None if tail is None else np.array([tail], np.float32).T, share=share)


def on_screen(head, tail, camera=AHEAD, before=None, frames=0.5, share=1.0):
    return screen_motion(one(head, tail, share), camera, before or camera, 200, 100, frames)[0]


@pytest.mark.parametrize(("head", "tail", "want"), [
    ((0.2, 0, -2), (0.1, 0, -2), (20, 0)),  # 0.1 m to the right at 2 m: 10 pixels in half a frame
    ((0, 0.2, -2), (0, 0.1, -2), (0, 20)),  # upwards
    ((0.1, 0, -2), (0.1, 0, -1), (-20, 0)),  # going away: from 20 to 10 pixels off the middle
    ((0.3, 0.2, -2), (0.3, 0.2, -2), (0, 0)),
])
def test_pixels_a_frame(head, tail, want):
    """The way on the screen over the time of it."""
    np.testing.assert_allclose(on_screen(head, tail), want, atol=1e-4)


def test_orthographic():
    """Twenty pixels a metre at every depth."""
    np.testing.assert_allclose(on_screen((1, 1, 5), (0.5, 0, -9), FLAT), (20, 40), atol=1e-4)


def test_what_lived_shorter_went_as_fast():
    """A particle born half way through the shutter went its way in half the time."""
    np.testing.assert_allclose(on_screen((0.2, 0, -2), (0.1, 0, -2), share=0.5), (40, 0), atol=1e-4)
    np.testing.assert_allclose(world_motion(one((1, 2, 3), (0, 0, 0), 0.5), 0.25), [[8, 16, 24]])


def test_camera_that_moves():
    """What rests goes to the left as the camera goes to the right."""
    before = Camera(position=(-0.1, 0, 0), target=(-0.1, 0, -1), lens=36.0, near=0.5, far=100.0)
    np.testing.assert_allclose(on_screen((0, 0, -2), None, AHEAD, before), (-20, 0), atol=1e-4)


def test_part_behind_the_camera_does_not_count():
    """A way straight past the camera is measured where it is seen: from 1 to 0.5 m, 20 to 40 pixels, a third of the way."""
    np.testing.assert_allclose(on_screen((0.1, 0, 0.5), (0.1, 0, -1), frames=1.0), (20 * 3, 0), rtol=1e-4)


@pytest.mark.parametrize("places", [((0, 0, 1), (0.1, 0, 2)), ((0, 0, -200), (1, 0, -300)), ((1, 0, 1), (0, 0, 1))])
def test_what_is_never_seen_does_not_move(places):
    """Behind the camera, or beyond the far plane."""
    np.testing.assert_array_equal(on_screen(*places), (0, 0))


def test_no_time_no_motion():
    """A particle that lived for none of the shutter, and a shutter at the very beginning, give 0 and no infinity."""
    np.testing.assert_array_equal(on_screen((0.2, 0, -2), (0.1, 0, -2), share=0.0), (0, 0))
    np.testing.assert_array_equal(on_screen((0.2, 0, -2), (0.1, 0, -2), frames=0.0), (0, 0))
    np.testing.assert_array_equal(world_motion(one((1, 2, 3), (0, 0, 0)), 0.0), [[0, 0, 0]])


def test_nobody():
    """No particles, no motion."""
    nobody = Streaks(np.zeros((3, 0), np.float32))
    assert screen_motion(nobody, AHEAD, AHEAD, 8, 8, 0.5).shape == (0, 2) and world_motion(nobody, 1.0).shape == (0, 3)
