"""Quick pictures: lines have the light that they should have, wherever they lie, in any order, on any number of threads."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.lines import draw_lines
from graphfx.render.streaks import Streaks

from .scenes import CAMERA, comets, streaks
from .test_hostile import wild_cameras, wild_streaks

WIDTH, HEIGHT = 96, 64
PIXELS = Camera(position=(WIDTH / 2, HEIGHT / 2, 0.0), target=(WIDTH / 2, HEIGHT / 2, 1.0), up=(0.0, -1.0, 0.0),
                projection="orthographic", view_width=WIDTH, near=-10.0)
"""A metre is a pixel, x to the right and y down."""
LIGHT = 1e-4
"""Largest error of a line's total light, relative: that of float32 places in a picture."""


def line(head, tail, **look) -> Streaks:
    return Streaks(np.array([[*head, 1.0]], np.float32).T, np.array([[*tail, 1.0]], np.float32).T, **look)


def drawn(*streams: Streaks, camera: Camera = PIXELS, threads: int = 1, size=(WIDTH, HEIGHT)):
    return draw_lines(list(streams), camera, None, *size, threads)


@pytest.mark.parametrize("seed", range(20))
def test_light_is_length_and_one_times_opacity(seed):
    """Whatever its direction, place and length, the pixels of a line sum to its opacity times its length and one."""
    draw = np.random.default_rng(seed)
    middle, opacity = draw.uniform(25, 39, 2), draw.uniform(0.1, 1)
    angle = seed % 8 * np.pi / 4 if seed < 8 else draw.uniform(0, 2 * np.pi)
    length = 10.0 ** draw.uniform(-4, np.log10(40))
    way = length / 2 * np.array([np.cos(angle), np.sin(angle)])
    alpha = drawn(line(middle + way, middle - way, head_opacity=opacity)).pixels[..., 3]
    assert alpha.sum(dtype=float) == pytest.approx(opacity * (length + 1), rel=LIGHT)
    assert alpha.max() <= opacity * (1 + 1e-6)


def test_dot_where_nothing_moves():
    """Where head and tail are one, the dot has the light of one pixel, about its place."""
    alpha = drawn(line((20.25, 30.75), (20.25, 30.75))).pixels[..., 3].astype(float)
    rows, columns = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    assert alpha.sum() == pytest.approx(1.0, rel=LIGHT)
    assert ((alpha * columns).sum(), (alpha * rows).sum()) == pytest.approx((20.25, 30.75), abs=1e-4)


def test_pieces_of_a_way():
    """Two pieces that go on in one another are the line that they are parts of."""
    head, knee, tail = (60.3, 40.1), (31.7, 28.4), (11.2, 20.0135)
    whole = drawn(line(head, tail, head_opacity=0.5)).pixels[..., 3]
    first, second = line(head, knee, head_opacity=0.5, joined=2.0), line(knee, tail, head_opacity=0.5, joined=1.0)
    parts = drawn(first, second).pixels[..., 3]
    assert parts.sum(dtype=float) == pytest.approx(whole.sum(dtype=float), rel=2e-3)
    assert np.abs(parts - whole).max() < 0.15


def test_ends_are_seen_at_their_moments():
    """A point seen between the two cameras is where it is half way between what they see."""
    moved = Camera(**{**vars(PIXELS), "position": (WIDTH / 2 + 8, HEIGHT / 2, 0.0), "target": (WIDTH / 2 + 8, HEIGHT / 2, 1.0)})
    for moment, x in ((0.0, 40.5), (0.5, 36.5), (1.0, 32.5)):
        still = line((40.5, 20.5), (40.5, 20.5), head_moment=moment, tail_moment=moment)
        alpha = draw_lines([still], PIXELS, moved, WIDTH, HEIGHT).pixels[..., 3]
        assert alpha[20, int(x)] == pytest.approx(1.0, abs=1e-5)


def test_no_flicker():
    """A dot that moves by parts of a pixel keeps its light to a thousandth."""
    places = [(20 + 0.037 * k, 30 + 0.013 * k) for k in range(40)]
    totals = [drawn(line(place, place)).pixels[..., 3].sum(dtype=float) for place in places]
    assert max(totals) - min(totals) < 1e-3


def test_one_line_is_over():
    """A pixel that one line covers holds its colour times alpha, and alpha."""
    pixels = drawn(line((10.5, 20.5), (80.5, 20.5), head_color=(0.2, 0.4, 0.8), head_opacity=0.5)).pixels
    assert pixels[20, 40] == pytest.approx([0.1, 0.2, 0.4, 0.5], rel=1e-5)


def test_lines_cover_and_mix():
    """Two lines over a pixel cover it as two layers would, and it has their mean colour; so in any order."""
    red = line((10.5, 20.5), (80.5, 20.5), head_color=(1.0, 0.0, 0.0), head_opacity=0.5)
    blue = line((40.5, 5.5), (40.5, 50.5), head_color=(0.0, 0.0, 1.0), head_opacity=0.5)
    one, other = drawn(red, blue).pixels[20, 40], drawn(blue, red).pixels[20, 40]
    assert one == pytest.approx([0.375, 0.0, 0.375, 0.75], rel=1e-5)
    assert other == pytest.approx(one, rel=1e-6)


def test_added_light_covers_nothing():
    """A line that adds leaves what others cover as it is, and adds its light."""
    red = line((10.5, 20.5), (80.5, 20.5), head_color=(1.0, 0.0, 0.0), head_opacity=0.5)
    flame = line((40.5, 5.5), (40.5, 50.5), head_color=(0.0, 4.0, 0.0), head_opacity=0.5, blend="add")
    assert drawn(red, flame).pixels[20, 40] == pytest.approx([0.5, 2.0, 0.0, 0.5], rel=1e-5)
    assert drawn(flame).pixels[20, 40, 3] == 0.0


def test_part_outside_is_cut_away():
    """What of a line lies outside leaves no trace, and what lies inside is as it was."""
    far = drawn(line((40.5, 20.5), (1e7, 20.5))).pixels
    near = drawn(line((40.5, 20.5), (WIDTH + 5.5, 20.5))).pixels
    assert np.allclose(far, near, atol=1e-5)
    for head, tail in (((-5, 20), (-500, 20)), ((40, -5), (90, -80)), ((-30, 50), (40, 200)), ((200, 10), (400, 12))):
        assert drawn(line(head, tail)).fragments == 0


@pytest.mark.parametrize("size", [(1, 1), (3, 200), (200, 3)])
def test_any_size(size):
    """Thin pictures are filled to their edges: a line across all of it is in every column."""
    width, height = size
    camera = Camera(position=(width / 2, height / 2, 0.0), target=(width / 2, height / 2, 1.0), up=(0.0, -1.0, 0.0),
                    projection="orthographic", view_width=width, near=-10.0)
    across = drawn(line((-10, height / 2), (width + 10, height / 2)), camera=camera, size=size).pixels[..., 3]
    assert across.sum(axis=0) == pytest.approx(np.ones(width), rel=1e-5) or height == 1


def test_nothing_behind_the_camera():
    """Behind the camera nothing is drawn; a line through the near plane is drawn as far as that."""
    behind = Streaks(np.array([[0.0], [0.0], [8.0]], np.float32), np.array([[0.1], [0.0], [9.0]], np.float32))
    assert drawn(behind, camera=CAMERA).fragments == 0
    through = Streaks(np.array([[0.3], [0.2], [0.0]], np.float32), np.array([[0.5], [0.2], [30.0]], np.float32))
    stops = Streaks(through.head, np.array([[0.3 + 0.2 * 5.99 / 30], [0.2], [5.99]], np.float32))
    assert np.allclose(drawn(through, camera=CAMERA).pixels, drawn(stops, camera=CAMERA).pixels, atol=2e-3)


def test_what_is_not_finite_is_dropped():
    """A particle with a number that is not finite is left out and counted; the others are drawn as ever."""
    good = streaks(1, 50)
    alone = drawn(good, camera=CAMERA)
    for name, column in (("head", (0, 7)), ("tail", (2, 9)), ("head_color", (1, 3)), ("head_opacity", (5,))):
        for value in (np.nan, np.inf, -np.inf):
            bad = streaks(1, 50)
            getattr(bad, name)[column] = value
            film = drawn(bad, camera=CAMERA)
            assert film.dropped == 1 and np.isfinite(film.pixels).all() and film.fragments < alone.fragments


def test_threads_change_no_byte():
    """Any number of threads gives the same picture to the last bit, and counts the same fragments."""
    streams = streaks(4, 30_000, spread=3.0), comets(5, 9000), streaks(6, 5000, blend="add")
    one = drawn(*streams, camera=CAMERA)
    for threads in (2, 3, 8):
        film = drawn(*streams, camera=CAMERA, threads=threads)
        assert film.pixels.tobytes() == one.pixels.tobytes()
        assert film.fragments == one.fragments


def test_nothing_to_draw():
    """No streams, and a stream of no particles, give an empty film."""
    assert not drawn().pixels.any() and not drawn(Streaks(np.zeros((3, 0), np.float32))).pixels.any()


@pytest.mark.parametrize("seed", range(4))
def test_film_is_finite(seed):
    """Whatever finite numbers a scene is made of, the film is finite, and alpha between 0 and 1."""
    draw = np.random.default_rng(seed)
    for _ in range(20):
        for camera in wild_cameras(draw):
            film = drawn(wild_streaks(draw, 30), wild_streaks(draw, 30), camera=camera, size=(40, 30))
            assert np.isfinite(film.pixels).all() and film.dropped == 0
            assert film.pixels[..., 3].min() >= 0.0 and film.pixels[..., 3].max() <= 1.0
