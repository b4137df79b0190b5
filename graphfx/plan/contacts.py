"""Write contacts with surfaces: for whole steps only whether there is one, in own time where and what follows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphfx.motion import basic, contact, events
from graphfx.node import INFINITY
from graphfx.plan.hits import Fate, Hit, Hits, response_of
from graphfx.plan.moment import Moment, Moments, State
from graphfx.plan.motion import Motion, Mover
from graphfx.program import Builder, Column, Operand, Uniform

SEARCH_LIMIT = 60
"""Evaluations in the search for one contact; ten are usual."""
FIXED = {
    "stick": {"resilience": 0.0, "friction": 1.0, "friction_threshold": 0.0, "rest_speed": INFINITY},
    "slide": {"resilience": 0.0, "friction": 0.0, "rest_speed": INFINITY},
}
"""Parameters of a surface that its response fixes."""
RESOLUTION = {32: 2.0**-20, 64: 2.0**-49}
"""Eight units in the last place."""


class Contacts:
    """The surfaces of one emitter's stack."""

    def __init__(self, motion: Motion, precision: int, hits: Hits, moments: Moments, fate: Fate | None = None):
        self.motion = motion
        self.hits = hits
        self.moments = moments
        self.fate = fate
        self.surfaces = motion.of("surface")
        self.resolution = Uniform("8 eps", "float", RESOLUTION[precision])

    def _distance(self, surface: Mover, moment: Moment, state: State) -> tuple[Column, Column]:
        moment.builder.note = surface.node.path
        operands = self.motion.arguments(surface, moment, state)
        distance, normal = moment.builder.call(surface.function, *operands, name="distance normal")
        return distance, normal

    def _response(self, surface: Mover, moment: Moment, names: tuple[str, ...]) -> list[Operand]:
        """Return the operands of how a particle answers; what sticks or slides has some of them fixed."""
        fixed = FIXED.get(response_of(surface.node), {})
        return [
            Uniform(f"{fixed[name]:g}", "float", fixed[name])
            if name in fixed
            else moment.writer.argument(surface.node.arguments[name])
            for name in names
        ]

    def main_step(self, moment: Moment, state: State, event: Column | None) -> Column | None:
        """Write, after a whole step, which particles have met a surface; `sims` bounces them at once."""
        builder = moment.builder
        for surface in self.surfaces:
            distance, normal = self._distance(surface, moment, state)
            inside = self.motion.under_conditions(surface, moment).call(contact.is_inside, distance, name="inside")
            if self.motion.method == "sims" and not (self.hits.ends and self.fate is None):
                self._sims_bounce(surface, builder.under(inside), moment, state, distance, normal)
                continue
            event = inside if event is None else builder.call(basic.either, event, inside, name="event")
        return event

    def _sims_bounce(
        self, surface: Mover, builder: Builder, moment: Moment, state: State, distance: Column, normal: Column
    ) -> None:
        """Write the paper's bounce, at the end of the step."""
        assert state.velocity is not None
        response = self._response(surface, moment, ("resilience", "friction", "friction_threshold"))
        into: Any = (state.position, state.velocity)
        concerned = self.hits.concern(surface)
        speed = builder.call(events.approach, state.velocity, normal, name="speed") if concerned else None
        builder.call(basic.sims_bounce, *into, distance, normal, *response, into=into)
        if speed is not None:
            stopped = builder.call(basic.but_not, builder.mask, builder.mask, name="stopped")
            self._tell(Hit(surface, builder, into[0], normal, speed, stopped), moment, state, moment.end())

    def _tell(self, hit: Hit, moment: Moment, state: State, time: Operand) -> None:
        """Have a hit answered, at a time of the frame."""
        least = moment.writer.argument(hit.surface.node.arguments["event_speed"])
        self.hits.answer(
            hit, least, state.read, lambda builder, told: self.moments.at(builder, time, state, told), self.fate
        )

    def own_step(
        self,
        builder: Builder,
        moment_of: Callable[[Builder, Column], Moment],
        state: State,
        step: Column,
        resting: Column | None,
        fade: Callable[[Builder, Column], None],
    ) -> None:
        """Write one step that stops at the first contact; `step` becomes the time that was used.

        `fade` writes what fades over a time; what is set at a hit comes after it.
        """
        whole = moment_of(builder, step)
        if self.motion.method == "sims" or not self.surfaces:
            self.motion.step(whole, state)
            fade(builder, step)
            self.main_step(whole, state, None)
            return
        first = self._remember(builder, state)
        self.motion.select(whole)
        starts = [self._distance(surface, whole, state) for surface in self.surfaces]
        self.motion.step(whole, state)
        ends = [self._distance(surface, whole, state)[0] for surface in self.surfaces]
        hits = [
            self.motion.under_conditions(surface, whole).call(contact.is_inside, distance, name="inside")
            for surface, distance in zip(self.surfaces, ends, strict=True)
        ]
        best = builder.call(basic.copy_number, step, name="contact time")
        times = []
        for surface, start, end, hit in zip(self.surfaces, starts, ends, hits, strict=True):
            found = self._search(surface, builder.under(hit), moment_of, state, first, start, end, step)
            times.append(found)
            builder.under(hit).call(basic.earlier, found, best, into=best)
        met = hits[0]
        for hit in hits[1:]:
            met = builder.call(basic.either, met, hit, name="met")
        inner = builder.under(met)
        self._return(inner, state, first)
        self.motion.step(moment_of(inner, best), state)
        fade(builder, best)
        slides = builder.call(basic.but_not, met, met, name="slides")
        for surface, hit, time in zip(self.surfaces, hits, times, strict=True):
            chosen = builder.call(basic.both, hit, builder.under(hit).call(basic.is_equal, time, best), name="chosen")
            slid = self._answer(surface, builder.under(chosen), moment_of, state, best, resting)
            slides = builder.call(basic.either, slides, slid)
        stuck = builder.call(basic.both, slides, builder.under(slides).call(contact.is_instant, best, step), name="stuck")
        self._slide(builder.under(stuck), moment_of, state, step, best)
        inner.call(basic.copy_number, best, into=step)

    def _slide(
        self, builder: Builder, moment_of: Callable[[Builder, Column], Moment], state: State, step: Column, used: Column
    ) -> None:
        """Write a whole step along the surfaces, for particles that are pressed on one and cannot leave."""
        builder.call(basic.copy_number, step, into=used)
        moment = moment_of(builder, step)
        self.motion.step(moment, state)
        for surface in self.surfaces:
            distance, normal = self._distance(surface, moment, state)
            into = (state.position, state.velocity)
            builder.call(contact.slide, *into, distance, normal, into=into)  # type: ignore[arg-type]

    @staticmethod
    def _remember(builder: Builder, state: State) -> dict[str, Column]:
        """Keep where the step starts."""
        assert state.velocity is not None
        return {
            "position": builder.call(basic.copy_vector, state.position, name="first position"),
            "velocity": builder.call(basic.copy_vector, state.velocity, name="first velocity"),
        }

    @staticmethod
    def _return(builder: Builder, state: State, first: dict[str, Column]) -> None:
        """Go back to the start of the step."""
        builder.call(basic.copy_vector, first["position"], into=state.position)  # type: ignore[arg-type]
        builder.call(basic.copy_vector, first["velocity"], into=state.velocity)  # type: ignore[arg-type]

    def _search(
        self,
        surface: Mover,
        builder: Builder,
        moment_of: Callable[[Builder, Column], Moment],
        state: State,
        first: dict[str, Column],
        start: tuple[Column, Column],
        end: Column,
        step: Column,
    ) -> Column:
        """Write the search for the instant of contact; return its column."""
        builder.note = f"{surface.node.path}: find the contact"
        tolerance = builder.call(contact.contact_tolerance, first["position"], self.resolution, name="tolerance")
        a, at_a, b, at_b, touching, at_once = builder.call(
            contact.start_search,
            start[0],
            end,
            start[1],
            first["velocity"],
            step,
            tolerance,
            name="a at_a b at_b touching at_once",
        )
        time = builder.call(basic.copy_number, a, name="time of contact")
        side = builder.call(basic.difference, a, a, name="side")
        searching = builder.call(basic.but_not, builder.mask, at_once, name="searching")
        inner = builder.loop(searching, SEARCH_LIMIT, builder.note)
        inner.call(contact.propose, a, at_a, b, at_b, into=time)
        self._return(inner, state, first)
        moment = moment_of(inner, time)
        self.motion.step(moment, state)
        distance, _ = self._distance(surface, moment, state)
        bracket = (a, at_a, b, at_b, side)
        inner.call(contact.narrow, *bracket, time, distance, touching, into=bracket)
        inner.call(contact.is_open, a, b, distance, step, tolerance, self.resolution, into=searching)
        return time

    def _answer(
        self,
        surface: Mover,
        builder: Builder,
        moment_of: Callable[[Builder, Column], Moment],
        state: State,
        time: Column,
        resting: Column | None,
    ) -> Column:
        """Write what a surface does to the particles that meet it; return which of them slide."""
        moment = moment_of(builder, time)
        distance, normal = self._distance(surface, moment, state)
        response = self._response(surface, moment, ("resilience", "friction", "friction_threshold", "rest_speed"))
        stopped, sliding = Column("stopped", "bool"), Column("sliding", "bool")
        into: Any = (state.position, state.velocity, stopped, sliding)
        concerned = self.hits.concern(surface)
        speed = builder.call(events.approach, state.velocity, normal, name="speed") if concerned else None
        builder.call(contact.respond, *into[:2], distance, normal, *response, into=into)
        if speed is not None:
            self._tell(Hit(surface, builder, into[0], normal, speed, stopped), moment, state, moment.end())
        if resting is not None:
            builder.under(builder.program.context).call(basic.either, resting, stopped, into=resting)
        return sliding
