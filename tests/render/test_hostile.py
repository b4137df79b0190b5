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


@pytest.mark.parametrize("seed", range(8))
def test_film_is_finite(seed):
    """Positions, radii, colours, planes of any size; the deepest perspective, the widest view."""
    draw = np.random.default_rng(seed)
    for _ in range(20):
        perspective = Camera(near=10.0 ** draw.uniform(-12, 0), far=10.0 ** draw.uniform(1, 300))
        flat = Camera(projection="orthographic", width_of_view=10.0 ** draw.uniform(-3, 3), near=-1e30, far=np.inf)
        for camera in (perspective, flat):
            got = film(wild_streaks(draw, 30), wild_streaks(draw, 30), camera=camera, size=(40, 30))
            assert np.isfinite(got.pixels).all() and got.dropped == 0
            assert got.pixels[..., 3].min() >= 0.0 and got.pixels[..., 3].max() <= 1.0
