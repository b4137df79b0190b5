"""The renderer gives what brute force gives."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.pending import CAPACITY
from graphfx.render.streaks import Streaks

from .reference import exact_keys, keys_of, project, reference
from .scenes import CAMERA, FLAT, HEIGHT, WIDTH, comets, film, streaks

TOLERANCE = 1e-5
LOOKS = [(f, s) for f in ("linear", "gaussian", "disc") for s in ("exposed", "solid")]


def hold(*streams, camera=CAMERA, tail_camera=None, size=(WIDTH, HEIGHT), tolerance=TOLERANCE):
    """Assert that a render equals the reference; return both films."""
    got = film(*streams, camera=camera, tail_camera=tail_camera, size=size)
    pixels, fragments, dropped = reference(streams, camera, tail_camera, *size)
    np.testing.assert_allclose(got.pixels, pixels, rtol=0, atol=tolerance)
    assert got.dropped == dropped
    assert abs(got.fragments - fragments) <= 2 + fragments // 2000
    return got, pixels


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_streaks_of_every_look(camera, falloff, streak):
    """Every falloff and way of streaking, under both projections."""
    got, _ = hold(streaks(1, falloff=falloff, streak=streak), camera=camera)
    assert got.fragments > 1000


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_comets(camera, falloff, streak):
    """Radius, colour and opacity run from head to tail, linear along the streak in space."""
    hold(comets(2, falloff=falloff, streak=streak), camera=camera)


def test_streams_over_and_add_are_sorted_together():
    """Fragments of four streams, two of them flames, lie between each other."""
    hold(streaks(3), comets(4, blend="add"), streaks(5, falloff="disc", streak="solid"), streaks(6, blend="add"))


@pytest.mark.parametrize("streak", ["exposed", "solid"])
def test_streaks_through_the_near_and_far_plane(streak):
    """A streak is cut at the planes, with what it has there."""
    camera = Camera(position=(0, 0, 1.0), lens=30.0, near=0.25, far=2.0)
    hold(comets(7, 150, streak=streak, length=0.8), streaks(8, 50, streak=streak, length=1.5), camera=camera)


def test_streaks_past_the_camera_are_exact_however_long():
    """Cut at a near plane of 1 mm, streaks are 10^5 pixels long and as wide."""
    camera = Camera(position=(0, 0, 0.2), target=(0, 0, -1), near=0.001)
    hold(streaks(9, 80, length=1.0, radius=(0.001, 0.01), spread=1.0, streak="solid"), camera=camera)


def test_streaks_of_a_million_pixels():
    """A long streak is as exact as a short one."""
    draw = np.random.default_rng(10)
    through, way = draw.uniform(-2, 2, (3, 30)), draw.normal(0, 2e5, (3, 30))
    way[2] *= 1e-5
    head, tail = (through - way).astype(np.float32), (through + 0.7 * way).astype(np.float32)
    hold(Streaks(head, tail, 0.1, streak="solid", head_opacity=0.5), camera=FLAT)


def test_streaks_that_widen_to_a_hundred_thousand_pixels():
    """Seen where they are thin, thousands of pixels from an end, they are as exact as if they stayed so."""
    camera, draw = Camera(projection="orthographic", view_width=64.0, position=(0, 0, 10)), np.random.default_rng(24)
    for _ in range(20):
        through, angle, length = draw.uniform(-20, 20, (3, 1)), draw.uniform(0, 6.28), 1e5 * 10 ** draw.uniform(3, 4.5)
        along, before = np.array([[np.cos(angle)], [np.sin(angle)], [0]]), length * 10 ** draw.uniform(-4, -2)
        through[2] = 0
        head, tail = (through - before * along).astype(np.float32), (through + length * along).astype(np.float32)
        hold(Streaks(head, tail, 2.0, 1e5, streak="solid", head_opacity=0.5), camera=camera, tolerance=2e-6)


@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_particles_smaller_than_a_pixel(falloff, streak):
    """Radii from a hundredth of a pixel, still and moving."""
    hold(
        streaks(11, 80, radius=(0.001, 0.06), length=0.1, falloff=falloff, streak=streak),
        streaks(12, 20, radius=(0.001, 0.06), length=1.0, falloff=falloff, streak=streak),
    )


def test_particles_that_do_not_move():
    """A streak of no length is a disc, with a tail or without."""
    still = streaks(13, length=0.0)
    hold(still)
    alone = Streaks(still.head, None, still.head_radius, head_color=still.head_color, head_opacity=still.head_opacity)
    assert film(alone).pixels.tobytes() == film(still).pixels.tobytes()


def test_particles_off_the_picture():
    """What is outside, beside or behind, gives nothing; what reaches in gives its part."""
    hold(streaks(14, 200, spread=8.0, radius=(0.01, 2.0)))


def test_numbers_that_are_not_finite_are_dropped_and_counted():
    """NaN or infinity in any column drops its particle, and no other."""
    scene = comets(15, 20)
    bad = [(scene.head, 1, 3), (scene.tail, 2, 5), (scene.head_color, 0, 7), (scene.tail_color, 1, 9)]
    for (array, row, i), number in zip(bad, (np.nan, np.inf, -np.inf, np.nan), strict=True):
        array[row, i] = number
    for i, array in enumerate((scene.head_radius, scene.tail_radius, scene.head_opacity, scene.tail_opacity, scene.share)):
        array[10 + i] = np.nan
    got, _ = hold(scene)
    assert got.dropped == 9


def test_radii_of_nothing_and_of_a_million_pixels():
    """A radius of 0 or less draws nothing; one of 10^6 pixels fills the picture."""
    scene = streaks(16, 8)
    scene.head_radius = np.array([0, -1, 2e5, 1e5, 0.1, 0.2, 3e4, 1e30], np.float32)
    hold(scene)
    nothing = film(streaks(16, 8, head_radius=0.0))
    assert nothing.fragments == 0 and not nothing.pixels.any()


def test_equal_depths_are_ordered_by_stream_and_particle():
    """Many particles in one plane square to the view: nothing but their order decides."""
    scene = streaks(17, 100, length=0.0, radius=(0.3, 0.6))
    scene.head[2] = scene.tail[2] = 0.5
    camera = Camera(position=(0, 0, 6.0))
    hold(scene, camera=camera)
    first, second = (Streaks(np.zeros((3, 1), np.float32), None, 0.5, head_color=c) for c in ((1, 0, 0), (0, 1, 0)))
    ahead = film(first, second, camera=camera).pixels
    assert (ahead[..., 0] >= ahead[..., 1]).all() and ahead[..., 0].max() > 0.5


def test_streaks_in_one_place_are_ordered_by_particle():
    """Streaks that slope in depth and lie in each other, fifty times three: all their fragments tie."""
    scene = streaks(30, 150, length=1.5, radius=(0.1, 0.5), streak="solid")
    for column in (scene.head, scene.tail, scene.head_radius):
        column[..., 50:] = np.concatenate([column[..., :50]] * 2, axis=-1)
    hold(scene)


def test_ties_keep_their_order_when_something_comes_before_them():
    """Three equal slopes, then a streak that is nearer than half of each."""
    camera = Camera(projection="orthographic", view_width=64.0)
    head = np.float32([[-20] * 4, [0] * 4, [0, 0, 0, 4.9]])
    tail = np.float32([[20] * 4, [0] * 4, [5, 5, 5, 4.9]])
    colors = np.float32([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]])
    hold(Streaks(head, tail, 4.0, head_color=colors, head_opacity=0.5, streak="solid"), camera=camera, size=(64, 32))


@pytest.mark.parametrize("count, seed", [(CAPACITY + 30, 18), (700, 19)])
def test_streaks_that_pierce_each_other_deeply(count, seed):
    """Where more fragments are pending than a list holds, the group is sorted whole, to the same order."""
    scene = comets(seed, count, radius=(0.2, 0.6), length=0.0, spread=1.0)
    scene.tail = scene.head.copy()
    scene.head[2], scene.tail[2] = 3.0, -20.0
    scene.tail[:2] += np.random.default_rng(seed).normal(0, 3, (2, count)).astype(np.float32)
    scene.head_opacity = scene.tail_opacity = 0.05
    hold(scene, streaks(seed, 50), streaks(seed + 1, 20, blend="add"), size=(19, 17))


def test_camera_that_moves_while_the_shutter_is_open():
    """Heads are seen by the camera of the shutter's end, tails by that of its opening."""
    opening = Camera(position=(0.5, 0.1, 5.0), target=(0.0, 0.2, 0.0), lens=35.0)
    hold(comets(20), tail_camera=opening)


@pytest.mark.parametrize("size", [(1, 1), (8, 16), (9, 17), (64, 3)])
def test_sizes_of_pictures(size):
    """Pictures of a pixel, of a tile, of a tile and a little."""
    hold(streaks(21, 40), size=size)


def test_crowd():
    """A thousand particles, pixels forty deep on average."""
    got, _ = hold(streaks(22, 1000, radius=(0.2, 0.6), head_opacity=0.3, spread=1.0), size=(40, 32))
    assert got.fragments > 40 * 40 * 32


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
def test_keys_are_depths_to_float32(camera):
    """The float32 key of a fragment is its depth's to a few roundings of the greater key near it."""
    scene = streaks(23, 80, length=3.0)
    worst = 0.0
    for i in range(80):
        segment = project(scene, i, camera, camera, WIDTH, HEIGHT)
        if segment is not None:
            exact, got = exact_keys(segment, 8.5, 16.5), keys_of(segment, 8.5, 16.5)
            near = segment.at(*np.meshgrid(8.5 + np.arange(8.0), 16.5 + np.arange(16.0)))[2]
            scale = np.abs(np.float64(segment.key)).max()
            worst = max(worst, (np.abs(exact - got) * near).max() / scale)
    assert worst < 1e-6
