"""Write the programs of a frame: `main` for particles that live through all of it, `own` for those with a time of their own.

`main` gives every particle the same steps. Where a particle meets a surface it is rejected, unchanged.
`own` takes those, the newborn and the dying, gathered into dense blocks: each has its own begin and end
inside the frame, and stops at every contact. Times are in seconds from the start of the frame, so their
precision does not depend on how long the cook has run.
"""

from __future__ import annotations

from typing import Any

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Value
from graphfx.motion import basic
from graphfx.node import ATTRIBUTES
from graphfx.plan.contacts import Contacts
from graphfx.plan.frame_program import FrameProgram, LazyClock
from graphfx.plan.liveness import Attributes
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Motion
from graphfx.plan.rates import Scope, lane_type
from graphfx.plan.sharing import share
from graphfx.plan.values import StepValues, ValueWriter
from graphfx.program import Builder, Column, Operand, Uniform

ZERO_TIME = Uniform("0", "float", 0.0)
MOST_CONTACTS = 100
"""Contacts of one particle in one step; one that has more is reported and rests."""


class FrameWriter:
    """Writes the programs of one emitter's particles."""

    def __init__(self, emitter: FlatNode, attributes: Attributes, motion: Motion, seed: int, precision: int, substeps: int):
        self.emitter = emitter
        self.attributes = attributes
        self.motion = motion
        self.seed = seed
        self.precision = precision
        self.substeps = substeps
        self.constants: dict[str, Uniform] = {}
        self.shared: dict[int, Operand] = {}

    def main(self, opening_step: int) -> FrameProgram:
        """Return the program for whole steps; the shutter opens in substep `opening_step` (-1: no motion blur)."""
        builder = Builder.begin(f"{self.emitter.path}: motion")
        made = FrameProgram(builder.program, [], cells=self.motion.cells)
        state = self._state(builder)
        self.shared = {}
        resting = builder.load("resting", "bool") if "resting" in self.attributes.columns else None
        tail = Column("tail", "vec3")
        if opening_step >= 0 and resting is not None:
            builder.call(basic.copy_vector, state.position, into=tail)
        active = (
            builder.under(builder.call(basic.but_not, builder.mask, resting, name="moving")) if resting is not None else builder
        )
        contacts = Contacts(self.motion, self.precision)
        event: Column | None = None
        for k in range(self.substeps):
            moment = self._uniform_moment(active, made, k, state)
            if k == 0:
                self.motion.prepare(moment, state)
            before = active.call(basic.copy_vector, state.position, name="before") if k == opening_step else None
            self.motion.step(moment, state)
            event = contacts.main_step(moment, state, event)
            if before is not None:
                active.note = "motion blur"
                opening = [made.time(active, name) for name in (("start", k), ("end", k), "opening")]
                active.call(basic.capture, before, before, state.position, *opening, into=tail)
        self._store(builder, state, tail if opening_step >= 0 else None)
        builder.program.rejects = event if self.motion.method != "sims" else None
        share(made.program)
        return made

    def own(self, motion_blur: bool) -> FrameProgram:
        """Return the program for particles with times of their own: `begin` and `end` come by place."""
        builder = Builder.begin(f"{self.emitter.path}: motion in own time")
        made = FrameProgram(builder.program, [], cells=self.motion.cells)
        state = self._state(builder)
        self.shared = {}
        now, end = builder.load("begin", "float"), builder.load("end", "float")
        resting = builder.load("resting", "bool") if "resting" in self.attributes.columns else None
        tail = builder.call(basic.copy_vector, state.position, name="tail") if motion_blur else None
        start = made.time(builder, "frame start")
        first = self._lane_moment(builder, made, 0, now, now, start)
        self.motion.prepare(first, state)
        unfinished: Column | None = None
        for k in range(self.substeps):
            finish = builder.call(basic.earlier, end, made.time(builder, ("end", k)), name="finish")
            going = builder.call(basic.is_less, now, finish, name="going")
            if resting is not None:
                going = builder.call(basic.but_not, going, resting, into=going)
            inner = builder.loop(going, MOST_CONTACTS, "until the particle's end")
            self._own_step(inner, made, k, state, now, finish, start, resting, tail)
            again = inner.call(basic.is_less, now, finish)
            if resting is not None:
                again = inner.call(basic.but_not, again, resting)
            inner.call(basic.both, again, again, into=going)
            left = builder.call(basic.both, going, going, name="unfinished")
            unfinished = left if unfinished is None else builder.call(basic.either, unfinished, left)
        if resting is not None and unfinished is not None:
            resting = builder.call(basic.either, resting, unfinished)
            builder.store("resting", resting)
        self._store(builder, state, tail)
        if unfinished is not None:
            made.program.stores["unfinished"] = unfinished
        share(made.program)
        return made

    def _own_step(
        self,
        inner: Builder,
        made: FrameProgram,
        k: int,
        state: State,
        now: Column,
        finish: Column,
        start: Operand,
        resting: Column | None,
        tail: Column | None,
    ) -> None:
        """Write one turn of the loop: go to the end of the step, or to the first contact on the way."""
        step = inner.call(basic.difference, finish, now, name="step")
        before = inner.call(basic.copy_vector, state.position, name="before") if tail is not None else None
        then = inner.call(basic.copy_number, now, name="then")
        contacts = Contacts(self.motion, self.precision)

        def moment_of(builder: Builder, dt: Column) -> Moment:
            return self._lane_moment(builder, made, k, then, dt, start)

        contacts.own_step(inner, moment_of, state, step, resting)
        inner.call(basic.sum_of_numbers, then, step, into=now)
        reached = inner.call(basic.is_equal, step, inner.call(basic.difference, finish, then))
        inner.under(reached).call(basic.copy_number, finish, into=now)
        if before is not None and tail is not None:
            inner.note = "motion blur"
            opening = made.time(inner, "opening")
            inner.call(basic.capture, tail, before, state.position, then, now, opening, into=tail)

    def _scope(self, builder: Builder, state_read: Any) -> Scope:
        columns = self.attributes.columns
        return Scope(
            self.seed,
            self.emitter.path,
            state_read,
            lambda: builder.load("id", "id"),
            lambda name: name in columns or name in ("age", "normalized_age"),
        )

    def _state(self, builder: Builder) -> State:
        columns = self.attributes.columns

        def attribute(name: str) -> Operand:
            if name in columns:
                return builder.load(name, lane_type(ATTRIBUTES[name].type))
            return self.constant(name)

        has_velocity = self.motion.has_velocity
        return State(attribute("position"), attribute("velocity") if has_velocity else None, attribute)

    def constant(self, name: str) -> Uniform:
        """Return an attribute that is one for all."""
        if name not in self.constants:
            value: Value = self.attributes.constants[name]
            scope = Scope(self.seed, self.emitter.path, self.constant, None, lambda inner: False)  # type: ignore[arg-type]
            found = ValueWriter(Builder.begin("constant"), scope, {}, None, self.precision).operand(value)
            assert isinstance(found, Uniform)
            self.constants[name] = found
        return self.constants[name]

    def _uniform_moment(self, builder: Builder, made: FrameProgram, k: int, state: State) -> Moment:
        steps = StepValues()
        made.steps.append(steps)
        scope = self._scope(builder, self._reader(builder, state, lambda: made.time(builder, ("middle", k))))
        clock = LazyClock({"frame word": lambda: made.time(builder, "frame word")}, lambda path: made.mesh(builder, path, k))
        writer = self._share(ValueWriter(builder, scope, clock, steps, self.precision))
        return Moment(
            builder,
            made.time(builder, "length"),
            lambda: made.time(builder, "half"),
            writer,
            made.time(builder, ("start", k)) if self.motion.cells > 1 else ZERO_TIME,
            lambda kind, p: made.time(builder, (kind, k, p)),
        )

    def _share(self, writer: ValueWriter) -> ValueWriter:
        writer.shared = self.shared
        return writer

    def _lane_moment(self, builder: Builder, made: FrameProgram, k: int, then: Column, dt: Column, start: Operand) -> Moment:
        lane = LazyClock(
            {
                "half": lambda: builder.call(basic.half, dt, name="half"),
                "middle": lambda: builder.call(basic.sum_of_numbers, then, lane["half"], name="middle"),
                "time": lambda: builder.call(basic.sum_of_numbers, start, lane["middle"], name="time"),
                "frame": lambda: made.time(builder, "frame"),
                "frame word": lambda: made.time(builder, "frame word"),
            },
            lambda path: made.mesh(builder, path, k),
        )
        state = self._state(builder)
        scope = self._scope(builder, self._reader(builder, state, lambda: lane["middle"]))
        writer = self._share(ValueWriter(builder, scope, lane, None, self.precision))
        return Moment(builder, dt, lambda: lane["half"], writer, then, lambda kind, p: made.time(builder, (kind, k, p)))

    def _reader(self, builder: Builder, state: State, middle: Any) -> Any:
        def read(name: str) -> Operand:
            if name == "age":
                return builder.call(basic.sum_of_numbers, builder.load("age", "float"), middle(), name="age")
            if name == "normalized_age":
                from graphfx.plan.arithmetic import function_for

                life = state.attribute("life")
                return builder.call(function_for("divide", ("float", "float")), read("age"), life, name="normalized_age")
            return state.read(name)

        return read

    def _store(self, builder: Builder, state: State, tail: Column | None) -> None:
        for name, operand in (("position", state.position), ("velocity", state.velocity)):
            if isinstance(operand, Column) and name in self.attributes.columns:
                builder.store(name, operand)
        if tail is not None and "tail" in self.attributes.columns:
            builder.store("tail", tail)
