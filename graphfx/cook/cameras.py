"""Cameras as they stand at a time."""

from __future__ import annotations

from graphfx.errors import GraphError, Problem
from graphfx.graph.flat import FlatNode
from graphfx.motion.clock import Clock
from graphfx.plan.make import Plan
from graphfx.plan.pictures import plain_value
from graphfx.render.camera import Camera

MOST_TRIED = 1000
"""Frames at which a camera is tried before any work."""


def camera_at(node: FlatNode, time: float, frame: int) -> Camera:
    """Return a camera as it stands at a time; raise GraphError where it cannot be."""
    given = {name: plain_value(value, time, frame) for name, value in node.arguments.items()}
    given["width_of_view"] = given.pop("view_width")
    try:
        return Camera(**given)
    except ValueError as error:
        raise GraphError(Problem(f"at {time:g} s {error}", node.location, f"nodes.{node.path}")) from None


def check_cameras(plan: Plan) -> None:
    """Raise GraphError with the first time at which each camera cannot be, before any work."""
    time, problems = plan.flat.time, []
    clock = Clock(time.fps, time.first, time.preroll)
    step = (time.last - time.first) // MOST_TRIED + 1
    for node in {image.camera.path: image.camera for image in plan.images}.values():
        for frame in range(time.first, time.last + 1, step):
            try:
                camera_at(node, clock.time_of(frame), frame)
            except GraphError as error:
                problems += error.problems
                break
    if problems:
        raise GraphError(problems)
