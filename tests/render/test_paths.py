"""Paths of many pieces: their light, and that they are one body."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.falloff import FALLOFFS
from graphfx.render.renderer import render
from graphfx.render.scene import make_scene
from graphfx.render.streaks import Streaks

from .scenes import CAMERA, FLAT, film, path
from .test_against_reference import LOOKS, hold

PIXELS = Camera(projection="orthographic", view_width=128.0, position=(0, 0, 10))
SIZE = (128, 64)
KINDS = ("few", "one tiny", "some tiny", "many")


def _moments(draw: np.random.Generator, kind: str) -> np.ndarray:
    """Return where a path is cut, from 0 to 1."""
    few = {
        "few": draw.random(4), "one tiny": 0.4 + np.array([0, 1e-3]), "some tiny": 0.6 + 0.01 * draw.random(6),
        "many": draw.random(60),
    }
    return np.concatenate([[0], np.sort(few[kind]), [1]])


def _bent(draw: np.random.Generator, count: int, length: float, turn: float) -> np.ndarray:
    """Return the points (n, 3) of a path of pieces of random lengths, about the origin, that turns by up to so much at each."""
    lengths = np.abs(draw.normal(0, 1, count))
    angles = np.cumsum(draw.uniform(-0.4 * turn, turn, count))
    ways = length * lengths / lengths.sum() * np.stack([np.cos(angles), np.sin(angles), 0.1 * np.cos(3 * angles)])
    points = np.concatenate([np.zeros((3, 1)), np.cumsum(ways, axis=1)], axis=1).T
    return points - points.mean(axis=0)


def _light(scene: Streaks) -> float:
    return float(film(scene, camera=PIXELS, size=SIZE).pixels[..., 0].sum(dtype=float))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_straight_path_is_one_streak_however_it_is_cut(kind, falloff, streak):
    """In even motion, long pieces and tiny ones, thin and thick: the picture is that of one piece, to 1e-5."""
    draw = np.random.default_rng(3)
    for length, radius in ((60.0, 3.0), (60.0, 0.3), (4.0, 6.0), (1.5, 0.8), (0.4, 0.4)):
        angle = draw.uniform(0, np.pi)
        head, way = draw.uniform(-1, 1, 3), length * np.array([np.cos(angle), np.sin(angle), 0])
        head = head - way / 2
        points = [head + moment * way for moment in _moments(draw, kind)]
        look = {"falloff": falloff, "streak": streak, "head_opacity": 0.4}
        ends = points[:: len(points) - 1]
        cut, whole = (film(path(each, radius, **look), camera=PIXELS, size=SIZE).pixels for each in (points, ends))
        np.testing.assert_allclose(cut, whole, rtol=0, atol=1e-5)


def test_joint_at_the_centre_of_a_pixel_neither_loses_nor_doubles_it():
    """Whatever rounding does to where it is, from one side or from the other."""
    camera = Camera(projection="orthographic", view_width=3.3, position=(0, 0, 10))
    draw = np.random.default_rng(9)
    for _ in range(40):
        ends = draw.uniform(-8, -1), 0.0, draw.uniform(0.1, 8)
        scene = path([(x, 0.0, 0.0) for x in ends], 0.1, streak="solid", head_opacity=0.5)
        alpha = film(scene, camera=camera, size=(129, 9)).pixels[4, :, 3]
        assert alpha[64] == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize("falloff", FALLOFFS)
def test_light_of_an_exposed_path_is_that_of_a_still_particle(falloff):
    """However it bends and hurries, rests and goes on: to 2 %, on pixels of a tenth of its radius."""
    draw = np.random.default_rng(4)
    look = {"falloff": falloff, "blend": "add", "head_opacity": 0.2}
    still = _light(path([(0.2, 0.3, 0), (0.2, 0.3, 0)], 10.0, np.ones(1), **look))
    kinds = [(2, 30, 0.5, 3), (3, 40, 0, 4), (3, 6, 0.6, 0), (8, 30, 0.4, 2), (12, 8, 0.8, 3), (20, 30, 2, 1)]
    for count, length, turn, hurry in kinds:
        points = _bent(draw, count, length, turn)
        parts = np.hypot(*np.diff(points[:, :2], axis=0).T) * draw.random(count) ** hurry
        assert _light(path(points, 10.0, parts, **look)) == pytest.approx(still, rel=0.02)


@pytest.mark.parametrize("turn", [0.0, 0.3, 0.6])
def test_solid_path_is_even_along_its_axis(turn):
    """Nearer to its axis than its radius, a path of half opacity shows half opacity, whether its pieces are long or tiny."""
    draw = np.random.default_rng(5)
    x, y = np.meshgrid(np.arange(128) - 63.5, 31.5 - np.arange(64))
    for count, length in ((3, 50), (6, 50), (30, 50), (3, 6)):
        points = _bent(draw, count, length, turn / count**0.5)
        alpha = film(path(points, 6.0, streak="solid", falloff="disc", head_opacity=0.5), camera=PIXELS, size=SIZE).pixels[..., 3]
        near = [
            np.hypot(x - corner[0] - t * way[0], y - corner[1] - t * way[1])
            for corner, way in zip(points, np.diff(points, axis=0), strict=False)
            for t in [np.clip(((x - corner[0]) * way[0] + (y - corner[1]) * way[1]) / (way[:2] @ way[:2]), 0, 1)]
        ]
        np.testing.assert_allclose(alpha[np.min(near, axis=0) < 5], 0.5, rtol=0.01)


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("falloff, streak", LOOKS)
def test_paths_are_what_the_reference_says(camera, falloff, streak):
    """Of pieces long and tiny, straight on and turning, thin and thick, at even speeds and at others, behind the camera too."""
    draw = np.random.default_rng(6)
    scenes = []
    for count in (2, 3, 5, 9):
        points = _bent(draw, count, draw.uniform(1, 4), draw.uniform(0, 1)) + draw.normal(0, 0.7, 3)
        points[:, 2] += draw.uniform(-6, 8) * np.linspace(0, 1, count + 1)
        parts = np.hypot(*np.diff(points[:, :2], axis=0).T) * draw.random(count)
        scenes.append(path(
            points, draw.uniform(0.02, 0.5, count).astype(np.float32) if count == 5 else draw.uniform(0.02, 0.5), parts,
            falloff=falloff, streak=streak, head_opacity=draw.random(count, np.float32), head_color=(1.0, 0.5, 0.2),
        ))
    hold(*scenes, camera=camera)


def test_paths_out_of_focus_are_what_the_reference_says():
    """Seen by two cameras, with tails of their own."""
    draw = np.random.default_rng(7)
    points = _bent(draw, 6, 3.0, 0.5)
    ends = {name: draw.uniform(0.1, 0.3, 6).astype(np.float32) for name in ("tail_radius", "tail_opacity")}
    moments = np.linspace(0, 1, 7, dtype=np.float32)
    scene = path(points, 0.2, head_moment=moments[:-1], tail_moment=moments[1:], tail_color=(0.1, 0.9, 0.4), **ends)
    turned = Camera(position=(0.5, 0.1, 5.0), target=(0.0, 0.2, 0.0), lens=35.0, f_stop=0.02, focus_distance=5.0)
    hold(scene, camera=turned, tail_camera=CAMERA)


def _many(count: int, each: int) -> Streaks:
    """Return paths of so many pieces each."""
    draw = np.random.default_rng(8)
    points = np.cumsum(draw.normal(0, 0.05, (3, count, each + 1)), axis=2) + draw.normal(0, 1, (3, count, 1))
    head, tail = (points[..., part].reshape(3, -1).astype(np.float32) for part in (slice(-1), slice(1, None)))
    bits = np.tile((np.arange(each) > 0) + 2 * (np.arange(each) < each - 1), count)
    return Streaks(head, tail, 0.03, head_opacity=0.3, part=1 / each, joined=bits.astype(np.float32))


@pytest.mark.parametrize("threads", [2, 3, 7])
def test_no_path_is_parted_between_threads(threads):
    """Threads take whole paths, all of them together each streak once."""
    pieces = make_scene([_many(6000, 7)], CAMERA, CAMERA, 64, 64, threads, False).pieces
    assert [piece.start % 7 for piece in pieces] == [0] * threads
    assert [piece.start for piece in pieces[1:]] + [42000] == [piece.stop for piece in pieces] and pieces[0].longest == 7


@pytest.mark.parametrize("how", [{"threads": 3}, {"memory": 1 << 22}, {"memory": 1 << 22, "threads": 2}])
def test_paths_are_the_same_in_patches_and_on_threads(how):
    """To the last byte."""
    scene = [_many(12000, 3)]
    assert render(scene, CAMERA, None, 90, 70, **how).pixels.tobytes() == render(scene, CAMERA, None, 90, 70).pixels.tobytes()
