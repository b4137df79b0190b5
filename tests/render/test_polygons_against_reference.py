"""The renderer gives of polygons, alone and among particles, what brute force gives."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render import Lighting, Polygons
from graphfx.render.camera import Camera

from .meshes import CAMERA, FLAT, SIZE, film, hold, picture, triangles
from .polygon_reference import pieces_of, solved
from .scenes import comets, streaks

CAMERAS = pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])


@CAMERAS
@pytest.mark.parametrize("shading", ["flat", "smooth", "unlit"])
def test_opaque_triangles_that_cross(camera, shading):
    """Where triangles run through each other, samples tell which is before."""
    hold([triangles(1, shading=shading)], camera=camera)


@CAMERAS
@pytest.mark.parametrize("shading", ["flat", "smooth", "unlit"])
def test_transparent_triangles(camera, shading):
    """Any number of layers, nearest first, behind and before opaque ones."""
    opacity = np.random.default_rng(2).uniform(0.1, 1.2, 90)
    hold([triangles(2, 30, shading=shading, opacity=opacity), triangles(3, 6)], camera=camera)


@CAMERAS
def test_maps(camera):
    """Colour and opacity maps, near and far, with alpha and without."""
    scene = [
        triangles(4, 8, color_map=picture(1), shading="unlit"),
        triangles(5, 8, color_map=picture(2, opaque=True), opacity_map=picture(3, 5, 4), shading="smooth"),
        triangles(6, 8, size=0.2, color_map=picture(4, 64, 64, opaque=True)),
    ]
    hold(scene, camera=camera)


@CAMERAS
@pytest.mark.parametrize("opacity", [1.0, 0.6])
def test_polygons_among_particles(camera, opacity):
    """Fragments of particles, flames and polygons lie between each other."""
    scene = [triangles(7, 12, opacity=opacity, color_map=picture(5, opaque=True)), triangles(8, 6)]
    hold(scene, streaks(1), comets(2, blend="add"), streaks(3, falloff="disc", streak="solid"), camera=camera)


@pytest.mark.parametrize("opacity", [1.0, 0.5, np.random.default_rng(9).uniform(-0.2, 1.4, 90)], ids=["1", "0.5", "vertices"])
def test_triangles_through_the_near_and_far_plane(opacity):
    """A triangle is cut at the planes, with what it has there."""
    camera = Camera(position=(0, 0, 1.0), lens=30.0, near=0.25, far=2.0)
    scene = [triangles(9, 30, opacity=opacity, color_map=picture(6), shading="smooth")]
    hold(scene, comets(7, 80), camera=camera)


@CAMERAS
def test_triangles_smaller_than_a_pixel(camera):
    """Each sample counts, whoever covers it."""
    scene = [triangles(10, 300, size=0.04), triangles(11, 300, size=0.02, opacity=0.7, shading="smooth")]
    hold(scene, streaks(4, 20), camera=camera)


def test_triangle_of_a_million_pixels():
    """Corners far outside the picture change nothing within."""
    corners = np.array([[-3e4, -1e4, -0.5], [3e4, -2e4, 0.3], [1e3, 4e4, 0.1]])
    far = Polygons(corners, np.array([[0, 1, 2]]), opacity=0.5, color=(0.9, 0.5, 0.1))
    past = Polygons(corners * [1, 1, 1e3], np.array([[0, 1, 2]]), np.eye(3), shading="smooth", opacity=0.7)
    hold([far, past], streaks(5), camera=CAMERA)


def test_degenerate_and_broken_triangles():
    """Triangles without area are not seen; those with a number that is not finite are dropped and counted."""
    scene = triangles(12, 10)
    scene.vertices[3] = scene.vertices[4]
    scene.vertices[6:9] = [[0, 0, 0], [1, 1, 0], [2, 2, 0]]
    scene.vertices[10, 1] = np.nan
    scene.vertices[14, 2] = np.inf
    assert hold([scene]).dropped == 2


@CAMERAS
def test_keys_are_depths(camera):
    """A fragment's key is that of the point where the ray through the mean of its samples meets the triangle, to rounding."""
    errors = []
    for piece in pieces_of(triangles(15, 200, size=2.0), camera, *SIZE)[0]:
        x, y = np.clip(piece.corners.mean(axis=0), 0, SIZE)
        found = solved(piece, x, y, camera, *SIZE)
        exact = -found.sum() if camera.perspective else found @ piece.whole[:, 2]
        if np.abs(exact - np.clip(exact, piece.keys.min(), piece.keys.max())) == 0:
            errors.append(abs(np.float32(piece.key(x, y)) - exact) / abs(exact))
    assert len(errors) > 50 and max(errors) < 1e-7


def test_the_light_of_the_camera():
    """Without lights, one shines from over the shoulder."""
    assert hold([triangles(13, 6)], lighting=Lighting()).pixels.max() > 0.1


@CAMERAS
def test_polygons_seen_from_one_side(camera):
    """The rest is not there."""
    scene = triangles(14, 30, double_sided=False)
    assert hold([scene], camera=camera).pixels[..., 3].sum() < film([triangles(14, 30)], camera=camera).pixels[..., 3].sum()


def test_equal_depths_go_by_rank():
    """Of what lies at one depth the earlier polygons are before the later, and all of them before particles."""
    opacities = (0.5, 1.0, 1.0, 0.5)
    sheet = np.array([[-2.0, -2, 0], [2, -2, 0], [0, 2, 0]])
    scene = [Polygons(sheet + np.array([0.1 * k, 0, 0]), np.array([[0, 1, 2]]), color=np.eye(3)[k % 3], opacity=opacity,
                      shading="unlit") for k, opacity in enumerate(opacities)]
    still = streaks(6, length=0.0)
    still.head[2] = still.tail[2] = 0.0
    hold(scene, still, camera=FLAT)
