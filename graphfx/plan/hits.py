"""Write what follows from hits: they are counted, attributes are set, particles end or are held for those who listen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from graphfx.graph.flat import FlatNode
from graphfx.motion import basic, events
from graphfx.plan.holder import ENDING_ROLES, Holder, moment_of
from graphfx.plan.liveness import Attributes
from graphfx.plan.motion import Mover
from graphfx.plan.setting import Setting, under_conditions
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Column, Operand, Uniform

HIT_TYPES = {"normal": "vec3", "point": "vec3", "speed": "float"}
"""What is told of a hit, as hit.normal and so on."""


@dataclass
class Fate:
    """Columns that say what became of a particle in its own time; the last hit is told only where somebody listens.

    `surface` is the number of the surface that was hit, -1 where none was; `begun` counts the steps whose start it met.
    """

    fate: Column
    surface: Column
    begun: Column
    hit: dict[str, Column] = field(default_factory=dict)


@dataclass
class Hit:
    """A contact: who meets the surface, at which column of time, with its normal and the velocity before."""

    surface: Mover
    builder: Builder
    position: Column
    normal: Column
    speed: Column
    stopped: Column


class Hits:
    """What listens to the hits of one source's particles."""

    def __init__(self, holder: Holder, attributes: Attributes):
        self.attributes = attributes
        self.settings = [node for node in holder.of_role("set", "assign") if moment_of(node) == "hit"]
        self.endings = [node for node in holder.of_role(*ENDING_ROLES) if moment_of(node) == "hit"]
        self.listeners = [node for node in holder.spawns if moment_of(node) == "hit"]
        self.deadly = {node.path for node in holder.of_role("surface") if response_of(node) == "die"}
        self.counted = "hits" in attributes.columns
        self.numbers = {node.path: number for number, node in enumerate(holder.of_role("surface"))}
        self.vital = [node for node in self.settings if is_vital(node, attributes)]

    @property
    def ends(self) -> bool:
        """Return whether a hit may end or hold a particle."""
        return bool(self.endings or self.listeners or self.deadly or self.vital)

    def concern(self, surface: Mover) -> bool:
        """Return whether anything follows from the hits of a surface."""
        everyone = (*self.settings, *self.endings, *self.listeners)
        return self.counted or surface.node.path in self.deadly or any(_hears(node, surface) for node in everyone)

    def answer(
        self,
        hit: Hit,
        least: Operand,
        read: Callable[[str], Operand],
        writer_of: Callable[[Builder, dict[str, Operand]], ValueWriter],
        fate: Fate | None,
    ) -> None:
        """Write what follows; hits slower than `least` count only where the particle comes to rest."""
        builder = hit.builder
        builder.note = hit.surface.node.path
        if fate is not None and hit.surface.node.path in self.deadly:
            builder.call(events.ended, fate.fate, into=fate.fate)
        fast = builder.call(events.is_at_least, hit.speed, least, name="fast")
        counts = builder.call(basic.both, builder.mask, builder.call(basic.either, fast, hit.stopped), name="counts")
        inside = builder.under(counts)
        told: dict[str, Operand] = {"hit.normal": hit.normal, "hit.point": hit.position, "hit.speed": hit.speed}
        if self.counted:
            count = read("hits")
            inside.call(events.one_more, count, into=count)  # type: ignore[arg-type]
        for node in self.settings:
            if _hears(node, hit.surface):
                Setting(node, lambda: writer_of(inside, told), inside, read, resting=hit.stopped).write(
                    self.attributes.columns
                )
        if fate is None:
            return
        for node in self.endings:
            if _hears(node, hit.surface):
                become = events.ended if node.node_type.role == "kill" else events.renewed
                under_conditions(node, writer_of(inside, told), inside).call(become, fate.fate, into=fate.fate)
        if any(_hears(node, hit.surface) for node in (*self.listeners, *self.vital)):
            inside.call(events.held, fate.fate, into=fate.fate)
            number = self.numbers[hit.surface.node.path]
            inside.call(basic.copy_number, Uniform(str(number), "float", float(number)), into=fate.surface)
            for name, column in fate.hit.items():
                inside.call(basic.copy_of(column.type), told[name], into=column)


def _hears(node: FlatNode, surface: Mover) -> bool:
    return not node.surfaces or surface.node.path in node.surfaces


def is_vital(node: FlatNode, attributes: Attributes) -> bool:
    """Return whether what a node sets may bring the end of a life nearer, or put it off."""
    return "life" in attributes.columns and "life" in node.gives


def response_of(node: FlatNode) -> str:
    """Return how particles answer to a surface: bounce, stick, slide or die."""
    value = node.arguments.get("response")
    return str(getattr(value, "value", "bounce"))
