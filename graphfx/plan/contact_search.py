"""Write the search for contacts within a step: who meets a surface, and when."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from graphfx.motion import barrier, basic, contact, crossing, settling
from graphfx.plan.barriers import Barriers, Plane
from graphfx.plan.crossing import Crossings, MomentOf, Search, Way, way_of
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Motion, Mover
from graphfx.plan.scheme import put_back
from graphfx.plan.surfaces import distance_of
from graphfx.program import Builder, Column, Operand, Uniform

RESOLUTION = {32: 2.0**-20, 64: 2.0**-49}
"""Eight units in the last place."""
SEARCH_LIMIT = 60
"""Evaluations in the search for one contact; ten are usual."""
TRIES = 16
"""How often a way is shortened because the contact found lies behind another face."""


def distance_from(
    motion: Motion, surface: Mover, moment: Moment, state: State, plane: Plane | None = None
) -> tuple[Column, Column]:
    """Write the signed distance from a surface as a step ends, or from the plane at which it is met, and the normal there."""
    moment.builder.note = surface.node.path
    return distance_of(motion, surface, moment, state) if plane is None else plane.distance(moment.builder, state.position)


def remember(builder: Builder, state: State) -> dict[str, Column]:
    """Keep where a step starts."""
    assert state.velocity is not None
    first = builder.call(crossing.start, state.position, state.velocity, name="start velocity")
    return dict(zip(("position", "velocity"), first, strict=True))


@dataclass
class Candidate:
    """A surface that particles may meet in a step: who does, when, its distance and normal at the start and that at the end.

    The contact lies within `span`: the whole step, or the time to a place inside for who is outside at both ends.
    """

    surface: Mover
    hit: Column
    start: tuple[Column, Column]
    end: Column
    span: Column
    plane: Plane | None = None
    concerned: Column | None = None
    time: Column = field(default_factory=lambda: Column("time of contact", "float"))


class ContactSearch:
    """The search for the contacts of one step that starts at `first`."""

    tolerance: Column
    mean: Column
    """The mean acceleration over the whole step."""

    def __init__(
        self,
        motion: Motion,
        barriers: Barriers,
        moment_of: MomentOf,
        state: State,
        first: dict[str, Column],
        step: Column,
        resolution: Uniform,
    ):
        self.motion, self.barriers, self.moment_of = motion, barriers, moment_of
        self.state, self.first, self.step, self.resolution = state, first, step, resolution
        self.crossings = Crossings(motion)

    def candidates(self, surfaces: list[Mover], whole: Moment, starts: list[tuple[Column, Column] | None]) -> list[Candidate]:
        """Write who meets each surface in the whole step."""
        velocities = self.first["velocity"], self.state.read("velocity")
        self.mean = whole.builder.call(settling.mean, *velocities, self.step, name="mean acceleration")
        way = way_of(self.motion, whole.builder, self.first, self.state, self.step)
        return [self.candidate(surface, whole, start, way) for surface, start in zip(surfaces, starts, strict=True)]

    def candidate(self, surface: Mover, whole: Moment, start: tuple[Column, Column] | None, way: Way) -> Candidate:
        """Write who meets a surface in the whole step."""
        if start is not None:
            end = distance_of(self.motion, surface, whole, self.state)
            concerned = self.motion.under_conditions(surface, whole)
            hit = concerned.call(contact.is_inside, end[0], name="inside")
            found = Candidate(surface, hit, start, end[0], self.step)
            doubtful = self.crossings.possible(surface, whole, self.state, way, end, concerned)
            if doubtful is not None:
                self._crossed(found, whole.builder.under(doubtful), way)
            return found
        concerned = self.motion.under_conditions(surface, whole)
        plane = self.barriers.meet(surface, whole, self.state, concerned, (self.first["position"], self.state.position))
        return self._of_plane(plane, whole.builder, self.state.position, concerned.mask)

    def _crossed(self, candidate: Candidate, builder: Builder, way: Way) -> None:
        """Write who has crossed a surface and come out again: the true path at the time found inside bounds the search."""
        surface, state = candidate.surface, self.state
        last = {
            "position": builder.call(basic.copy_vector, state.position, name="last position"),
            "velocity": builder.call(basic.copy_vector, state.read("velocity"), name="last velocity"),
        }
        end = last["velocity"] if way.end is state.velocity else way.end
        way = replace(way, last=last["position"], end=end)
        search = Search(self.motion, surface, self.moment_of, state, way, self.step, self.tolerance)
        found, share = search.find(builder, candidate.start)
        inner = builder.under(found)
        time = inner.call(crossing.share_of, share, self.step, name="time inside")
        put_back(inner, state, self.first)
        moment = self.moment_of(inner, time)
        self.motion.step(moment, state)
        distance, _ = distance_of(self.motion, surface, moment, state)
        inside = inner.call(contact.is_inside, distance, name="inside")
        put_back(inner, state, last)
        candidate.span = builder.under(builder.program.context).call(basic.copy_number, self.step, name="span")
        builder.under(inside).call(basic.copy_number, time, into=candidate.span)
        builder.under(inside).call(basic.copy_number, distance, into=candidate.end)
        builder.under(builder.program.context).call(basic.either, candidate.hit, inside, into=candidate.hit)

    def _of_plane(self, plane: Plane, builder: Builder, end: Operand, concerned: Column | None = None) -> Candidate:
        inside = builder.under(plane.hit)
        start = plane.distance(inside, self.first["position"])
        below = inside.call(barrier.surely_below, plane.distance(inside, end)[0], self.tolerance)
        return Candidate(plane.surface, plane.hit, start, below, self.step, plane, concerned)

    def find(self, candidate: Candidate, builder: Builder, best: Column) -> None:
        """Write the search for the instant of a contact within its span; `best` becomes it if it is earlier."""
        builder.note = f"{candidate.surface.node.path}: find the contact"
        state, resolution = self.state, self.resolution
        a, at_a, b, at_b, touching, at_once = builder.call(
            contact.start_search,
            candidate.start[0],
            candidate.end,
            candidate.start[1],
            self.first["velocity"],
            candidate.span,
            self.tolerance,
            name="a at_a b at_b touching at_once",
        )
        time = candidate.time
        builder.call(basic.copy_number, a, into=time)
        side = builder.call(basic.difference, a, a, name="side")
        searching = builder.call(basic.but_not, builder.mask, at_once, name="searching")
        inner = builder.loop(searching, SEARCH_LIMIT, builder.note)
        inner.call(contact.propose, a, at_a, b, at_b, into=time)
        put_back(inner, state, self.first)
        moment = self.moment_of(inner, time)
        self.motion.step(moment, state)
        distance, _ = distance_from(self.motion, candidate.surface, moment, state, candidate.plane)
        bracket = (a, at_a, b, at_b, side)
        inner.call(contact.narrow, *bracket, time, distance, touching, into=bracket)
        inner.call(contact.is_open, a, b, distance, candidate.span, self.tolerance, resolution, into=searching)
        builder.call(basic.earlier, time, best, into=best)

    def shorten(self, builder: Builder, candidates: list[Candidate], best: Column) -> None:
        """Write the check that nothing stands in the way to the contact: where it does, that is the contact, and so on.

        Who still finds something in the way at last, in a narrow corner, is turned back with half the speed.
        """
        doubtful = builder.call(basic.both, builder.mask, builder.mask, name="doubtful")
        inner = builder.loop(doubtful, TRIES, "nothing in the way")
        again = inner.call(basic.but_not, doubtful, doubtful, name="again")
        for candidate in candidates:
            if candidate.plane is not None:
                more = self._again(inner, candidate, best)
                inner.call(basic.either, again, more, into=again)
                inner.under(builder.mask).call(basic.either, candidate.hit, more, into=candidate.hit)
        inner.call(basic.both, again, again, into=doubtful)
        left = builder.under(doubtful)
        put_back(left, self.state, self.first)
        left.call(barrier.turned_back, self.state.velocity, into=self.state.velocity)  # type: ignore[arg-type]
        left.call(basic.copy_number, self.step, into=best)
        for candidate in candidates:
            builder.call(basic.but_not, candidate.hit, doubtful, into=candidate.hit)

    def _again(self, inner: Builder, candidate: Candidate, best: Column) -> Column:
        """Write whose way to the contact meets a surface once more, and have that be the contact."""
        assert candidate.plane is not None and candidate.concerned is not None
        concerned = inner.under(inner.call(basic.both, inner.mask, candidate.concerned))
        put = concerned.call(basic.copy_vector, self.state.position, name="put")
        own = concerned.under(concerned.call(basic.both, concerned.mask, candidate.hit))
        above = own.call(barrier.from_above, candidate.plane.distance(own, self.state.position)[0], self.tolerance, name="above")
        own.call(barrier.put_above, put, candidate.plane.normal, above, candidate.time, best, into=put)
        moment = self.moment_of(concerned, best)
        plane = self.barriers.meet(candidate.surface, moment, self.state, concerned, (self.first["position"], put))
        fresh = inner.under(plane.hit)
        found = self._of_plane(plane, fresh, put)
        candidate.plane.take(fresh, plane)
        found.plane, found.time = candidate.plane, candidate.time
        found.span = fresh.call(basic.copy_number, best, name="limit")
        self.find(found, fresh, best)
        put_back(fresh, self.state, self.first)
        self.motion.step(self.moment_of(fresh, best), self.state)
        return plane.hit
