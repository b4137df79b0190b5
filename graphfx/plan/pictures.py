"""The pictures of a plan: whose particles each draws, and what it reads of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from graphfx.errors import GraphError, Problem
from graphfx.graph.flat import FlatNode, TimeSettings
from graphfx.graph.literals import out_of_range
from graphfx.graph.values import Keys, Literal, Value
from graphfx.node import INFINITY
from graphfx.plan.evaluate import timed_value
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.sources import Sources, either

READ = {
    "image": ("position", "radius", "color", "opacity", "tail.radius", "tail.color", "tail.opacity"),
    "preview": ("position", "color", "opacity"),
}
"""Attributes that a picture reads, by the role of the node that draws it."""
ROUNDING = 1e-6
"""How far beyond its range an expression may be by rounding, beside its bound."""
MOTION = 0.5
"""Frames over which velocities are taken where the shutter stays shut."""


@dataclass
class Drawn:
    """One stream of an image: a source's particles, all or those that a program selects, with how they look."""

    path: str
    looks: dict[str, Any]
    condition: Value | None = None
    selection: FrameProgram | None = None


@dataclass
class ImagePlan:
    """One image: `streams` are the particles that it draws, `polygons` and `lights` the nodes of those."""

    node: FlatNode
    camera: FlatNode
    streams: list[Drawn]
    polygons: list[FlatNode] = field(default_factory=list)
    lights: list[FlatNode] = field(default_factory=list)

    def value(self, name: str, time: float = 0.0, frame: int = 0) -> Any:
        """Return one of the image's parameters, or None where its node has no such parameter."""
        return value_at(self.node, name, time, frame) if name in self.node.arguments else None

    @property
    def size(self) -> tuple[int, int]:
        """Return its width and height in pixels."""
        width, height = (int(number) for number in self.value("size"))
        return width, height

    @property
    def channels(self) -> list[str]:
        """Return what it holds besides colour and alpha, in the order of their declaration; deep samples hold ids."""
        given = {*(self.value("channels") or ()), *(("depth", "id") if self.value("deep") else ())}
        return [name for name in self.node.node_type.parameters["channels"].choices if name in given] if given else []

    @property
    def reads(self) -> tuple[str, ...]:
        """Return the attributes that it reads of particles."""
        return (*READ[self.node.node_type.role], *(("id",) if "id" in self.channels else ()))

    def window(self, time: float = 0.0, frame: int = 0) -> tuple[float, float]:
        """Return phase and shutter of a frame [frames], none less than 0."""
        return max(float(self.value("phase", time, frame) or 0.0), 0.0), max(float(self.value("shutter", time, frame)), 0.0)

    def windows(self, time: TimeSettings) -> set[tuple[float, float]]:
        """Return phases and shutters of all frames; velocities are told over some time, also where the shutter stays shut."""
        given = [self.node.arguments[name] for name in ("phase", "shutter") if name in self.node.arguments]
        frames = (time.first,) if all(isinstance(value, Literal) for value in given) else range(time.first, time.last + 1)
        found = {self.window((frame - time.first) / time.fps, frame) for frame in frames}
        moving = {"velocity", "world_velocity"} & {*self.channels}
        return {(phase, shutter or (MOTION if moving else 0.0)) for phase, shutter in found}


@dataclass
class MoviePlan:
    """One movie, and the image whose pictures it takes."""

    node: FlatNode
    image: ImagePlan

    def value(self, name: str) -> Any:
        """Return one of the movie's parameters."""
        return plain_value(self.node.arguments[name])


def plain_value(value: Value, time: float = 0.0, frame: int = 0) -> Any:
    """Return a value that no particle has a part in; text and lists as they are."""
    if isinstance(value, Literal):
        return value.value
    return timed_value(value, time, frame)


def value_at(node: FlatNode, name: str, time: float, frame: int) -> Any:
    """Return a node's parameter at a time; raise GraphError where it is no number, or out of its range.

    Keys are in range: what a spline through them has beyond it is brought back, and so is what rounding has.
    """
    given, parameter = node.arguments[name], node.node_type.parameters[name]
    found = plain_value(given, time, frame)
    if isinstance(given, Literal) or isinstance(found, bool):
        return found
    parts = found if isinstance(found, tuple) else (found,)
    low = -math.inf if parameter.min is None else parameter.min
    high = math.inf if parameter.max is None else parameter.max
    kept = tuple(min(max(part, low), high) for part in parts)
    near = all(abs(part - bound) <= ROUNDING * (1 + abs(bound)) for part, bound in zip(parts, kept, strict=True) if part != bound)
    wrong = "" if isinstance(given, Keys) or near else out_of_range(tuple(float(f"{part:.6g}") for part in parts), parameter)
    if any(math.isnan(part) or (math.isinf(part) and parameter.default != INFINITY) for part in parts):
        wrong = f"{name} is {', '.join(f'{part:g}' for part in parts)}; it must be finite"
    if wrong:
        place = given.location if given.location.line else node.location
        raise GraphError(Problem(f"at {time:g} s, frame {frame}, {wrong}", place, given.path or f"nodes.{node.path}.{name}"))
    return kept if isinstance(found, tuple) else kept[0]


def image_plan(node: FlatNode, sources: Sources) -> ImagePlan:
    """Return the plan of a node that draws."""
    streams: list[Drawn] = []
    nodes, dropped = sources.flat.nodes, sources.schedule.dropped
    for source, look in zip(node.sources, node.looks or ({},) * len(node.sources), strict=True):
        for top in sources.schedule.kept(source, sources.flat):
            for path, condition in sources.reaching(top).items():
                if any(path == drawn.path and drawn.condition is None for drawn in streams):
                    continue
                same = [drawn for drawn in streams if drawn.path == path and drawn.looks == dict(look)]
                for drawn in same:
                    drawn.condition = either(drawn.condition, condition)
                if not same:
                    streams.append(Drawn(path, dict(look), condition))
    polygons = [nodes[path] for path in dict.fromkeys(node.sources) if nodes[path].node_type.role == "polygons"]
    lights = [nodes[path] for name, path in node.references.items() if name.startswith("lights[")]
    kept = ([each for each in listed if each.path not in dropped] for listed in (polygons, lights))
    return ImagePlan(node, nodes[node.references["camera"]], streams, *kept)
