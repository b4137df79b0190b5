"""Cameras as they stand at a time."""

from __future__ import annotations

from graphfx.errors import GraphError, Problem
from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Keys, Literal, Value
from graphfx.motion.clock import Clock
from graphfx.plan.make import Plan
from graphfx.plan.pictures import ImagePlan, value_at
from graphfx.render.camera import Camera

MOST_TRIED = 1000
"""Frames that are tried before any work."""


def camera_at(node: FlatNode, time: float, frame: int, cuts: float | None = None) -> Camera:
    """Return a camera as it stands at a time; raise GraphError where it cannot be.

    What `step` keys give is taken at the time `cuts`, if that is given: a cut is no motion.
    """
    def moment(value: Value) -> float:
        return cuts if cuts is not None and isinstance(value, Keys) and value.interpolation == "step" else time

    given = {name: value_at(node, name, moment(value), frame) for name, value in node.arguments.items()}
    try:
        return Camera(**given)
    except ValueError as error:
        raise GraphError(Problem(f"at {time:g} s {error}", node.location, f"nodes.{node.path}")) from None


def check_views(plan: Plan) -> None:
    """Raise GraphError with the first time at which each camera, picture, light and surface cannot be, before any work."""
    time, problems = plan.flat.time, []
    clock = Clock(time.fps, time.first, time.preroll)
    step = (time.last - time.first) // MOST_TRIED + 1
    frames = range(time.first, time.last + 1, step)
    cameras = {image.camera.path: image.camera for image in plan.images}
    for path, node in (cameras | {each.path: each for image in plan.images for each in _shown(image)}).items():
        changing = [name for name, value in node.arguments.items() if not isinstance(value, Literal)]
        for frame in frames if changing or path in cameras else ():
            try:
                for name in changing:
                    value_at(node, name, clock.time_of(frame), frame)
                if path in cameras:
                    camera_at(node, clock.time_of(frame), frame)
            except GraphError as error:
                problems += error.problems
                break
    if problems:
        raise GraphError(problems)


def _shown(image: ImagePlan) -> list[FlatNode]:
    return [image.node, *image.polygons, *image.lights]
