"""Write which particles at rest are held no more: what drives them has changed, or the surface has gone.

Who has come to rest was pressed on a surface, and stays where it is; so what drives it is the same for ever unless that
changes with time. Only then is it asked, at an instant: a step from rest, at the rates of that instant, must not lead it
away. Whole steps ask at their ends; in a particle's own time the instant at which it is let go is found within the step.
"""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.motion import basic, contact, pacing, waking
from graphfx.plan.barriers import Barriers, is_barrier
from graphfx.plan.contact_search import RESOLUTION, remember
from graphfx.plan.hits import response_of
from graphfx.plan.moment import ZERO_TIME, Moments, State
from graphfx.plan.motion import Motion
from graphfx.plan.scheme import put_back
from graphfx.plan.surfaces import distance_of
from graphfx.program import Builder, Column, Operand, Uniform, constant_number

SHORT_STEPS = {32: 2, 64: 64}
"""How many short steps make one, by precision: what is known of the rates of an instant grows with their square."""
SEARCH_LIMIT = 64
"""Halvings of a step in the search for one instant; 20 are usual in 32 bits, 50 in 64."""


def may_wake(motion: Motion) -> bool:
    """Return whether particles at rest may have to go on: something that drives or holds them changes with time.

    Brownian noise never wakes them.
    """
    surfaces = motion.of("surface")
    if motion.method == "sims" or motion.is_brownian or all(response_of(surface.node) != "bounce" for surface in surfaces):
        return False
    if any(is_barrier(surface) and response_of(surface.node) == "stick" for surface in surfaces):
        return False
    drivers = [mover for mover in motion.movers if not mover.idle and mover.role != "surface"]
    changing = [mover for mover in drivers if not mover.time_free or mover.role == "noise"]
    changing += [mover for mover in drivers if mover.changing.intersection(mover.arguments)]
    changing += [surface for surface in surfaces if surface.node.during is not None or not surface.constant]
    return bool(changing)


@dataclass
class Waking:
    """The test of who is held, for one source's surfaces; `state` is left as it is."""

    motion: Motion
    moments: Moments
    state: State
    precision: int

    @property
    def _resolution(self) -> Uniform:
        return Uniform("8 eps", "float", RESOLUTION[self.precision])

    def woken(self, builder: Builder, k: int, instant: Operand) -> Column:
        """Write who of those at rest, under the builder's mask, is held by nothing at an instant of step `k`."""
        builder.note = "held at rest"
        place, way = self._way(builder, k, instant)
        moment = self.moments.own_step(builder, k, instant, ZERO_TIME, self.state)
        tolerance = builder.call(contact.contact_tolerance, place, self._resolution, name="tolerance")
        count = constant_number(SHORT_STEPS[self.precision])
        held = builder.call(basic.but_not, builder.mask, builder.mask, name="held")
        barriers = Barriers(self.motion)
        for surface in self.motion.of("surface"):
            builder.note = f"{surface.node.path}: held at rest"
            concerned = self.motion.under_conditions(surface, moment)
            if is_barrier(surface):
                ahead = builder.call(waking.ahead, place, way, name="ahead")
                holds = barriers.meet(surface, moment, self.state, concerned, (place, ahead)).hit
            else:
                distance, normal = distance_of(self.motion, surface, moment, self.state, place)
                asked = waking.is_glued if response_of(surface.node) == "stick" else waking.is_pressed
                holds = concerned.call(asked, distance, normal, way, tolerance, count, name="holds")
            held = builder.call(basic.either, held, holds, name="held")
        woken: Column = builder.call(basic.but_not, builder.mask, held, name="woken")
        return woken

    def _way(self, builder: Builder, k: int, instant: Operand) -> tuple[Column, Column]:
        """Write the place, and the way of a whole step from rest there at the rates of an instant."""
        whole = self.moments.made.time(builder, "length")
        first = remember(builder, self.state)
        found: list[Operand] = []
        count = SHORT_STEPS[self.precision]
        for share in (1 / count, 1 / (2 * count)):
            length = builder.call(pacing.part_of, whole, constant_number(share), name="part")
            self.motion.step(self.moments.own_step(builder, k, instant, length, self.state), self.state)
            found.append(builder.call(basic.difference_of_vectors, self.state.position, first["position"], name="way"))
            found.append(builder.call(basic.copy_vector, self.state.read("velocity"), name="velocity"))
            put_back(builder, self.state, first)
        way = builder.call(waking.whole_way, *found, first["velocity"], whole, constant_number(count), name="way from rest")
        return first["position"], way

    def instant(self, builder: Builder, k: int, start: Operand, finish: Operand) -> Column:
        """Write when, from `start` on, nothing holds those at rest under the builder's mask; `finish` where something does.

        Who is let go, and held again before the step ends, is not found.
        """
        held_till = builder.call(basic.copy_number, start, name="held till")
        instant: Column = builder.call(basic.copy_number, finish, name="let go at")
        at_once = self.woken(builder, k, start)
        builder.under(at_once).call(basic.copy_number, start, into=instant)
        later = builder.under(builder.call(basic.but_not, builder.mask, at_once))
        searching = later.call(basic.both, later.mask, self.woken(later, k, finish), name="searching")
        inner = builder.loop(searching, SEARCH_LIMIT, "find when it is let go")
        between = inner.call(waking.middle, held_till, instant, name="between")
        inner.call(waking.narrow, held_till, instant, between, self.woken(inner, k, between), into=(held_till, instant))
        inner.call(waking.is_open, held_till, instant, finish, self._resolution, into=searching)
        return instant
