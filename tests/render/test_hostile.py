"""Whatever finite numbers a scene is made of, the film is finite, and alpha between 0 and 1."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.render.camera import Camera
from graphfx.render.streaks import Streaks

from .scenes import film


def wild(draw, *shape):
    """Return numbers of every magnitude of float32, half of them ordinary."""
    extreme = draw.choice([-1, 1], shape) * 10.0 ** draw.uniform(-38, 38, shape)
    return np.where(draw.random(shape) < 0.5, extreme, draw.normal(0, 2, shape)).astype(np.float32)


def wild_streaks(draw, count: int) -> Streaks:
    """Return particles in which nothing is reasonable."""
    return Streaks(
        wild(draw, 3, count), wild(draw, 3, count), wild(draw, count), wild(draw, count),
        wild(draw, 3, count), wild(draw, 3, count), wild(draw, count), wild(draw, count), wild(draw, count),
        blend=str(draw.choice(["over", "add"])), falloff=str(draw.choice(["linear", "gaussian", "disc"])),
        streak=str(draw.choice(["exposed", "solid"])),
    )


def wild_cameras(draw) -> tuple[Camera, Camera]:
    """Return a camera of deep perspective and one of a wide view, their planes anywhere."""
    perspective = Camera(near=10.0 ** draw.uniform(-12, 0), far=10.0 ** draw.uniform(1, 300))
    return perspective, Camera(projection="orthographic", view_width=10.0 ** draw.uniform(-3, 3), near=-1e30, far=np.inf)


@pytest.mark.parametrize("seed", range(8))
def test_film_is_finite(seed):
    """Positions, radii, colours, planes of any size; the deepest perspective, the widest view."""
    draw = np.random.default_rng(seed)
    for _ in range(20):
        for camera in wild_cameras(draw):
            got = film(wild_streaks(draw, 30), wild_streaks(draw, 30), camera=camera, size=(40, 30))
            assert np.isfinite(got.pixels).all() and got.dropped == 0
            assert got.pixels[..., 3].min() >= 0.0 and got.pixels[..., 3].max() <= 1.0


@pytest.mark.parametrize("seed", range(4))
def test_film_of_pieces_out_of_focus_is_finite(seed):
    """Joints to anywhere, parts of nothing, moments beyond the shutter, lenses as wide as a house."""
    draw = np.random.default_rng(seed + 100)
    for _ in range(20):
        opened = [
            Camera(near=10.0 ** near, f_stop=10.0 ** draw.uniform(-30, 3), focus_distance=10.0 ** draw.uniform(-1, 30))
            for near in draw.uniform(-9, 0, 2)
        ]
        scene = wild_streaks(draw, 30)
        scene.part, scene.joined = wild(draw, 30), draw.integers(0, 4, 30).astype(np.float32)
        scene.ahead, scene.behind = wild(draw, 3, 30), wild(draw, 3, 30)
        scene.head_moment, scene.tail_moment, scene.ahead_moment = draw.random(30), draw.random(30), draw.random(30)
        got = film(scene, camera=opened[0], tail_camera=opened[1], size=(40, 30))
        assert np.isfinite(got.pixels).all()
        assert got.pixels[..., 3].min() >= 0.0 and got.pixels[..., 3].max() <= 1.0
