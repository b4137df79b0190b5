"""Write one turn of a particle in its own time."""

from __future__ import annotations

from collections.abc import Callable

from graphfx.motion import basic, events
from graphfx.plan.contacts import Contacts
from graphfx.plan.hits import Fate
from graphfx.plan.knots import Knots
from graphfx.plan.moment import Moment, Moments, State
from graphfx.plan.overflow import Guard
from graphfx.plan.pacing import Pacing
from graphfx.plan.waking import Waking
from graphfx.program import Builder, Column, Operand, Uniform


class Turn:
    """One turn of the loop in own time: go to the end of the step, or to the first contact on the way.

    `captures` are the columns of places at instants, with their times; `knots` take the hits. With `pacing` a turn is one
    step of the particle's own, which may be refused. With a `guard` one that leads beyond the numbers is not taken.
    """

    def __init__(
        self,
        contacts: Contacts,
        fade: Callable[[Moment, State], None],
        moments: Moments,
        state: State,
        now: Column,
        resting: Column | None,
        captures: list[tuple[Column, Uniform]],
        knots: Knots | None,
        fate: Fate | None,
        pacing: Pacing | None = None,
        guard: Guard | None = None,
    ):
        self.pacing, self.guard = pacing, guard
        self.moments, self.state = moments, state
        self.contacts, self.fade = contacts, fade
        self.now, self.resting, self.fate = now, resting, fate
        self.captures, self.knots = captures, knots

    def going(self, builder: Builder, finish: Operand) -> Column:
        """Write who is not at the end of the step yet."""
        going: Column = builder.call(basic.is_less, self.now, finish, name="going")
        if self.resting is not None:
            going = builder.call(basic.but_not, going, self.resting, name="going")
        if self.fate is not None:
            going = builder.call(basic.both, going, builder.call(events.is_going_on, self.fate.fate), name="going")
        if self.pacing is not None:
            going = builder.call(basic.both, going, self.pacing.going(builder), name="going")
        return going

    def write(self, inner: Builder, k: int, finish: Column, cell: int | None = None) -> None:
        """Write the turn."""
        moments, state, now = self.moments, self.state, self.now
        step = inner.call(basic.difference, finish, now, name="step")
        step = step if self.pacing is None else self.pacing.limit(inner, step)
        before = inner.call(basic.copy_vector, state.position, name="before") if self.captures else None
        then = inner.call(basic.copy_number, now, name="then")
        whole = inner.call(basic.copy_number, step, name="whole step") if self.guard is not None else step
        first = self.guard.start(inner, state) if self.guard is not None else {}

        def step_of(builder: Builder, dt: Column) -> Moment:
            return moments.own_step(builder, k, then, dt, state, cell)

        def fade(builder: Builder, dt: Column) -> None:
            self.fade(moments.own_step(builder, k, then, dt, state), state)

        met = self.contacts.own_step(inner, step_of, state, step, self.resting, fade, self.pacing)
        if self.guard is not None:
            self.guard.end(inner, state, first, step, whole)
        inner.call(basic.sum_of_numbers, then, step, into=now)
        reached = inner.call(events.is_there, step, then, finish, self.contacts.resolution)
        inner.under(reached).call(basic.copy_number, finish, into=now)
        inner.note = "motion blur" if self.captures else inner.note
        for column, instant in self.captures:
            assert before is not None
            inner.call(basic.capture, column, before, state.position, then, now, instant, into=column)
        if self.knots is not None:
            hit = inner.call(basic.but_not, inner.mask, reached, name="met") if met is None or self.pacing is None else met
            self.knots.note(inner.under(hit), now, state.position)  # type: ignore[arg-type]

    def rest(self, builder: Builder, k: int, finish: Operand) -> None:
        """Write what fades on particles that are at rest before the end of the step."""
        assert self.resting is not None
        resting = builder.call(basic.both, self.resting, builder.call(basic.is_less, self.now, finish), name="at rest")
        if self.fate is not None:
            resting = builder.call(basic.both, resting, builder.call(events.is_going_on, self.fate.fate), name="at rest")
        inside = builder.under(resting)
        then = inside.call(basic.copy_number, self.now, name="then")
        left = inside.call(basic.difference, finish, then, name="left")
        self.fade(self.moments.own_step(inside, k, then, left, self.state), self.state)
        inside.call(basic.copy_number, finish, into=self.now)

    def wake(self, builder: Builder, waking: Waking, k: int, end: Operand) -> None:
        """Write who of those that are at rest as step `k` starts goes on in it, from when on nothing holds it."""
        assert self.resting is not None
        start = self.moments.made.time(builder, ("start", k))
        here = builder.call(basic.both, builder.call(events.is_by, self.now, start), builder.call(basic.is_less, start, end))
        here = builder.call(basic.both, here, self.resting, name="at rest")
        if self.fate is not None:
            here = builder.call(basic.both, here, builder.call(events.is_going_on, self.fate.fate), name="at rest")
        inside = builder.under(here)
        finish = inside.call(basic.earlier, end, self.moments.made.time(inside, ("end", k)), name="finish")
        instant = waking.instant(inside, k, start, finish)
        woken = inside.call(basic.is_less, instant, finish, name="woken")
        let_go = inside.under(woken)
        held_for = let_go.call(basic.difference, instant, start, name="held for")
        self.fade(self.moments.own_step(let_go, k, start, held_for, self.state), self.state)
        let_go.call(basic.copy_number, instant, into=self.now)
        builder.under(builder.program.context).call(basic.but_not, self.resting, woken, into=self.resting)
