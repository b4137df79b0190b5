"""Cameras that change with time, and those that cannot be."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.cameras import camera_at
from graphfx.cook.checks import problems_before
from graphfx.errors import GraphError

from .effects import made

TIME = {"fps": 10, "frames": [1, 11]}


def seen_by(**camera):
    """Return an effect seen by a camera."""
    return made([], {}, TIME, {"camera": "eye"}, {"eye": {"type": "camera", **camera}})


@pytest.mark.parametrize(
    "camera, message",
    [
        ({"near": {"expr": "1 + time"}, "far": 1.45}, "nodes.eye: at 0.5 s near is 1.5, far 1.45; near must be less than far"),
        ({"f_stop": 2, "projection": "orthographic"}, "nodes.eye: at 0 s f_stop is for perspective alone"),
        ({"f_stop": 2, "focus_distance": {"keys": [[0, 1], [1, 0.01]]}}, "nodes.eye: at 1 s focus_distance is 0.01 m; it must"),
    ],
)
def test_cameras_that_cannot_be_are_told_before_any_work(camera, message):
    """With the place in the graph and the first time at which they cannot."""
    found = seen_by(**camera)
    with pytest.raises(GraphError) as told:
        found.simulation()
    assert message in str(told.value)
    assert [str(problem) for problem in problems_before(found.plan)] == [str(problem) for problem in told.value.problems]


def test_every_number_of_a_camera_may_change():
    """By keys along a spline, and by expressions of time and frame."""
    path = [[0, 0, 9], [1, 2, 6], [3, 2, 3], [6, 0, 0]]
    found = seen_by(
        position={"keys": [[k / 3, point] for k, point in enumerate(path)], "interpolation": "spline"},
        target={"expr": "vec(0, time, 0)"}, up={"expr": "vec(sin(time), cos(time), 0)"}, lens={"expr": "30 + frame"},
        focus_distance={"keys": [[0, 2], [1, 4]]}, f_stop=4,
    )
    node = found.plan.images[0].camera
    for k, point in enumerate(path):
        np.testing.assert_allclose(camera_at(node, k / 3, 1).position, point, rtol=0, atol=1e-12)
    between = camera_at(node, 0.5, 6)
    assert between.lens == 36 and between.focus_distance == pytest.approx(3) and between.target == (0, 0.5, 0)
    np.testing.assert_allclose(between.up, [np.sin(0.5), np.cos(0.5), 0], atol=1e-6)
    assert between.position[1] > 2.1
