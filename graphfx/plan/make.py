"""Make a plan: what will really run, and why the rest will not."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.values import Literal, Value
from graphfx.node import INFINITY
from graphfx.plan.birth import write_birth
from graphfx.plan.evaluate import timed_value
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.liveness import Attributes, find_attributes
from graphfx.plan.method import cells_met, choose_method
from graphfx.plan.motion import Motion, mover_of
from graphfx.plan.schedule import Schedule, make_schedule, never_acts
from graphfx.plan.steps import FrameWriter
from graphfx.plan.support import check_support
from graphfx.program import Program

DRAWN = frozenset({"position", "radius", "color", "opacity"})
"""Attributes that a picture reads."""


@dataclass
class EmitterPlan:
    """One emitter's particles: their columns, their operators, their programs.

    `main` and `own` are None where nothing moves. `method` is how motion is computed, `reason` why.
    `constants` are the attributes that are one for all.
    """

    node: FlatNode
    operators: list[FlatNode]
    attributes: Attributes
    method: str
    reason: str
    birth: FrameProgram
    main: FrameProgram | None
    own: FrameProgram | None
    motion: Motion
    constants: dict[str, Any]

    @property
    def path(self) -> str:
        """Return the emitter's path."""
        return self.node.path

    @property
    def programs(self) -> list[Program]:
        """Return all programs, births first."""
        return [made.program for made in (self.birth, self.main, self.own) if made is not None]

    @property
    def mortal(self) -> bool:
        """Return whether particles die."""
        return self.constants.get("life", 0.0) < INFINITY


@dataclass
class ImagePlan:
    """One image: `emitters` are the particles that it draws, each with how it looks."""

    node: FlatNode
    camera: FlatNode
    streams: list[tuple[str, dict[str, Any]]]

    def value(self, name: str, time: float = 0.0, frame: int = 0) -> Any:
        """Return one of the image's parameters."""
        return plain_value(self.node.arguments[name], time, frame)


@dataclass
class Plan:
    """A whole graph, ready to cook."""

    flat: FlatGraph
    schedule: Schedule
    emitters: dict[str, EmitterPlan]
    images: list[ImagePlan]

    @property
    def precision(self) -> int:
        """Return 32 or 64: the bits of a real."""
        return self.flat.time.precision

    @cached_property
    def shutter(self) -> float:
        """Return the longest time that a shutter is open [frames]: tails are taken when it opens."""
        return max((float(image.value("shutter")) for image in self.images), default=0.0)


def plain_value(value: Value, time: float = 0.0, frame: int = 0) -> Any:
    """Return a value that no particle has a part in; text and lists as they are."""
    if isinstance(value, Literal):
        return value.value
    return timed_value(value, time, frame)


def make_plan(flat: FlatGraph, *, prune: bool = True) -> Plan:
    """Plan a flattened graph.

    `prune=False` keeps what could be left out, to show that it changes no byte: nodes that no output needs, attributes
    that nothing reads, operators that act outside the simulated time. Those that do nothing are left out either way.
    """
    schedule = make_schedule(flat, flat.time.precision, prune=prune)
    check_support(flat, schedule.order)
    nodes = flat.nodes
    images = [_image(nodes[path], schedule, flat) for path in schedule.order if nodes[path].node_type.role == "image"]
    emitters = {
        path: _emitter(nodes[path], schedule, flat, images, prune)
        for path in schedule.order
        if nodes[path].node_type.role == "emit"
    }
    return Plan(flat, schedule, emitters, images)


def _image(node: FlatNode, schedule: Schedule, flat: FlatGraph) -> ImagePlan:
    streams: list[tuple[str, dict[str, Any]]] = []
    for source, look in zip(node.sources, node.looks or ({},) * len(node.sources), strict=True):
        for top in schedule.kept(source, flat):
            above = [path for path in (*schedule.upstream(top), top) if flat.nodes[path].node_type.role == "emit"]
            streams += [(path, dict(look)) for path in above if path not in [name for name, _ in streams]]
    return ImagePlan(node, flat.nodes[node.references["camera"]], streams)


def _operators(path: str, schedule: Schedule, flat: FlatGraph) -> list[FlatNode]:
    return [
        flat.nodes[name]
        for name in schedule.order
        if flat.nodes[name].node_type.kind == "operators" and path in schedule.upstream(name)
    ]


def _emitter(node: FlatNode, schedule: Schedule, flat: FlatGraph, images: list[ImagePlan], prune: bool) -> EmitterPlan:
    operators = _operators(node.path, schedule, flat)
    movers = [mover_of(operator, bool(never_acts(operator, flat))) for operator in operators]
    shown = any(node.path in dict(image.streams) for image in images)
    shutter = max(float(image.value("shutter")) for image in images) if shown else 0.0
    attributes = find_attributes(node, operators, set(DRAWN), shutter > 0, prune)
    has_velocity = "velocity" in attributes.columns or _nonzero(attributes.constants.get("velocity"))
    method, reason = choose_method(movers, flat, has_velocity)
    motion = Motion(movers, method, has_velocity, cells_met(movers, flat.time, method))
    writer = FrameWriter(node, attributes, motion, flat.seed, flat.time.precision, flat.time.substeps)
    moves = bool(movers) or has_velocity
    birth = write_birth(node, attributes, flat.seed, flat.time.precision)
    opening = (
        min(int((1 - shutter) * flat.time.substeps), flat.time.substeps - 1)
        if shutter > 0 and "tail" in attributes.columns
        else -1
    )
    return EmitterPlan(
        node,
        operators,
        attributes,
        method,
        reason,
        birth,
        writer.main(opening) if moves else None,
        writer.own(opening >= 0) if moves else None,
        motion,
        {name: writer.constant(name).value for name in attributes.constants},
    )


def _nonzero(value: Value | None) -> bool:
    return value is not None and not (isinstance(value, Literal) and not any(value.value))
