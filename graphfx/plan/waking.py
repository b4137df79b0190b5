"""Write which particles at rest are held no more: what drives them has changed, or the surface has gone.

Who has come to rest was pressed on a surface, and stays where it is; so what drives it is the same for ever unless that
changes with time. Only then is it asked at the start of each step: the motion of one step from rest must not lead it away.
"""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.motion import basic, contact, settling
from graphfx.plan.barriers import Barriers, is_barrier
from graphfx.plan.contact_search import remember
from graphfx.plan.hits import response_of
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Motion
from graphfx.plan.scheme import put_back
from graphfx.plan.surfaces import distance_of
from graphfx.program import Column, Uniform


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
    """The test of who is held, for one source's surfaces."""

    motion: Motion
    resolution: Uniform

    def woken(self, moment: Moment, state: State) -> Column:
        """Write who of those at rest, under the moment's mask, is held by nothing as a step starts."""
        builder = moment.builder
        builder.note = "held at rest"
        first = remember(builder, state)
        self.motion.step(moment, state)
        way = builder.call(basic.difference_of_vectors, state.position, first["position"], name="way from rest")
        put_back(builder, state, first)
        place = first["position"]
        tolerance = builder.call(contact.contact_tolerance, place, self.resolution, name="tolerance")
        held = builder.call(basic.but_not, builder.mask, builder.mask, name="held")
        barriers = Barriers(self.motion)
        for surface in self.motion.of("surface"):
            builder.note = f"{surface.node.path}: held at rest"
            concerned = self.motion.under_conditions(surface, moment)
            if is_barrier(surface):
                ahead = builder.call(settling.ahead, place, way, name="ahead")
                holds = barriers.meet(surface, moment, state, concerned, (place, ahead)).hit
            else:
                distance, normal = distance_of(self.motion, surface, moment, state, place)
                asked = settling.is_glued if response_of(surface.node) == "stick" else settling.is_pressed
                holds = concerned.call(asked, distance, normal, way, tolerance, name="holds")
            held = builder.call(basic.either, held, holds, name="held")
        woken: Column = builder.call(basic.but_not, builder.mask, held, name="woken")
        return woken
