"""Write the programs of a frame: `main` for particles that live through all of it, `own` for those with a time of their own.

`main` gives every particle the same steps. Where something befalls a particle, a contact or an end, it is
rejected, unchanged. `own` takes those, the newborn and the dying, gathered into dense blocks: each has its
own begin and end inside the frame, and stops at every contact. What follows at the end of the frame: ends.py.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from graphfx.motion import basic, events
from graphfx.plan.contacts import Contacts
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.hits import HIT_TYPES, Fate, Hits, is_vital
from graphfx.plan.holder import ENDING_ROLES, Holder, moment_of
from graphfx.plan.knots import Knots
from graphfx.plan.liveness import Attributes
from graphfx.plan.moment import Moment, Moments, State
from graphfx.plan.motion import Motion
from graphfx.plan.overflow import Guard, beyond, may_overflow
from graphfx.plan.pacing import ALLOWED, MOST_TURNS, Pacing
from graphfx.plan.setting import Setting, under_conditions
from graphfx.plan.sharing import share
from graphfx.plan.shutter import Instant
from graphfx.plan.turns import Turn
from graphfx.plan.waking import Waking, may_wake
from graphfx.program import Builder, Column, Uniform

MOST_CONTACTS = 100
"""Contacts of one particle in one step; one that has more is reported and rests."""


class FrameWriter:
    """Writes the programs of one source's particles."""

    def __init__(
        self,
        holder: Holder,
        attributes: Attributes,
        motion: Motion,
        constant: Callable[[str], Uniform],
        seed: int,
        precision: int,
        substeps: int,
    ):
        self.holder = holder
        self.attributes = attributes
        self.motion = motion
        self.constant = constant
        self.seed = seed
        self.precision = precision
        self.substeps = substeps
        self.hits = Hits(holder, attributes)
        at_steps = [node for node in holder.operators if moment_of(node) == "step"]
        self.settings = [node for node in at_steps if node.node_type.role in ("set", "assign")]
        self.endings = [node for node in at_steps if node.node_type.role in ENDING_ROLES]
        self.vital = [node for node in self.settings if is_vital(node, attributes)]
        self.fades = [node for node in at_steps if node.node_type.role == "fade"]
        self.may_wake = may_wake(motion)
        self.guarded = may_overflow(motion)

    @property
    def acts(self) -> bool:
        """Return whether anything happens in a step, beside motion."""
        live = self.attributes.columns
        given = [name for node in (*self.settings, *self.fades) for name in node.gives]
        return bool(self.endings) or any(name in live for name in given)

    def begin(self, name: str) -> tuple[Builder, Moments]:
        """Return what begins a program."""
        builder = Builder.begin(f"{self.holder.path}: {name}")
        made = FrameProgram(builder.program, cells=self.motion.cells)
        return builder, Moments(self.seed, self.holder.path, self.precision, self.attributes, self.constant, made)

    def main(self, instants: list[Instant]) -> FrameProgram:
        """Return the program for whole steps, which finds the places at some instants."""
        builder, moments = self.begin("motion")
        made, state = moments.made, moments.state(builder, self.motion.has_velocity)
        resting = builder.load("resting", "bool") if "resting" in self.attributes.columns else None
        captures = {instant: Column(instant.column, "vec3") for instant in instants}
        if resting is not None:
            for column in captures.values():
                builder.call(basic.copy_vector, state.position, into=column)
        contacts = Contacts(self.motion, self.precision, self.hits, moments)
        event: Column | None = None
        for k in range(self.substeps):
            event = self._start(builder, moments, k, state, event, resting)
            if k == 0 or self.wakes:
                active = self._moving(builder, resting)
            moment = moments.whole_step(active, k, state)
            all_of_them = moments.whole_step(builder, k, state) if self.may_wake else moment
            if k == 0:
                self.motion.prepare(all_of_them, state)
            self.motion.prepare_step(all_of_them)
            if self.may_wake and resting is not None:
                still = builder.under(builder.call(basic.both, builder.mask, resting, name="at rest"))
                woken = self._waking(moments, state).woken(still, k, made.time(still, ("end", k)))
                event = woken if event is None else builder.call(basic.either, event, woken, name="event")
            met = {instant: column for instant, column in captures.items() if instant.step(self.substeps) == k}
            before = active.call(basic.copy_vector, state.position, name="before") if met else None
            start = contacts.start(active, state)
            self.motion.step(moment, state)
            if self.fades:
                self.fade(moments.whole_step(builder, k, state), state)
            event = contacts.main_step(moment, state, event, start)
            for instant, column in met.items():
                assert before is not None
                active.note = "motion blur"
                times = [made.time(active, name) for name in (("start", k), ("end", k), instant.time)]
                active.call(basic.capture, before, before, state.position, *times, into=column)
        if self.guarded and (gone := beyond(builder, state)) is not None:
            event = gone if event is None else builder.call(basic.either, event, gone, name="event")
        self.store(builder, list(captures.values()))
        if resting is not None and self.wakes:
            builder.store("resting", resting)
        builder.program.rejects = event
        share(made.program)
        return made

    def _waking(self, moments: Moments, state: State) -> Waking:
        return Waking(self.motion, moments, state, self.precision)

    @staticmethod
    def _moving(builder: Builder, resting: Column | None) -> Builder:
        """Return the builder for those who are not at rest."""
        if resting is None:
            return builder
        return builder.under(builder.call(basic.but_not, builder.mask, resting, name="moving"))

    @property
    def wakes(self) -> bool:
        """Return whether what is set at the start of a step may move particles that are at rest."""
        return any({"position", "velocity"} & set(node.gives) for node in self.settings)

    def _start(
        self, builder: Builder, moments: Moments, k: int, state: State, event: Column | None, resting: Column | None
    ) -> Column | None:
        """Write what happens at the start of a step: attributes are set, and who ends is noted."""
        for node in self.settings:
            fixed = lambda: moments.fixed(builder, ("start", k), state)  # noqa: E731
            set_for = Setting(node, fixed, builder, state.read, resting=resting).write(self.attributes.columns)
            if node in self.vital and set_for is not None:
                whose = builder.call(basic.both, set_for.mask, set_for.mask)
                event = whose if event is None else builder.call(basic.either, event, whose, name="event")
        for node in self.endings:
            builder.note = node.path
            who = under_conditions(node, moments.fixed(builder, ("start", k), state), builder).mask
            event = builder.call(basic.both, who, who) if event is None else builder.call(basic.either, event, who, name="event")
        return event

    def fade(self, moment: Moment, state: State) -> None:
        """Write what fades over a step."""
        for node in self.fades:
            Setting(node, lambda: moment.writer, moment.builder, state.read, moment.dt).write(self.attributes.columns)

    def own(self, instants: list[Instant]) -> FrameProgram:
        """Return the program for particles with times of their own: `begin` and `end` come by place."""
        builder, moments = self.begin("motion in own time")
        made, state = moments.made, moments.state(builder, self.motion.has_velocity)
        now, end = builder.load("begin", "float"), builder.load("end", "float")
        resting = builder.load("resting", "bool") if "resting" in self.attributes.columns else None
        captures = [(builder.load(instant.column, "vec3"), made.time(builder, instant.time)) for instant in instants]
        scheme = self.motion.scheme
        most = MOST_CONTACTS * self.substeps if self.motion.of("surface") else 0
        longest = made.time(builder, "length") if scheme.paced else None
        pacing = Pacing.begin(builder, scheme, longest, self.precision, most) if longest is not None else None
        knots = Knots(builder) if instants and self.motion.of("surface") and self.motion.method != "sims" else None
        fate = self._fate(builder)
        self.motion.prepare(moments.own_step(builder, 0, now, now, state), state)
        contacts = Contacts(self.motion, self.precision, self.hits, moments, fate)
        guard = self._guard(builder, pacing)
        turn = Turn(contacts, self.fade, moments, state, now, resting, captures, knots, fate, pacing, guard)
        unfinished: Column | None = None
        for k in range(self.substeps):
            finish = builder.call(basic.earlier, end, made.time(builder, ("end", k)), name="finish")
            if fate is not None or self.settings:
                self._own_start(builder, moments, k, state, turn, end)
            if self.may_wake and resting is not None:
                turn.wake(builder, self._waking(moments, state), k, end)
            going = turn.going(builder, finish)
            if self.motion.is_brownian:
                self.motion.prepare_step(moments.own_step(builder.under(going), k, now, now, state))
            for here in self._parts(builder, made, finish):
                if pacing is not None:
                    self._paced_turns(builder, moments, k, turn, pacing, here)
                    continue
                going = turn.going(builder, here) if self.motion.most_cuts else going
                left = self._turns(builder, k, turn, here, going)
                unfinished = left if unfinished is None else builder.call(basic.either, unfinished, left)
            if self.fades and resting is not None:
                turn.rest(builder, k, finish)
        if pacing is not None and most:
            unfinished = pacing.restless(builder)
        if resting is not None and unfinished is not None:
            builder.store("resting", builder.call(basic.either, resting, unfinished))
        self.store(builder, [column for column, _ in captures])
        made.program.stores |= knots.stores if knots is not None else {}
        made.program.stores |= pacing.stores | {"ended": now} if pacing is not None else {}
        made.program.stores |= {"unfinished": unfinished} if unfinished is not None else {}
        made.program.stores |= {"lost": guard.lost} if guard is not None and pacing is None else {}
        if fate is not None:
            made.program.stores |= {"fate": fate.fate, "ended": now, "surface": fate.surface, "begun": fate.begun, **fate.hit}
        share(made.program)
        return made

    def _guard(self, builder: Builder, pacing: Pacing | None) -> Guard | None:
        """Return what keeps particles within the numbers: errors of steps do, but at surfaces."""
        if not self.guarded or (pacing is not None and not self.motion.of("surface")):
            return None
        made = Guard.begin(builder, self.motion.keeps)
        return made if pacing is None else Guard(pacing.failed, made.keeps)

    def _parts(self, builder: Builder, made: FrameProgram, finish: Column) -> Iterator[Column]:
        """Write the ends of the parts of a step that ends at `finish`: where operators begin to act or end, and its own."""
        for number in range(self.motion.most_cuts):
            yield builder.call(basic.earlier, finish, made.time(builder, f"cut {number}"), name="cut")
        yield finish

    @staticmethod
    def _turns(builder: Builder, k: int, turn: Turn, finish: Column, going: Column) -> Column:
        """Write the turns that carry particles to the end of a step; return who did not come to it."""
        inner = builder.loop(going, MOST_CONTACTS, "until the particle's end")
        turn.write(inner, k, finish)
        inner.call(basic.both, *[turn.going(inner, finish)] * 2, into=going)
        left: Column = builder.call(basic.both, going, going, name="unfinished")
        return left

    def _paced_turns(self, builder: Builder, moments: Moments, k: int, turn: Turn, pacing: Pacing, finish: Column) -> None:
        """Write turns of steps of the particles' own, up to the end of each cell of noise; who is not there waits."""
        for cell in range(self.motion.cells):
            here = finish
            if cell + 1 < self.motion.cells:
                here = builder.call(basic.earlier, finish, moments.made.time(builder, ("cell end", k, cell)), name="cell end")
            going = turn.going(builder, here)
            inner = builder.loop(going, MOST_TURNS, "until the particle's end")
            turn.write(inner, k, here, cell)
            soon = pacing.has_turns(inner, moments.made.time(builder, ALLOWED))
            inner.call(basic.both, turn.going(inner, here), soon, into=going)
            builder.call(basic.either, pacing.waiting, turn.going(builder, here), into=pacing.waiting)

    def _fate(self, builder: Builder) -> Fate | None:
        if not (self.endings or self.hits.ends or self.vital or (self.motion.scheme.paced and self.settings)):
            return None
        nought = Uniform("0", "float", 0.0)
        surface = builder.call(basic.copy_number, Uniform("-1", "float", -1.0), name="surface")
        made = Fate(builder.call(basic.copy_number, nought, name="fate"), surface, builder.load("begun", "float"))
        if self.hits.listeners:
            zero = {"float": nought, "vec3": Uniform("(0, 0, 0)", "vec3", (0.0, 0.0, 0.0))}
            made.hit = {
                f"hit.{name}": builder.call(basic.copy_of(type_), zero[type_], name=f"hit.{name}")
                for name, type_ in HIT_TYPES.items()
            }
        return made

    def _own_start(self, builder: Builder, moments: Moments, k: int, state: State, turn: Turn, end: Column) -> None:
        """Write what happens at the start of a step to those who are there."""
        start = moments.made.time(builder, ("start", k))
        here = builder.call(basic.both, builder.call(events.is_by, turn.now, start), builder.call(basic.is_less, start, end))
        if turn.pacing is not None:
            here = builder.call(basic.both, here, turn.pacing.going(builder), name="here")
        if turn.fate is not None:
            here = builder.call(basic.both, here, builder.call(events.is_going_on, turn.fate.fate), name="here")
            first = builder.call(events.is_by, turn.fate.begun, Uniform(str(k), "float", float(k)), name="first")
            here = builder.call(basic.both, here, first, name="here")
        inside = builder.under(here)
        if turn.resting is not None:
            inside.call(basic.copy_number, start, into=turn.now)
        if turn.fate is not None:
            inside.call(basic.copy_number, Uniform(str(k + 1), "float", float(k + 1)), into=turn.fate.begun)
        for node in self.settings:
            fixed = lambda: moments.fixed(inside, ("start", k), state)  # noqa: E731
            written = Setting(node, fixed, inside, state.read, resting=turn.resting).write(self.attributes.columns)
            if node in self.vital and written is not None and turn.fate is not None:
                written.call(events.held, turn.fate.fate, into=turn.fate.fate)
                written.call(basic.copy_number, start, into=turn.now)
        for node in self.endings:
            assert turn.fate is not None
            inside.note = node.path
            ending = under_conditions(node, moments.fixed(inside, ("start", k), state), inside)
            become = events.ended if node.node_type.role == "kill" else events.renewed
            ending.call(become, turn.fate.fate, into=turn.fate.fate)
            ending.call(basic.copy_number, start, into=turn.now)

    def store(self, builder: Builder, captures: Sequence[Column] = ()) -> None:
        """Store what the program has changed, and the places that it has found."""
        changed = {id(column) for instruction in builder.program.walk() for column in getattr(instruction, "results", ())}
        for name, column in builder.program.loads.items():
            if name in self.attributes.types and id(column) in changed:
                builder.store(name, column)
        for column in captures:
            builder.store(column.name, column)
