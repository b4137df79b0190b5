"""The camera maps the world to the screen as a camera with a 36 mm film does."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera


def screen(camera: Camera, point, width=360, height=240):
    """Return the pixel and depth of a point."""
    x, y, w = camera.screen_matrix(width, height) @ [*point, 1.0]
    return (x / w, y / w, w) if camera.perspective else (x, y, w)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_target_is_in_the_middle(projection):
    """What the camera looks at is in the picture's middle, at its distance."""
    camera = Camera(position=(3, 1, -2), target=(5, 4, 4), projection=projection)
    assert screen(camera, (5, 4, 4)) == pytest.approx((180, 120, 7))


def test_lens_as_wide_as_the_film_sees_a_metre_at_a_metre():
    """f = 36 mm: half a metre to the right, 1 m ahead, is at the picture's right edge; up is to the top."""
    camera = Camera(position=(0, 0, 0), target=(0, 0, -1), lens=36.0)
    assert screen(camera, (0.5, 0, -1)) == pytest.approx((360, 120, 1))
    assert screen(camera, (0, 1 / 3, -1)) == pytest.approx((180, 0, 1))
    assert screen(camera, (0.5, 0, -2)) == pytest.approx((270, 120, 2))


def test_longer_lens_magnifies():
    """Twice the focal length doubles the distance from the middle."""
    near, far = (screen(Camera(lens=lens), (0.1, 0.2, 0))[:2] for lens in (30.0, 60.0))
    assert np.subtract(far, (180, 120)) == pytest.approx(2 * np.subtract(near, (180, 120)))


def test_orthographic_shows_its_width():
    """A point half the width of view to the left is at the left edge, at any depth."""
    camera = Camera(projection="orthographic", view_width=8.0)
    for z in (0, 3):
        assert screen(camera, (-4, 0, z))[:2] == pytest.approx((0, 120))


def test_axes_are_right_handed_and_square():
    """right x up = -ahead; all are units; up leans towards the given one."""
    axes = Camera(position=(1, 2, 3), target=(-2, 0, 1), up=(0.3, 1, 0.2)).axes()
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), -axes[2], atol=1e-14)
    assert axes[1] @ (0.3, 1, 0.2) > 0


@pytest.mark.parametrize("up", [(0, 1, 0), (0, 0, 0), (0, -5, 0)])
def test_looking_straight_down_is_no_difficulty(up):
    """Where up is along the view, the axes are still square."""
    axes = Camera(position=(0, 5, 0), target=(0, 0, 0), up=up).axes()
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-14)


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"projection": "fisheye"}, "projection is 'fisheye'"),
        ({"near": 0.0}, "near is 0.0"),
        ({"near": 2.0, "far": 1.0}, "far 1.0"),
        ({"lens": -1.0}, "lens and view_width"),
        ({"position": (np.nan, 0, 0)}, "finite"),
        ({"target": (0, 1e300, 0)}, "less than 1e\\+100"),
    ],
)
def test_impossible_cameras_are_refused(wrong, message):
    """Each with the number that is wrong."""
    with pytest.raises(ValueError, match=message):
        Camera(**wrong)
