"""Write contacts with surfaces: for whole steps only whether there is one, in own time where and what follows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from graphfx.motion import barrier, basic, contact, events, settling
from graphfx.node import INFINITY
from graphfx.plan.barriers import Barriers, is_barrier
from graphfx.plan.contact_search import RESOLUTION, Candidate, ContactSearch, MomentOf, distance_from, remember
from graphfx.plan.crossing import Crossings, way_of
from graphfx.plan.hits import Fate, Hit, Hits, response_of
from graphfx.plan.moment import Moment, Moments, State
from graphfx.plan.motion import Motion, Mover
from graphfx.plan.pacing import Pacing
from graphfx.plan.scheme import kept_state, put_back
from graphfx.plan.settling import Settling
from graphfx.plan.sliding import Sliding
from graphfx.plan.surfaces import distance_of, moves
from graphfx.program import Builder, Column, Operand, Uniform, constant_number

FIXED = {
    "stick": {"resilience": 0.0, "friction": 1.0, "friction_threshold": 0.0, "rest_speed": INFINITY},
    "slide": {"resilience": 0.0, "friction": 0.0, "rest_speed": INFINITY},
}
"""Parameters of a surface that its response fixes."""


class Contacts:
    """The surfaces of one emitter's stack."""

    def __init__(self, motion: Motion, precision: int, hits: Hits, moments: Moments, fate: Fate | None = None):
        self.motion = motion
        self.hits = hits
        self.moments = moments
        self.fate = fate
        self.surfaces = motion.of("surface")
        self.barriers = Barriers(motion)
        self.crossings = Crossings(motion)
        self.precision = precision
        self.resolution = Uniform("8 eps", "float", RESOLUTION[precision])

    def _response(self, surface: Mover, moment: Moment, names: tuple[str, ...]) -> list[Operand]:
        """Return the operands of how a particle answers; what sticks or slides has some of them fixed."""
        fixed = FIXED.get(response_of(surface.node), {})
        return [
            constant_number(fixed[name])
            if name in fixed
            else moment.writer.argument(surface.node.arguments[name])
            for name in names
        ]

    def main_step(self, moment: Moment, state: State, event: Column | None, start: dict[str, Column]) -> Column | None:
        """Write, after a whole step from `start`, which particles have met a surface; `sims` bounces them at once."""
        builder, mirrors = moment.builder, self.motion.method == "sims" and not (self.hits.ends and self.fate is None)
        way = None
        for surface in self.surfaces:
            concerned = self.motion.under_conditions(surface, moment)
            if is_barrier(surface):
                plane = self.barriers.meet(surface, moment, state, concerned, (start["position"], state.position))
                inside = plane.hit
                distance, normal = plane.distance(builder.under(inside), state.position)
            else:
                distance, normal = distance_of(self.motion, surface, moment, state)
                inside = concerned.call(contact.is_inside, distance, name="inside")
                if self.crossings.concern(surface):
                    way = way or way_of(self.motion, builder, start, state, moment.dt)
                    crossed = self.crossings.possible(surface, moment, state, way, (distance, normal), concerned)
                    inside = inside if crossed is None else builder.call(basic.either, inside, crossed, name="meets")
            if mirrors:
                if self.fate is not None:
                    inside = builder.call(basic.both, inside, builder.call(events.is_going_on, self.fate.fate), name="inside")
                self._sims_bounce(surface, builder.under(inside), moment, state, distance, normal)
                continue
            everywhere = builder.under(builder.program.context)
            event = inside if event is None else everywhere.call(basic.either, event, inside, name="event")
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
        moment_of: MomentOf,
        state: State,
        step: Column,
        resting: Column | None,
        fade: Callable[[Builder, Column], None],
        pacing: Pacing | None = None,
    ) -> Column | None:
        """Write one step that stops at the first contact; `step` becomes the time that was used. Return who met a surface.

        `fade` writes what fades over a time; what is set at a hit comes after it. With `pacing` a step may be refused.
        """
        whole = moment_of(builder, step)
        if self.motion.method == "sims" or not self.surfaces:
            self._free_step(builder, whole, state, step, fade, pacing)
            return None
        first = remember(builder, state)
        self.motion.select(whole)
        starts = self._starts(whole, state)
        errors = self.motion.step(whole, state)
        if pacing is not None and errors is not None:
            whole = replace(whole, builder=(builder := pacing.judge(builder, state, first, step, errors)))
        search = ContactSearch(self.motion, self.barriers, moment_of, state, first, step, self.resolution)
        search.tolerance = builder.call(contact.contact_tolerance, first["position"], self.resolution, name="tolerance")
        candidates = search.candidates(self.surfaces, whole, starts)
        longest = self.moments.made.time(builder, "length")
        settled = Settling(search, self._response, self.hits.concern, longest, self.precision).write(builder, candidates, whole)
        best = builder.call(basic.copy_number, step, name="contact time")
        for candidate in candidates:
            search.find(candidate, builder.under(candidate.hit), best)
        met = _any_of(builder, [candidate.hit for candidate in candidates])
        inner = builder.under(met)
        put_back(inner, state, first)
        self.motion.step(moment_of(inner, best), state)
        if settled is not None:
            met = settled.take(builder, state, best, step, met)
        if self.barriers.surfaces:
            search.shorten(inner, candidates, best)
        fade(builder, best)
        self._answers(builder, search, candidates, best, resting, fade)
        inner.call(basic.copy_number, best, into=step)
        if pacing is not None:
            pacing.meet(builder, met)
        return met

    def _answers(
        self,
        builder: Builder,
        search: ContactSearch,
        candidates: list[Candidate],
        best: Column,
        resting: Column | None,
        fade: Callable[[Builder, Column], None],
    ) -> None:
        """Write what the surfaces do to those who meet them at the time `best`; who cannot leave goes along them."""
        pressed = {}
        for candidate in candidates:
            chosen = builder.under(self._chosen(builder, candidate, best))
            pressed[candidate.surface.node.path] = self._answer(
                candidate, chosen, search.moment_of, search.state, best, resting, search.tolerance, search.mean
            )
        slides = _any_of(builder, list(pressed.values()))
        longest = self.moments.made.time(builder, "length")
        stuck = builder.call(basic.both, slides, builder.under(slides).call(contact.is_instant, best, longest), name="stuck")
        sliding = Sliding(self.motion, self.barriers, search.moment_of, search.state, search.tolerance, self.resolution)
        sliding.write(builder.under(stuck), search.step, best, pressed, fade)

    def _starts(self, whole: Moment, state: State) -> list[tuple[Column, Column] | None]:
        """Write the distance of each surface that has one as a step starts, and its normal."""
        return [
            None if is_barrier(surface) else distance_of(self.motion, surface, whole, state, begins=True)
            for surface in self.surfaces
        ]

    def _free_step(
        self,
        builder: Builder,
        whole: Moment,
        state: State,
        step: Column,
        fade: Callable[[Builder, Column], None],
        pacing: Pacing | None,
    ) -> None:
        """Write one step that nothing stops; in the paper's scheme surfaces mirror at its end."""
        start = self.start(builder, state)
        first = kept_state(builder, state) if pacing is not None else {}
        errors = self.motion.step(whole, state)
        if pacing is not None and errors is not None:
            builder = pacing.judge(builder, state, first, step, errors)
        fade(builder, step)
        self.main_step(whole, state, None, start)

    def _chosen(self, builder: Builder, candidate: Candidate, best: Column) -> Column:
        """Return who meets a surface at the time `best`; who was held or ended by one before meets it next, or never."""
        first = builder.under(candidate.hit).call(basic.is_equal, candidate.time, best)
        chosen: Column = builder.call(basic.both, candidate.hit, first, name="chosen")
        if self.fate is not None:
            chosen = builder.call(basic.both, chosen, builder.call(events.is_going_on, self.fate.fate), name="chosen")
        return chosen

    def start(self, builder: Builder, state: State) -> dict[str, Column]:
        """Keep where a step starts, if a surface asks for it; its velocity too where contacts are located."""
        crossed = [surface for surface in self.surfaces if not is_barrier(surface) and self.crossings.concern(surface)]
        if crossed:
            return remember(builder, state)
        barriers = self.barriers.surfaces
        return {"position": builder.call(basic.copy_vector, state.position, name="start")} if barriers else {}

    def _answer(
        self,
        candidate: Candidate,
        builder: Builder,
        moment_of: MomentOf,
        state: State,
        time: Column,
        resting: Column | None,
        tolerance: Column,
        mean: Column,
    ) -> Column:
        """Write what a surface does to the particles that meet it; return which of them slide."""
        moment, surface = moment_of(builder, time), candidate.surface
        distance, normal = distance_from(self.motion, surface, moment, state, candidate.plane)
        if candidate.plane is not None:
            distance = builder.call(barrier.from_above, distance, tolerance, name="distance")
        response = self._response(surface, moment, ("resilience", "friction", "friction_threshold", "rest_speed"))
        given = (state.read("velocity"), normal, mean, response[3], self.resolution, tolerance)
        response[3] = builder.call(settling.least_speed, *given, name="least speed")
        stopped, sliding = Column("stopped", "bool"), Column("sliding", "bool")
        into: Any = (state.position, state.velocity, stopped, sliding)
        concerned = self.hits.concern(surface)
        speed = builder.call(events.approach, into[1], normal, name="speed") if concerned else None
        builder.call(contact.respond, *into[:2], distance, normal, *response, into=into)
        if moves(surface):  # it carries along who would rest on it
            sliding = builder.call(basic.either, sliding, stopped, name="sliding")
            stopped = builder.call(basic.but_not, stopped, stopped, name="stopped")
        if speed is not None:
            self._tell(Hit(surface, builder, into[0], normal, speed, stopped), moment, state, moment.end())
        if resting is not None:
            builder.under(builder.program.context).call(basic.either, resting, stopped, into=resting)
        return sliding


def _any_of(builder: Builder, masks: list[Column]) -> Column:
    """Write where any mask is on."""
    found, *others = masks
    for mask in others:
        found = builder.call(basic.either, found, mask, name="met")
    return found
