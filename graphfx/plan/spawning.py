"""Write what a spawn asks of the parents: how many children each has, or how many in a second."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from graphfx.graph.flat import FlatNode
from graphfx.math.random import key_of
from graphfx.motion import events
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.hits import HIT_TYPES
from graphfx.plan.holder import moment_of
from graphfx.plan.liveness import Attributes
from graphfx.plan.moment import Moments
from graphfx.plan.rates import NOUGHT
from graphfx.plan.setting import as_column, under_conditions
from graphfx.program import Builder, Operand, Uniform


@dataclass
class SpawnPlan:
    """A spawn as it acts on the particles of one source.

    `home` is the source that takes the children, `parents` that of the parents. `offspring` finds how many children
    there are at an event; `rate`, for trails, how many a second. `generations` is the greatest that a child may have,
    `surfaces` are the numbers of the surfaces whose hits count.
    """

    node: FlatNode
    home: str
    moment: str
    offspring: FrameProgram
    rate: FrameProgram | None
    generations: float
    parents: str = ""
    surfaces: tuple[int, ...] = ()

    @property
    def path(self) -> str:
        """Return the spawn's path."""
        return self.node.path


@dataclass
class SpawnWriter:
    """Writes the programs of spawns on one source's particles."""

    path: str
    attributes: Attributes
    constant: Callable[[str], Uniform]
    seed: int
    precision: int

    def plan(self, node: FlatNode, home: str, surfaces: list[str]) -> SpawnPlan:
        """Return a spawn's plan; `surfaces` are the paths of all that the parents may hit."""
        moment = moment_of(node)
        limited = "into" in node.references
        generations = float(getattr(node.arguments["generations"], "value", 8)) if limited else float("inf")
        rate = self._rate(node) if moment == "rate" else None
        heard = tuple(number for number, path in enumerate(surfaces) if not node.surfaces or path in node.surfaces)
        return SpawnPlan(node, home, moment, self._offspring(node, moment), rate, generations, self.path, heard)

    def _begin(self, name: str) -> tuple[Builder, Moments]:
        builder = Builder.begin(name)
        made = FrameProgram(builder.program)
        return builder, Moments(self.seed, self.path, self.precision, self.attributes, self.constant, made)

    def _offspring(self, node: FlatNode, moment: str) -> FrameProgram:
        builder, moments = self._begin(f"{node.path}: offspring of {self.path}")
        builder.note = node.path
        state = moments.state(builder, False)
        told: dict[str, Operand] = {}
        if moment == "hit":
            told = {f"hit.{name}": builder.load(f"hit.{name}", type_) for name, type_ in HIT_TYPES.items()}
        writer = moments.at(builder, builder.load("begin", "float"), state, told)
        result = as_column(builder, Uniform("0", "float", 0.0), "float", "offspring", always=True)
        inside = under_conditions(node, writer, builder)
        count, probability = (writer.argument(node.arguments[name]) for name in ("count", "probability"))
        event: Operand = NOUGHT
        if moment in ("hit", "rate"):
            event = inside.call(events.word_of, builder.load("event", "float"), name="event word")
        life = writer.scope.number("lives")
        draw = inside.draw(key_of(self.seed, self.path, node.seed, "offspring"), builder.load("id", "id"), life, event)
        inside.call(events.offspring, count, probability, draw, into=result)
        builder.store("offspring", result)
        return moments.made

    def _rate(self, node: FlatNode) -> FrameProgram:
        builder, moments = self._begin(f"{node.path}: rate of {self.path}")
        builder.note = node.path
        state = moments.state(builder, False)
        writer = moments.at(builder, builder.load("begin", "float"), state)
        result = as_column(builder, Uniform("0", "float", 0.0), "float", "rate", always=True)
        inside = under_conditions(replace(node, during=None), writer, builder)  # each child's own time decides on that
        rate = writer.argument(node.arguments["rate"])
        inside.call(events.at_least_nothing, rate, into=result)
        builder.store("rate", result)
        return moments.made
