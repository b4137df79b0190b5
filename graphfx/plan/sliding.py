"""Write a step along surfaces, for particles that are pressed on one and cannot leave; another in the way ends it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphfx.motion import basic, contact, crossing
from graphfx.plan.barriers import Barriers, is_barrier
from graphfx.plan.contact_search import SEARCH_LIMIT, remember
from graphfx.plan.crossing import NOUGHT, MomentOf
from graphfx.plan.moment import State
from graphfx.plan.motion import Motion, Mover
from graphfx.plan.scheme import put_back
from graphfx.plan.surfaces import distance_of
from graphfx.program import Builder, Column, Uniform


@dataclass
class Sliding:
    """The steps along the surfaces of one source."""

    motion: Motion
    barriers: Barriers
    moment_of: MomentOf
    state: State
    tolerance: Column
    resolution: Uniform

    @property
    def solids(self) -> list[Mover]:
        """Return the surfaces with a signed distance."""
        return [surface for surface in self.motion.of("surface") if not is_barrier(surface)]

    def write(
        self, builder: Builder, step: Column, used: Column, pressed: dict[str, Column], fade: Callable[[Builder, Column], None]
    ) -> None:
        """Write the step for those under the builder's mask, `pressed` on surfaces by path; `used` becomes its time."""
        first = remember(builder, self.state)
        before = builder.call(basic.copy_number, used, name="used")
        builder.call(basic.copy_number, step, into=used)
        if len(self.solids) > 1:
            self._along_to(builder, first, step, used, pressed)
        else:
            self._along(builder, step, {})
        fade(builder, builder.call(basic.difference, used, before, name="slid for"))
        if self.barriers.surfaces:
            self.barriers.slide(self.moment_of(builder, used), self.state, first["position"], self.tolerance)

    def _along(self, builder: Builder, time: Column, apart: dict[str, Column]) -> None:
        """Write the motion over a time, and put particles back on the surfaces, but for those from which they are apart."""
        moment, state = self.moment_of(builder, time), self.state
        starts = [distance_of(self.motion, surface, moment, state, begins=True)[1] for surface in self.solids]
        first = builder.call(basic.copy_vector, state.read("velocity"), name="first velocity")
        self.motion.step(moment, state)
        for surface, start in zip(self.solids, starts, strict=True):
            inside = self.motion.under_conditions(surface, moment)
            if surface.node.path in apart:
                inside = inside.under(inside.call(basic.but_not, inside.mask, apart[surface.node.path], name="on it"))
            distance, normal = distance_of(self.motion, surface, moment, state)
            into = (state.position, state.velocity)
            inside.call(contact.slide, first, *into, distance, start, normal, into=into)  # type: ignore[arg-type]

    def _along_to(
        self, builder: Builder, first: dict[str, Column], step: Column, used: Column, pressed: dict[str, Column]
    ) -> None:
        """Write the step from `first` as far as the first surface that the particle did not stand on."""
        starts: dict[str, Column] = {}
        ends: dict[str, Column] = {}
        apart: dict[str, Column] = {}
        blocked: dict[str, Column] = {}
        moment = self.moment_of(builder, step)
        for surface in self.solids:
            path = surface.node.path
            starts[path], _ = distance_of(self.motion, surface, moment, self.state, begins=True)
            stands = builder.call(crossing.meets, starts[path], NOUGHT, self.tolerance, name="stands")
            stands = builder.call(basic.either, stands, pressed[path]) if path in pressed else stands
            apart[path] = builder.call(basic.but_not, builder.mask, stands, name="apart")
        self._along(builder, step, apart)
        for surface in self.solids:
            path = surface.node.path
            ends[path], _ = distance_of(self.motion, surface, moment, self.state)
            concerned = self.motion.under_conditions(surface, moment)
            deep = concerned.call(crossing.is_deep, ends[path], self.tolerance, name="deep")
            blocked[path] = builder.call(basic.both, deep, apart[path], name="blocked")
        for surface in self.solids:
            path = surface.node.path
            self._find(builder.under(blocked[path]), surface, first, (starts[path], ends[path]), step, used, apart)
        put_back(builder, self.state, first)
        self._along(builder, used, blocked)

    def _find(
        self,
        builder: Builder,
        surface: Mover,
        first: dict[str, Column],
        distances: tuple[Column, Column],
        step: Column,
        used: Column,
        apart: dict[str, Column],
    ) -> None:
        """Write the search for the time at which a surface ends the step; `used` becomes it if it is earlier."""
        builder.note = f"{surface.node.path}: find the end of the slide"
        names = ("a", "at_a", "b", "at_b", "side", "time")
        given = (NOUGHT, distances[0], step, distances[1], NOUGHT, NOUGHT)
        *bracket, time = (builder.call(basic.copy_number, value, name=name) for name, value in zip(names, given, strict=True))
        searching = builder.call(basic.both, builder.mask, builder.mask, name="searching")
        inner = builder.loop(searching, SEARCH_LIMIT, builder.note)
        inner.call(contact.propose, *bracket[:4], into=time)
        put_back(inner, self.state, first)
        self._along(inner, time, apart)
        distance, _ = distance_of(self.motion, surface, self.moment_of(inner, time), self.state)
        inner.call(contact.narrow, *bracket, time, distance, NOUGHT, into=tuple(bracket))
        inner.call(contact.is_open, bracket[0], bracket[2], distance, step, self.tolerance, self.resolution, into=searching)
        builder.call(basic.earlier, time, used, into=used)
