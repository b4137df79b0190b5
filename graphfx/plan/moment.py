"""A particle's state, and a step or an instant in time, as the operands that programs are written with.

Times are in seconds from the start of the frame, so their precision does not depend on how long the
cook has run; only what a value reads as `time` counts from the first frame.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from graphfx.motion import basic, events, pacing
from graphfx.plan.arithmetic import function_for
from graphfx.plan.frame_program import FrameProgram, LazyClock
from graphfx.plan.holder import Holder
from graphfx.plan.liveness import Attributes
from graphfx.plan.rates import NOUGHT, Scope
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Operand, Uniform, constant_number

ZERO_TIME = Uniform("0", "float", 0.0)
ONE = Uniform("1", "float", 1.0)
ZERO = Uniform("(0, 0, 0)", "vec3", (0.0, 0.0, 0.0))
AGES = ("age", "normalized_age")


@dataclass
class State:
    """The operands that hold a particle's state; `position` and `velocity` are columns wherever they change."""

    position: Operand
    velocity: Operand | None
    attribute: Callable[[str], Operand]

    def read(self, name: str) -> Operand:
        """Return the operand of an attribute."""
        if name == "position":
            return self.position
        return self.velocity if name == "velocity" and self.velocity is not None else self.attribute(name)


@dataclass
class Moment:
    """A step at which motion is written: `dt` [s], a writer whose clock stands in the middle of it, its begin and end.

    `cell_time` gives a time of the p-th cell of noise that the step meets, see `motion.clock.cell_time`; `born` when a
    particle was born, where that may be within the step. All are from the start of the frame [s]. `opening` and `closing`
    are writers whose clock stands at the step's begin and end. `part` gives the number-th of `count` equal parts of it. A
    step known to lie in one cell has its number as `cell`; `instant` gives the instant after a share of a particle's own. It
    is the `k`-th of its frame, or lies in that.
    """

    builder: Builder
    dt: Operand
    half: Callable[[], Operand]
    writer: ValueWriter
    then: Operand
    cell_time: Callable[[str, int], Operand]
    end: Callable[[], Operand]
    opening: Callable[[], ValueWriter]
    closing: Callable[[], ValueWriter]
    part: Callable[[int, int], Moment]
    cell: int | None = None
    born: Callable[[], Operand] | None = None
    instant: Callable[[float], Moment] = field(repr=False, default=None)  # type: ignore[assignment]
    made: FrameProgram | None = None
    k: int = 0
    conditions: ValueWriter | None = None
    """What finds whom operators act on, where that is another one than `writer`."""


@dataclass
class Constants:
    """The attributes of one source that are one for all, found when they are asked for."""

    holder: Holder
    attributes: Attributes
    seed: int
    precision: int
    found: dict[str, Uniform] = field(default_factory=dict)

    def find(self, name: str) -> Uniform:
        """Return such an attribute."""
        if name not in self.found:
            value = self.attributes.constants.get(name)
            if value is None:
                value = self.holder.value(name.removeprefix("birth."))
            scope = Scope(self.seed, self.holder.path, self.find, None, lambda inner: False)  # type: ignore[arg-type]
            made = ValueWriter(Builder.begin("constant"), scope, {}, None, self.precision).operand(value)
            assert isinstance(made, Uniform)
            self.found[name] = made
        return self.found[name]


@dataclass
class Moments:
    """Makes the moments of one program. `constants` finds the attributes that are one for all.

    `shared` holds what was found for the whole program, by id of the value.
    """

    seed: int
    path: str
    precision: int
    attributes: Attributes
    constant: Callable[[str], Uniform]
    made: FrameProgram
    shared: dict[int, Operand] = field(default_factory=dict)

    def state(self, builder: Builder, has_velocity: bool, position: str = "position") -> State:
        """Return the state of a particle: what is stored is loaded."""
        types = self.attributes.types

        def attribute(name: str) -> Operand:
            if name in types:
                return builder.load(position if name == "position" else name, types[name])
            return self.constant(name)

        return State(attribute("position"), attribute("velocity") if has_velocity else None, attribute)

    def _scope(self, builder: Builder, state: State, age_at: Callable[[], Operand], told: dict[str, Operand]) -> Scope:
        types = self.attributes.types

        def read(name: str) -> Operand:
            if name in told:
                return told[name]
            if name == "age":
                return builder.call(basic.sum_of_numbers, builder.load("age", "float"), age_at(), name="age")
            if name == "normalized_age":
                divide, least = (function_for(function, ("float", "float")) for function in ("divide", "min"))
                share = builder.call(divide, read("age"), state.attribute("life"), name="share of life")
                return builder.call(least, share, ONE, name="normalized_age")  # who died in this frame is drawn as at death
            if name.startswith("parent."):
                return read(name.removeprefix("parent."))
            if name.startswith("birth.") and name not in types and name not in self.attributes.constants:
                return state.read(name.removeprefix("birth."))
            return state.read(name)

        def number(name: str) -> Operand:
            if name == "lives" and name not in types:
                return NOUGHT
            word: Operand = builder.call(events.word_of, state.read(name), name=f"{name} word")
            return word

        def varies(name: str) -> bool:
            name = name.removeprefix("parent.")
            return name in types or name in told or name in AGES or name.removeprefix("birth.") in types

        return Scope(self.seed, self.path, read, lambda: builder.load("id", "id"), varies, number)

    def _writer(self, builder: Builder, scope: Scope, clock: Any, steps: Any = None) -> ValueWriter:
        writer = ValueWriter(builder, scope, clock, steps, self.precision)
        writer.shared = self.shared
        return writer

    def whole_step(self, builder: Builder, k: int, state: State, number: int = 0, count: int = 1) -> Moment:
        """Return the number-th of `count` equal parts of a step that is the same for all particles."""
        made = self.made
        parted = count > 1

        def name(share: str, twice: int) -> Any:
            return ("part", k, 2 * number + twice, 2 * count) if parted else (share, k)

        def at(share: str, twice: int) -> Operand:
            return made.time(builder, name(share, twice))

        middle = name("middle", 1)
        scope = self._scope(builder, state, lambda: at("middle", 1), {})
        writer = self._writer(builder, scope, self._clock(builder, k), made.values_at(middle))
        return Moment(
            builder,
            made.time(builder, ("part", 0, 2, 2 * count) if parted else "length"),
            lambda: made.time(builder, ("part", 0, 1, 2 * count) if parted else "half"),
            writer,
            at("start", 0) if made.cells > 1 else ZERO_TIME,
            lambda kind, p: made.time(builder, (kind, k, p)),
            lambda: at("end", 2),
            lambda: self.fixed(builder, name("start", 0), state),
            lambda: self.fixed(builder, name("end", 2), state),
            lambda j, n: self.whole_step(builder, k, state, j, n),
            made=made,
            k=k,
        )

    def fixed(self, builder: Builder, time: Any, state: State, told: dict[str, Operand] | None = None) -> ValueWriter:
        """Return what finds values at a time of the frame that is one for all."""
        made = self.made
        scope = self._scope(builder, state, lambda: made.time(builder, time), told or {})
        k = time[1] if isinstance(time, tuple) else -1
        return self._writer(builder, scope, self._clock(builder, k), made.values_at(time))

    def _clock(self, builder: Builder, k: int) -> LazyClock:
        """Return what is the same for all particles in step `k` and is no step value."""
        made = self.made
        return LazyClock({"frame word": lambda: made.time(builder, "frame word")}, lambda path: made.mesh(builder, path, k))

    def own_step(self, builder: Builder, k: int, then: Operand, dt: Operand, state: State, cell: int | None = None) -> Moment:
        """Return a step of each particle's own, from `then` on, within step `k` of the frame, and in a cell if one is given."""

        def part(number: int, count: int) -> Moment:
            length = builder.call(pacing.part_of, dt, Uniform(f"1/{count}", "float", 1 / count), name="part") if count > 1 else dt
            return self.own_step(builder, k, later(number / count), length, state, cell)

        def later(share: float) -> Operand:
            if share == 0:
                return then
            passed = builder.call(pacing.part_of, dt, constant_number(share), name="passed")
            made: Operand = builder.call(basic.sum_of_numbers, then, passed, name="then")
            return made

        lane = self._lane_clock(builder, k, lambda: builder.call(basic.sum_of_numbers, then, lane["half"], name="middle"))
        lane.makers["half"] = lambda: builder.call(basic.half, dt, name="half")
        scope = self._scope(builder, state, lambda: lane["moment"], {})

        def end() -> Operand:
            return builder.call(basic.sum_of_numbers, then, dt, name="end")  # type: ignore[no-any-return]

        return Moment(
            builder,
            dt,
            lambda: lane["half"],
            self._writer(builder, scope, lane),
            then,
            lambda kind, p: self.made.time(builder, (kind, k, p)),
            end,
            lambda: self.at(builder, then, state),
            lambda: self.at(builder, end(), state),
            part,
            cell,
            lambda: builder.call(basic.difference, ZERO_TIME, builder.load("age", "float"), name="born"),
            lambda share: self.own_step(builder, k, later(share), ZERO_TIME, state, cell),
            self.made,
            k,
        )

    def at(self, builder: Builder, time: Operand, state: State, told: dict[str, Operand] | None = None) -> ValueWriter:
        """Return what finds values at a time of each particle's own."""
        lane = self._lane_clock(builder, -1, lambda: time)
        return self._writer(builder, self._scope(builder, state, lambda: time, told or {}), lane)

    def _lane_clock(self, builder: Builder, k: int, moment: Callable[[], Operand]) -> LazyClock:
        made = self.made
        lane = LazyClock(
            {
                "moment": moment,
                "time": lambda: builder.call(
                    basic.sum_of_numbers, made.time(builder, "frame start"), lane["moment"], name="time"
                ),
                "frame": lambda: made.time(builder, "frame"),
                "frame word": lambda: made.time(builder, "frame word"),
            },
            lambda path: made.mesh(builder, path, k),
        )
        return lane
