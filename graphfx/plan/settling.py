"""Write the end of infinitely many bounces: who hops on a flat surface goes on to its rest at once: see motion/settling.py."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphfx.graph.values import Literal
from graphfx.motion import basic, crossing, settling
from graphfx.node import INFINITY
from graphfx.plan.barriers import is_barrier
from graphfx.plan.contact_search import Candidate, ContactSearch
from graphfx.plan.hits import response_of
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Mover
from graphfx.plan.scheme import put_back
from graphfx.plan.surfaces import distance_of, moves
from graphfx.program import Builder, Column, Operand, Uniform, constant_number

COARSE = {32: 2.0**4, 64: 2.0**19}
"""The tolerance of a series, in tolerances of contacts: 2^-16 or 2^-30 of the greatest coordinate, and 1 m at least."""
NOUGHT, ANY = Uniform("0", "float", 0.0), Uniform("inf", "float", INFINITY)


@dataclass
class Settled:
    """Who has settled in this turn, and where, with which velocity and after what time."""

    who: Column
    place: Column
    velocity: Column
    time: Column

    def take(self, builder: Builder, state: State, best: Column, step: Column, met: Column) -> Column:
        """Write their states, and the time that each has used; return them with those who have `met` a surface."""
        builder.note = "settle"
        inner = builder.under(self.who)
        put_back(inner, state, {"position": self.place, "velocity": self.velocity})
        for time in (best, step):
            inner.call(basic.copy_number, self.time, into=time)
        return builder.call(basic.either, met, self.who, name="met")  # type: ignore[no-any-return]


@dataclass
class Settling:
    """The series of the surfaces of one source. `response` gives the operands of how a particle answers, `heard` tells
    whether anything follows from the hits of a surface; `longest` is a whole step."""

    search: ContactSearch
    response: Callable[[Mover, Moment, tuple[str, ...]], list[Operand]]
    heard: Callable[[Mover], bool]
    longest: Operand
    precision: int

    def write(self, builder: Builder, candidates: list[Candidate], whole: Moment) -> Settled | None:
        """Write who settles, of those who would meet a surface on which they stand; they meet none in this turn."""
        bouncing = [candidate for candidate in candidates if bounces(candidate.surface)]
        if not bouncing:
            return None
        builder.note = "settle"
        first = self.search.first
        who = builder.call(basic.but_not, builder.mask, builder.mask, name="settled")
        place = builder.call(basic.copy_vector, first["position"], name="settled at")
        velocity = builder.call(basic.copy_vector, first["velocity"], name="settled velocity")
        made = Settled(who, place, velocity, builder.call(basic.copy_number, NOUGHT, name="settled in"))
        for candidate in bouncing:
            self._try(builder, candidate, candidates, whole, self.search.mean, made)
        for candidate in candidates:
            candidate.hit = builder.call(basic.but_not, candidate.hit, who, name="hit")
        return made

    def _try(
        self, builder: Builder, candidate: Candidate, candidates: list[Candidate], whole: Moment, mean: Column, made: Settled
    ) -> None:
        """Write the settling on one surface."""
        surface, first, step = candidate.surface, self.search.first, self.search.step
        builder.note = f"{surface.node.path}: settle"
        inside = builder.under(builder.call(basic.but_not, candidate.hit, made.who))
        event = whole.writer.argument(surface.node.arguments["event_speed"]) if self.heard(surface) else ANY
        distance, normal = candidate.start
        velocity, tolerance = first["velocity"], self.search.tolerance
        least = inside.call(
            settling.least_speed, velocity, normal, mean, NOUGHT, self.search.resolution, tolerance, name="least speed"
        )
        given = (distance, tolerance, normal, velocity, mean, step, self.longest, event, least)
        hopping, brief = inside.call(settling.hops, *given, name="hopping brief")
        inner = builder.loop(hopping, 1, builder.note)
        fits = None
        if not is_barrier(surface) and not moves(surface):
            fits = self._series(inner, candidate, candidates, mean, made)
        laid = inner.call(basic.both, hopping, brief, name="laid")
        laid = laid if fits is None else inner.call(basic.but_not, laid, fits, name="laid")
        under = inner.under(laid)
        under.call(basic.copy_vector, first["position"], into=made.place)
        limits = self.response(surface, whole, ("friction", "friction_threshold"))
        under.call(settling.slowed_down, velocity, normal, *limits, into=made.velocity)
        under.call(basic.copy_number, NOUGHT, into=made.time)
        everywhere = inner.under(inner.program.context)
        for found in (laid, fits):
            if found is not None:
                everywhere.call(basic.either, made.who, found, into=made.who)

    def _series(
        self, builder: Builder, candidate: Candidate, candidates: list[Candidate], mean: Column, made: Settled
    ) -> Column:
        """Write the flights of those under the builder's mask, and for whom they are what the motion is."""
        search, surface, normal = self.search, candidate.surface, candidate.start[1]
        first, state, step, velocity = search.first, search.state, search.step, search.first["velocity"]
        moment = search.moment_of(builder, step)
        given = self.response(surface, moment, ("resilience", "friction", "friction_threshold", "rest_speed"))
        coarse = constant_number(COARSE[self.precision])
        tolerance = builder.call(crossing.share_of, coarse, search.tolerance, name="tolerance")
        long, short = builder.call(settling.duration, velocity, normal, mean, given[0], step, name="long short")
        pull = self._acceleration(builder, first, long)
        early = self._acceleration(builder, first, short)
        time, way, after, fits = builder.call(settling.series, velocity, normal, pull, *given, step, name="time way after fits")
        steady = (velocity, normal, long, tolerance)
        fits = builder.call(basic.both, fits, builder.call(settling.is_constant, pull, early, *steady), name="fits")
        place = builder.call(basic.sum_of_vectors, first["position"], way, name="place")
        ended = search.moment_of(builder, time)
        distance, there = distance_of(search.motion, surface, ended, state, place)
        level = builder.call(settling.is_level, normal, there, distance, velocity, time, tolerance, name="level")
        fits = builder.call(basic.both, fits, level, name="fits")
        builder.call(settling.put_back, place, there, distance, into=place)
        late = self._acceleration(builder, {"position": place, "velocity": after}, short)
        fits = builder.call(basic.both, fits, builder.call(settling.is_constant, pull, late, *steady), name="fits")
        extent = builder.call(settling.extent, velocity, pull, time, name="extent")
        for other in candidates:
            if other is not candidate:
                fits = builder.call(basic.but_not, fits, self._blocked(builder, other, place, ended, extent), name="fits")
        found = builder.under(fits)
        for value, into in ((place, made.place), (after, made.velocity)):
            found.call(basic.copy_vector, value, into=into)
        found.call(basic.copy_number, time, into=made.time)
        return fits

    def _acceleration(self, builder: Builder, start: dict[str, Column], dt: Column) -> Column:
        """Write the mean acceleration over a time from a state."""
        search, name = self.search, "acceleration"
        put_back(builder, search.state, start)
        search.motion.step(search.moment_of(builder, dt), search.state)
        found: Column = builder.call(settling.mean, start["velocity"], search.state.read("velocity"), dt, name=name)
        return found

    def _blocked(self, builder: Builder, other: Candidate, place: Column, moment: Moment, extent: Column) -> Column:
        """Write for whom another surface may be in the way."""
        search = self.search
        if other.plane is not None:
            way = (search.first["position"], place)
            concerned = search.motion.under_conditions(other.surface, moment)
            return search.barriers.meet(other.surface, moment, search.state, concerned, way).hit
        distance, _ = distance_of(search.motion, other.surface, moment, search.state, place)
        return builder.call(crossing.meets, other.start[0], distance, extent, name="blocked")  # type: ignore[no-any-return]


def bounces(surface: Mover) -> bool:
    """Return whether particles may bounce off a surface for ever, ever lower."""
    resilience = surface.node.arguments["resilience"]
    never = isinstance(resilience, Literal) and resilience.value in (0.0, 1.0)
    return response_of(surface.node) == "bounce" and not never
