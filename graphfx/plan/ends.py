"""Write the programs of ends: of frames, where attributes are set that pictures show, of lives; and of selections."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphfx.graph.values import Value
from graphfx.motion import basic, events
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.holder import SETTING_ROLES, moment_of
from graphfx.plan.moment import Moments, State
from graphfx.plan.setting import Setting, under_conditions
from graphfx.plan.sharing import share
from graphfx.plan.shutter import Instant
from graphfx.plan.steps import FrameWriter
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Uniform


@dataclass
class EndWriter:
    """Writes the programs of ends for one source's particles."""

    writer: FrameWriter

    def _begin(self, name: str, position: str = "position") -> tuple[Builder, Moments, State]:
        builder, moments = self.writer.begin(name)
        return builder, moments, moments.state(builder, self.writer.motion.has_velocity, position)

    @property
    def moves(self) -> bool:
        """Return whether particles are put in their places as a frame ends."""
        live = self.writer.attributes.columns
        at_end = [node for node in self.writer.holder.of_role(*SETTING_ROLES) if moment_of(node) == "frame"]
        return "position" in live and any("position" in node.gives for node in at_end)

    def closing(self, own: bool = False) -> FrameProgram | None:
        """Return the program of what is set, and who is killed, as the frame ends; `own`: at times of the particles' own."""
        writer = self.writer
        live = writer.attributes.columns
        nodes = [node for node in writer.holder.of_role(*SETTING_ROLES) if moment_of(node) == "frame"]
        nodes = [node for node in nodes if any(name in live for name in node.gives)]
        kills = [] if own else [node for node in writer.holder.of_role("kill") if moment_of(node) == "frame"]
        if not nodes and not kills:
            return None
        builder, moments, state = self._begin("end of life within the frame" if own else "end of the frame")
        at = self._clock(builder, moments, state, "" if own else "frame end")
        moved = any({"position", "velocity"} & set(node.gives) for node in nodes)
        resting = builder.load("resting", "bool") if moved and not own and "resting" in live else None
        for node in nodes:
            Setting(node, at, builder, state.read, resting=resting).write(live)
        for node in kills:
            fate = builder.program.stores.get("fate") or builder.call(basic.copy_number, Uniform("0", "float", 0.0), name="fate")
            inside = under_conditions(node, at(), builder)
            inside.call(events.ended, fate, into=fate)
            builder.store("fate", fate)
        writer.store(builder)
        if resting is not None:
            builder.store("resting", resting)
        share(moments.made.program)
        return moments.made

    def place(self, instant: Instant, own: bool = False) -> FrameProgram:
        """Return the program that finds where what is set as a frame ends puts particles at an instant before.

        `own`: at times of the particles' own, of those who are born after it.
        """
        name = f"{instant.column}, of the newborn" if own else "tails" if instant.column == "tail" else instant.column
        builder, moments, state = self._begin(name, instant.column)
        at = self._clock(builder, moments, state, "" if own else instant.time)
        live = self.writer.attributes.columns
        for node in self.writer.holder.of_role(*SETTING_ROLES):
            if moment_of(node) == "frame" and any(name in live for name in node.gives):
                Setting(node, at, builder, state.read).write(live)
        builder.store(instant.column, state.position)  # type: ignore[arg-type]
        share(moments.made.program)
        return moments.made

    @staticmethod
    def _clock(builder: Builder, moments: Moments, state: State, time: str) -> Callable[[], ValueWriter]:
        """Return what finds values at a time of the frame, or, without one, at each particle's own."""
        if time:
            return lambda: moments.fixed(builder, time, state)
        begin = builder.load("begin", "float")
        return lambda: moments.at(builder, begin, state)

    def at_death(self) -> FrameProgram | None:
        """Return the program of what is set at deaths, and of who, dead of age, begins another life."""
        holder, live = self.writer.holder, self.writer.attributes.columns
        settings = [node for node in holder.of_role("set", "assign") if moment_of(node) == "death"]
        settings = [node for node in settings if any(name in live for name in node.sets)]
        recycles = [node for node in holder.of_role("recycle") if moment_of(node) == "death"]
        if not settings and not recycles:
            return None
        builder, moments, state = self._begin("deaths")
        at = self._clock(builder, moments, state, "")
        for node in settings:
            Setting(node, at, builder, state.read).write(live)
        renewed = builder.call(basic.copy_number, Uniform("0", "float", 0.0), name="renewed")
        for node in recycles:
            builder.note = node.path
            under_conditions(node, at(), builder).call(events.ended, renewed, into=renewed)
        builder.store("renewed", renewed)
        self.writer.store(builder)
        share(moments.made.program)
        return moments.made

    def selection(self, condition: Value) -> FrameProgram:
        """Return the program that tells, as a frame ends, which particles a picture shows."""
        builder, moments, state = self._begin("selection")
        writer = moments.fixed(builder, "frame end", state)
        builder.store("selected", builder.call(basic.both, builder.mask, writer.operand(condition), name="selected"))
        return moments.made
