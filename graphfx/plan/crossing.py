"""Write who may have gone through a surface within a step though both its ends are outside, and where: see motion/crossing.py."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from graphfx.motion import basic, contact, crossing
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Motion, Mover
from graphfx.plan.surfaces import distance_of, moves, never_dips, shape
from graphfx.program import Builder, Column, Operand, Uniform

MomentOf = Callable[[Builder, Column], Moment]
STRIDES = 128
"""Places looked at along a way: four times the shortest strides that it has room for."""
NARROWINGS = 30
"""Places looked at in the search for the least distance within a stride."""
NOUGHT, ONE = Uniform("0", "float", 0.0), Uniform("1", "float", 1.0)
SHORTLY = Uniform("2^-10", "float", 0.0009765625)
"""The share of a step after which it is seen how a surface moves."""
SCREENS = {
    "": crossing.near,
    "plane": crossing.near_plane,
    "convex": crossing.near_convex,
    "hollow": crossing.near_hollow,
}
"""The first test of all ways, by the shape of a surface."""


@dataclass
class Way:
    """The way of a step: its ends, and as tangents there `h` times vectors."""

    first: Column
    begin: Column
    last: Column
    end: Column
    h: Operand

    @property
    def curve(self) -> tuple[Operand, ...]:
        """Return what it is as a cubic."""
        return self.first, self.begin, self.last, self.end, self.h


def way_of(motion: Motion, builder: Builder, first: dict[str, Column], state: State, dt: Operand) -> Way:
    """Write the way from where a step started to where the state is now."""
    start, velocity, last, final = first["position"], first["velocity"], state.position, state.velocity
    assert isinstance(last, Column) and isinstance(final, Column)
    if not any(not mover.idle and mover.role != "surface" and not mover.writes_velocity for mover in motion.movers):
        return Way(start, velocity, last, final, dt)
    builder.note = "the way of a step"
    begin, end = builder.call(crossing.carried_tangents, start, velocity, last, final, dt, name="tangent tangent")
    return Way(start, begin, last, end, ONE)


class Crossings:
    """The test for one source's surfaces, and the search."""

    def __init__(self, motion: Motion):
        self.motion = motion

    def concern(self, surface: Mover) -> bool:
        """Return whether a way may cross a surface and end outside; one that follows what meets it is asked at ends alone."""
        dips = shape(surface) != "plane" or not never_dips(self.motion, surface)
        return self.motion.method != "sims" and not surface.follows_state and dips

    def possible(
        self, surface: Mover, moment: Moment, state: State, way: Way, end: tuple[Column, Column], builder: Builder
    ) -> Column | None:
        """Write who of those under the builder's mask may have crossed a surface, being outside at the end of the way."""
        if not self.concern(surface):
            return None
        builder.note = surface.node.path
        kind = shape(surface)
        if moves(surface):
            there, _ = distance_of(self.motion, surface, moment, state, way.last, begins=True)
            reach = builder.call(crossing.reach, *way.curve, name="reach")
            reach = builder.call(crossing.widened, reach, end[0], there, name="reach")
            near: Column = builder.call(crossing.near_by, end[0], reach, name="near")
        else:
            near = builder.call(SCREENS[kind], *end, *way.curve, name="near")
        if kind == "plane":
            return near
        inner = builder.under(near)
        start, normal = distance_of(self.motion, surface, replace(moment, builder=inner), state, way.first, begins=True)
        if kind == "convex":
            return inner.call(crossing.meets_convex, start, normal, *way.curve, name="meets")  # type: ignore[no-any-return]
        if kind == "hollow":
            return inner.call(crossing.meets_hollow, start, end[0], *way.curve, name="meets")  # type: ignore[no-any-return]
        reach = reach if moves(surface) else inner.call(crossing.reach, *way.curve, name="reach")
        return inner.call(crossing.meets, start, end[0], reach, name="meets")  # type: ignore[no-any-return]


@dataclass
class Search:
    """The search along the way of a step, whose particles began where `start` says of the surface, for a place inside."""

    motion: Motion
    surface: Mover
    moment_of: MomentOf
    state: State
    way: Way
    step: Column
    tolerance: Column

    def find(self, builder: Builder, start: tuple[Column, Column]) -> tuple[Column, Column]:
        """Write the search for those under the builder's mask; return who has such a place, and the share of the step when."""
        context, curve = builder.program.context, self.way.curve
        builder.note = f"{self.surface.node.path}: follow the way"
        reach = builder.call(crossing.reach, *curve, name="reach")
        share = builder.call(basic.copy_number, NOUGHT, name="share")
        unsure = builder.call(basic.copy_number, NOUGHT, name="unsure")
        distance = builder.call(basic.copy_number, start[0], name="distance")
        _, across = builder.call(crossing.on_way, *curve, share, name="place across")
        change = builder.call(crossing.change, start[1], across, name="change")
        found = builder.under(context).call(basic.but_not, context, context, name="crossed")
        going = builder.call(basic.both, builder.mask, builder.mask, name="going on")
        inner = builder.loop(going, STRIDES, builder.note)
        before = [inner.call(basic.copy_number, column, name="before") for column in (share, distance, change)]
        inner.call(crossing.stride, share, distance, reach, into=(share, unsure))
        self._look(inner, share, (distance, change))
        deep = inner.call(crossing.is_deep, distance, self.tolerance, name="deep")
        inner.under(context).call(basic.either, found, deep, into=found)
        dip = inner.call(basic.but_not, inner.call(crossing.is_dip, before[2], change, unsure), deep, name="dip")
        self._narrow(inner.under(dip), before, [share, distance, change], reach, found)
        inner.call(basic.but_not, inner.call(crossing.is_on_the_way, share), found, into=going)
        return found, share

    def _narrow(self, builder: Builder, before: list[Column], after: list[Column], reach: Column, found: Column) -> None:
        """Write the search for the least distance within a stride; where it is inside, the share after becomes its place."""
        a = builder.call(basic.copy_number, before[0], name="a")
        at_a = builder.call(crossing.falling, *before[1:], reach, name="at_a")
        b = builder.call(basic.copy_number, after[0], name="b")
        at_b = builder.call(crossing.falling, *after[1:], reach, name="at_b")
        side = builder.call(basic.difference, a, a, name="side")
        searching = builder.call(basic.both, builder.mask, builder.mask, name="searching")
        inner = builder.loop(searching, NARROWINGS, builder.note)
        place = inner.call(contact.propose, a, at_a, b, at_b, name="place")
        distance, change = Column("distance", "float"), Column("change", "float")
        self._look(inner, place, (distance, change))
        deep = inner.call(crossing.is_deep, distance, self.tolerance, name="deep")
        inner.under(builder.program.context).call(basic.either, found, deep, into=found)
        inner.under(deep).call(basic.copy_number, place, into=after[0])
        bracket = (a, at_a, b, at_b, side)
        falling = inner.call(crossing.falling, distance, change, reach, name="falling")
        inner.call(contact.narrow, *bracket, place, falling, NOUGHT, into=bracket)
        undecided = inner.call(crossing.is_undecided, a, b, distance, change, self.tolerance, name="undecided")
        inner.call(basic.but_not, undecided, deep, into=searching)

    def _look(self, builder: Builder, share: Column, into: tuple[Column, Column]) -> None:
        """Write the distance at a share of the way, and how fast it changes along it."""
        place, across = builder.call(crossing.on_way, *self.way.curve, share, name="place across")
        distance, normal = self._distance(builder, share, place)
        builder.call(basic.copy_number, distance, into=into[0])
        builder.call(crossing.change, normal, across, into=into[1])
        if moves(self.surface):
            soon = builder.call(basic.sum_of_numbers, share, SHORTLY, name="soon")
            later, _ = self._distance(builder, soon, place)
            builder.call(crossing.change_with, into[1], distance, later, SHORTLY, into=into[1])

    def _distance(self, builder: Builder, share: Column, place: Column) -> tuple[Column, Column]:
        time = builder.call(crossing.share_of, share, self.step, name="time")
        return distance_of(self.motion, self.surface, self.moment_of(builder, time), self.state, place)
