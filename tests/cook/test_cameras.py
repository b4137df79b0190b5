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


CUT = {"keys": [[0, [0, 0, 9]], [0.45, [4, 0, 9]]], "interpolation": "step"}


def test_a_cut_is_no_motion():
    """Where step keys move the camera while the shutter is open, nothing streaks: it is seen from the new place alone."""
    emit = {"rate": 0, "count": 30, "set": {"position": {"in_sphere": {}}, "velocity": [0, 0, 0], "radius": 0.1}}

    def film(position, frame):
        eye = {"eye": {"type": "camera", "position": position}}
        return made([], emit, TIME, {"camera": "eye", "shutter": 1}, eye).film(frame).pixels

    for frame, place in ((5, [0, 0, 9]), (6, [4, 0, 9]), (7, [4, 0, 9])):
        np.testing.assert_array_equal(film(CUT, frame), film(place, frame))


@pytest.mark.parametrize(
    "nodes, message",
    [
        ({"frames": {"shutter": {"expr": "log(-1 - time)"}}}, "shutter is nan; it must be finite"),
        ({"frames": {"phase": {"expr": "40 * time"}}}, "phase must lie between 0 and 4"),
        ({"frames": {"exposure": {"expr": "log(0.45 - time)"}}}, "at 0.5 s, frame 6, exposure is nan; it must be finite"),
        ({"frames": {"background": {"expr": "vec(0.25 - time, 0, 0)"}}}, "at 0.3 s, frame 4, -0.05 is out of range"),
        ({"eye": {"lens": {"expr": "30 - 100 * time"}}}, "at 0.3 s, frame 4, 0 is out of range; lens must lie between 1 and"),
        ({"lamp": {"color": {"expr": "vec(0 / time, 1, 1)"}}}, "color is nan, 1, 1; it must be finite"),
        ({"ball": {"opacity": {"expr": "1 - 2 * time"}}}, "at 0.6 s, frame 7, -0.2 is out of range; opacity must lie between 0"),
    ],
)
def test_what_expressions_of_time_may_not_be_is_told_before_any_work(nodes, message):
    """Not a number, infinite, or beyond what numbers and keys may be: told with the place, and the first time."""
    given = {
        "eye": {"type": "camera"}, "lamp": {"type": "light"}, "round": {"type": "mesh_sphere"},
        "ball": {"type": "polygons", "geometry": "round"},
    }
    for name, more in nodes.items():
        if name != "frames":
            given[name] = given[name] | more
    frames = {"from": ["sky", "ball"], "lights": ["lamp"], "camera": "eye"} | nodes.get("frames", {})
    with pytest.raises(GraphError) as told:
        made([], {}, TIME, frames, given).simulation()
    assert message in str(told.value) and "nodes." in str(told.value)


def test_splines_are_kept_in_range():
    """Keys in range whose spline swings beyond it are no mistake: it is brought back."""
    keys = {"keys": [[0, 0], [0.3, 0], [0.4, 4], [1, 4]], "interpolation": "spline"}
    effect = made([], {}, TIME, {"shutter": keys})
    effect.simulation()
    assert max(effect.plan.images[0].value("shutter", t / 50, 1) for t in range(51)) == 4.0


def test_rounding_is_no_mistake():
    """An expression that ends at its bound but for rounding is at its bound."""
    effect = made([], {}, TIME, {"cutoff": {"expr": "(1 - time) * 0.5 - 0.0000001"}})
    effect.simulation()
    assert effect.plan.images[0].value("cutoff", 1.0, 11) == 0.0
