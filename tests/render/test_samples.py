"""Samples are all fragments of every pixel, in the renderer's order."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render import Polygons
from graphfx.render.camera import Camera
from graphfx.render.renderer import render
from graphfx.render.samples import NOTHING, fold_samples
from graphfx.render.streaks import Streaks

from .meshes import LIGHTING, picture, triangles
from .reference import reference
from .scenes import CAMERA, FLAT, HEIGHT, WIDTH, comets, film, streaks

CAMERAS = pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])


def sampled(*streams, camera=CAMERA, size=(WIDTH, HEIGHT), threads=1, **given):
    """Return the film and, for each pixel, its samples as (depth, opacity, color, particle)."""
    bands = []
    made = render(list(streams), camera, None, *size, threads, sampler=bands.append, **given)
    pixels = []
    for band in bands:
        assert band.top == len(pixels) // band.width
        for a, b in zip(band.offsets[:-1], band.offsets[1:], strict=True):
            pixels.append((band.depth[a:b], band.opacity[a:b], band.color[a:b], band.particle[a:b]))
    assert len(pixels) == size[0] * size[1]
    return made, pixels


def flattened(pixels):
    """Composite front to back, in float64."""
    result = np.zeros((len(pixels), 4))
    for at, (_, opacity, color, _) in enumerate(pixels):
        through = 1.0
        for a, c in zip(opacity.astype(float), color.astype(float), strict=True):
            result[at, :3] += through * abs(a) * c
            through *= 1 - max(a, 0)
        result[at, 3] = 1 - through
    return result


@CAMERAS
def test_samples_flatten_to_the_picture(camera):
    """Over and add, thin and wide, all that the picture shows is in the samples, in their order; none is lost or double."""
    made, pixels = sampled(streaks(1), comets(2, blend="add"), streaks(3, radius=(0.001, 0.02), falloff="disc"), camera=camera)
    np.testing.assert_allclose(flattened(pixels), made.pixels.reshape(-1, 4), atol=2e-6)
    assert sum(len(depth) for depth, *_ in pixels) == made.fragments


def test_overflowing_pixels_are_sampled_too():
    """Hundreds of fragments in every pixel, in order."""
    made, pixels = sampled(streaks(4, 600, radius=(0.4, 0.9), spread=0.5))
    np.testing.assert_allclose(flattened(pixels), made.pixels.reshape(-1, 4), atol=1e-5)
    assert max(len(depth) for depth, *_ in pixels) > 200


@CAMERAS
def test_depth_is_along_the_cameras_axis(camera):
    """A still particle's depth is that of its centre, not its distance; nearer comes first."""
    ahead = camera.axes()[2]
    places = np.array([[0.9, 0.1, -1.0], [0.9, 0.1, 0.5], [-1.0, -0.8, 0.3]])
    _, pixels = sampled(Streaks(places.T.astype(np.float32), head_radius=0.2), camera=camera)
    want = (places - camera.position) @ ahead
    seen = set()
    for depth, _, _, particle in pixels:
        np.testing.assert_allclose(depth, want[particle], rtol=1e-6)
        assert (np.diff(depth) >= 0).all()
        seen |= set(particle)
    assert seen == {0, 1, 2}


def test_particles_are_numbered_through_all_streams():
    """The colour of each sample is that of the particle that it names."""
    streams = [streaks(5, 40), streaks(6, 25, blend="add")]
    colors = np.concatenate([stream.head_color for stream in streams], axis=1).T
    _, pixels = sampled(*streams)
    for _, opacity, color, particle in pixels:
        np.testing.assert_array_equal(color, colors[particle])
        assert ((opacity < 0) == (particle >= 40)).all()


def test_equal_depths_stay_in_the_order_of_streams_and_particles():
    """Particles at one place are sampled as they are numbered."""
    head = np.zeros((3, 5), np.float32)
    _, pixels = sampled(Streaks(head, head_radius=0.5), Streaks(head, head_radius=0.4, blend="add"))
    for *_, particle in pixels:
        assert list(particle) == sorted(particle)


@pytest.mark.parametrize("size", [(1, 1), (7, 15), (8, 16), (9, 33), (200, 3)])
def test_pictures_of_any_size(size):
    """Bands hold the picture's pixels and no others."""
    made, pixels = sampled(streaks(7, 100, radius=(0.1, 0.5)), size=size)
    np.testing.assert_allclose(flattened(pixels), made.pixels.reshape(-1, 4), atol=2e-6)


def test_threads_change_no_bit():
    """One thread and five give the same samples."""
    streams = streaks(8, 200), comets(9, 50, blend="add")
    one, five = (sampled(*streams, threads=threads)[1] for threads in (1, 5))
    for a, b in zip(one, five, strict=True):
        for left, right in zip(a, b, strict=True):
            np.testing.assert_array_equal(left, right)


def test_sampling_leaves_the_picture_as_it_is():
    """The film has the same bytes with samples and without."""
    streams = streaks(10), comets(11, blend="add")
    assert sampled(*streams)[0].pixels.tobytes() == film(*streams).pixels.tobytes()


def test_reference_agrees():
    """What the samples flatten to is what brute force gives."""
    streams = streaks(12, falloff="gaussian"), comets(13, streak="solid")
    _, pixels = sampled(*streams)
    np.testing.assert_allclose(flattened(pixels), reference(streams, CAMERA, None, WIDTH, HEIGHT)[0].reshape(-1, 4), atol=1e-5)


def fold(opacity, depth=None, particle=None):
    """Fold one pixel; return its nearest depth and its strongest particle."""
    nearest, strongest = np.full(1, np.inf, np.float32), np.full(1, NOTHING, np.int32)
    count = len(opacity)
    fold_samples(
        np.array([0, count]), np.asarray(depth or range(1, count + 1), np.float32), np.asarray(opacity, np.float32),
        np.asarray(particle or range(count), np.int32), nearest, strongest,
    )
    return float(nearest[0]), int(strongest[0])


@pytest.mark.parametrize(("opacity", "nearest", "strongest"), [
    ([], np.inf, NOTHING),
    ([0.5, 0.5], 1, 0),  # 0.5, 0.25
    ([0.25, 0.75], 1, 1),  # 0.25, 0.5625
    ([0.5, 1.0], 1, 0),  # 0.5, 0.5: the nearest among equals
    ([1.0, 1.0, 1.0], 1, 0),
    ([-0.5, 0.6], 1, 1),  # flames hide nothing: 0.5, 0.6
    ([0.0, 0.25], 2, 1),  # what is not there is not seen
    ([0.0, -0.0], np.inf, NOTHING),
])
def test_nearest_and_strongest(opacity, nearest, strongest):
    """The nearest of what is seen, and the particle seen most."""
    assert fold(opacity) == (nearest, strongest)


def test_nothing_to_sample():
    """An empty picture has bands without samples."""
    _, pixels = sampled(Streaks(np.zeros((3, 0), np.float32)), camera=Camera())
    assert all(len(depth) == 0 for depth, *_ in pixels)


@CAMERAS
@pytest.mark.parametrize("opacity", [1.0, 0.6])
def test_polygons_among_particles(camera, opacity):
    """Samples with polygons flatten to the picture, edges and crossings too; polygons are no particle."""
    polygons = [triangles(7, 12, opacity=opacity, color_map=picture(5, opaque=True)), triangles(8, 6)]
    streams = [streaks(1), comets(2, blend="add")]
    made, pixels = sampled(*streams, camera=camera, polygons=polygons, lighting=LIGHTING)
    np.testing.assert_allclose(flattened(pixels), made.pixels.reshape(-1, 4), atol=5e-6)
    numbers = np.concatenate([particle for *_, particle in pixels])
    assert numbers.min() == NOTHING and numbers.max() < 120
    for depth, opacities, _, particle in pixels:
        assert (np.diff(depth) >= 0).all() and (opacities[particle == NOTHING] >= 0).all() and (opacities <= 1).all()


def test_two_triangles_that_share_an_edge_hide_all():
    """What one covers of a pixel and what the other covers are together the whole, also in samples."""
    corners = np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], float)
    wall = Polygons(corners, np.array([[0, 1, 2], [0, 2, 3]]), shading="unlit")
    _, pixels = sampled(streaks(1), polygons=[wall])
    np.testing.assert_allclose(flattened(pixels)[:, 3], 1, atol=1e-6)
    assert max(len(depth) for depth, *_ in pixels) > 1


def test_memory_changes_no_sample():
    """Made patch by patch, samples are the same to the bit, with polygons and without."""
    polygons = [triangles(9, 12), triangles(10, 6, opacity=0.5)]
    for given in ({}, {"polygons": polygons}):
        streams = streaks(8, 60000, radius=(0.01, 0.05)), comets(9, 500, blend="add")
        whole, parts = (sampled(*streams, memory=memory, **given)[1] for memory in (np.inf, 1))
        for a, b in zip(whole, parts, strict=True):
            for left, right in zip(a, b, strict=True):
                np.testing.assert_array_equal(left, right)
