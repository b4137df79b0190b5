"""Write the motion of one step: flows composed symmetrically around each other, linear parts summed into one exact flow.

    L(h/2) F1(h/2) ... Fn(h) ... F1(h/2) L(h/2)

L is the linear motion, which carries a particle by its velocity. A flow F that gives position and velocity acts in it
on the velocity alone, so that nothing is carried twice; only where it stands alone is it the whole motion, and exact.
Where an acceleration has an exact flow, that stands in place of L, and what is linear acts on the velocity alone.
A step is split where it meets another cell of noise: within a cell noise is a constant of L.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from graphfx.graph.values import Literal, Name
from graphfx.motion import basic, runge_kutta
from graphfx.plan.halfway import half_way, operands_half_way, write_linear
from graphfx.plan.linear_motion import Coefficients, LinearMotion, write_paper_step, write_without_drift
from graphfx.plan.moment import Moment, State
from graphfx.plan.movers import INNER_ROLES, Mover, base_of, linear_form, mover_of
from graphfx.plan.rates import Rate, depends_on_time, rate_of
from graphfx.plan.rounding import settle
from graphfx.plan.runge_kutta import write_runge_kutta
from graphfx.plan.scheme import SIMPLE, Scheme, write_scheme
from graphfx.plan.white_noise import WHOLE_STEP, WhiteNoise
from graphfx.program import Builder, Column, Function, Operand, Uniform

FOR_EVER = Uniform("1e9", "float", 1e9)
"""A time after which a flow has led where it leads [s]."""

__all__ = ["Motion", "Mover", "mover_of"]


@dataclass
class Motion:
    """All operators of one emitter that move its particles; a step may meet `cells` cells of held noise.

    `changing` are the attributes that are set within a frame.
    """

    movers: list[Mover]
    method: str
    has_velocity: bool
    cells: int = 1
    changing: frozenset[str] = frozenset()
    scheme: Scheme = SIMPLE
    linear: LinearMotion = field(init=False)
    cuts: frozenset[float] = frozenset()
    """When operators begin to act, or end: steps are cut there [s]."""
    most_cuts: int = 0
    """How many of these may fall into one frame."""
    keeps: bool = False
    """Whether what rounding takes from places is kept."""

    def __post_init__(self) -> None:
        """Gather what is summed into the linear motion."""
        parts = [mover for mover in self.movers if mover.role in ("linear", "noise") and not mover.idle]
        noise = WhiteNoise(self.cells)
        self.linear = LinearMotion(parts, self.arguments, self.under_conditions, self.changing, noise)

    @property
    def may_keep(self) -> bool:
        """Return whether its ways are the same wherever they begin, so that what rounding takes from places can be kept."""
        carried = self.has_velocity or any(not mover.writes_velocity for mover in self.linear.movers)
        alone = self.method == "exact" and any(self.of(role) for role in INNER_ROLES)
        plain = self.method != "sims" and self.scheme.counts == (1,) and not alone
        return plain and carried and not self.linear.springs and not self.of("surface")

    def of(self, role: str) -> list[Mover]:
        """Return the operators of one role that act at all, in order."""
        return [mover for mover in self.movers if mover.role == role and not mover.idle]

    def arguments(self, mover: Mover, moment: Moment, state: State, replaced: dict[str, Operand] | None = None) -> list[Operand]:
        """Return the operands of an operator's function."""
        operands: list[Operand] = []
        for name in mover.arguments:
            if replaced and name in replaced:
                operands.append(replaced[name])
            elif name in mover.node.arguments:
                operands.append(moment.writer.argument(mover.node.arguments[name]))
            elif name in mover.node.references:
                operands.append(moment.writer.operand(Literal("mesh", value=mover.node.references[name])))
            elif name == "dt":
                operands.append(moment.dt)
            elif name in ("time", "frame"):
                operands.append(moment.writer.operand(Name(name)))
            else:
                operands.append(state.read(name))
        return operands

    def prepare(self, moment: Moment, state: State) -> None:
        """Write, once for all steps, what stays the same for a particle: its parameters, and coefficients made of them."""
        for mover in self.movers:
            moment.builder.note = mover.node.path
            for value in mover.node.arguments.values():
                if rate_of(value, moment.writer.scope) == Rate.PARTICLE and not depends_on_time(value):
                    moment.writer.shared[id(value)] = moment.writer.argument(value)
        self.linear.prepare(moment, state)

    @property
    def is_brownian(self) -> bool:
        """Return whether any noise is Brownian."""
        return any(mover.is_brownian for mover in self.of("noise"))

    def prepare_step(self, moment: Moment) -> None:
        """Write, once for all who go parts of a step, the Brownian noise of it."""
        cells = (WHOLE_STEP,) if self.method == "sims" else range(self.cells)
        for mover in self.of("noise"):
            for cell in cells:
                self.linear.noise.prepare(mover, moment, cell)

    def step(self, moment: Moment, state: State) -> dict[str, Operand] | None:
        """Write one step of dt, in place; return the estimated errors, where there are estimates.

        What stands at one place for all does not move.
        """
        if not isinstance(state.position, Column):
            return None
        errors: dict[str, Operand] | None
        if self.scheme.runge_kutta:
            errors = write_runge_kutta(self, moment, state)
        else:
            errors = write_scheme(self.scheme, moment, state, self._symmetric_step)
        if self._decays:
            settle(moment, state, self.linear.springs)
        return errors

    @property
    def _decays(self) -> bool:
        """Return whether anything may bring a speed to nothing."""
        damped = any(mover.form is not None and mover.form.damping for mover in self.linear.movers)
        return damped or self.linear.springs or any(mover.carries for mover in self.of("flow"))

    def _symmetric_step(self, moment: Moment, state: State) -> None:
        """Write one step of second order."""
        self.select(moment)
        for mover in self.movers:
            if mover.idle and mover.role in INNER_ROLES:
                self._apply(mover, moment, state, moment.dt)
        if self.method == "sims":
            self._sims(moment, state)
        elif self.cells > 1 and moment.cell is None:
            for cell in range(self.cells):
                self._compose(self._within_cell(moment, cell), state, cell)
        else:
            self._compose(moment, state, moment.cell or 0)

    def select(self, moment: Moment) -> None:
        """Write whom each operator acts on: found at the start of a step, and held."""
        for mover in self.movers:
            if mover.node.only is not None:
                moment.writer.operand(mover.node.only)

    @staticmethod
    def _within_cell(moment: Moment, cell: int) -> Moment:
        """Return the part of a step that lies in a cell, under the mask of the particles whose step meets it."""
        builder = moment.builder
        end = builder.call(basic.sum_of_numbers, moment.then, moment.dt, name="step end")
        begin = builder.call(basic.later, moment.then, moment.cell_time("cell begin", cell), name="cell begin")
        end = builder.call(basic.earlier, end, moment.cell_time("cell end", cell), name="cell end")
        met = builder.call(basic.is_less, begin, end, name="met")
        inner = builder.under(builder.call(basic.both, builder.mask, met, name="in cell"))
        dt = inner.call(basic.difference, end, begin, name="dt")
        half = inner.call(basic.half, dt, name="half")
        return replace(moment, builder=inner, dt=dt, half=lambda: half)

    def _compose(self, moment: Moment, state: State, cell: int) -> None:
        """Write the symmetric composition of all that acts, over a step that lies in one cell of noise."""
        inner = [mover for role in INNER_ROLES for mover in self.of(role)]
        alone = self.method == "exact" and bool(inner)
        if alone:
            self._apply(inner[0].whole or inner[0], moment, state, moment.dt, alone)
            return
        coefficients = self.linear.coefficients(moment, state, cell)
        if not inner:
            self._drift(moment, state, coefficients, cell)(moment.dt)
            return
        parts: list[Callable[[Operand], None]]
        parts = [partial(self._apply, mover, moment, state) for mover in inner if mover is not self.base]
        if self.base is not None and not coefficients.empty:
            parts.insert(0, partial(write_without_drift, moment, state, coefficients))
        drift = self._drift(moment, state, coefficients, cell)
        if not parts:
            drift(moment.dt)
            return
        outer = [drift] if self.has_velocity or coefficients.applied is not None else []
        for part in (*outer, *parts[:-1]):
            part(moment.half())
        parts[-1](moment.dt)
        for part in reversed((*outer, *parts[:-1])):
            part(moment.half())

    @property
    def base(self) -> Mover | None:
        """Return the acceleration around whose exact flow all else is composed: one that acts on all, at all times."""
        return base_of(self.of("acceleration")) if self.method in ("strang", "adaptive") and self.has_velocity else None

    def _drift(self, moment: Moment, state: State, coefficients: Coefficients, cell: int) -> Callable[[Operand], None]:
        """Return what writes how velocities carry particles: on the base's exact flow, or with all that is linear."""
        if self.base is not None and self.base.whole is not None:
            return partial(self._apply, self.base.whole, moment, state, alone=True)
        return partial(write_linear, self.linear, moment, state, coefficients, cell, self.keeps)

    def under_conditions(self, mover: Mover, moment: Moment) -> Builder:
        """Return the builder under the operator's own conditions: `during`, and `only`."""
        builder, writer = moment.builder, moment.conditions or moment.writer
        if mover.node.during is not None:
            start, end = mover.node.during
            ends = [writer.operand(float(t)) for t in (start, end)]
            within = builder.call(basic.is_within, writer.operand(Name("time")), *ends, name="during")
            builder = builder.under(builder.call(basic.both, builder.mask, within), builder.note)
        if mover.node.only is not None:
            only = writer.operand(mover.node.only)
            builder = builder.under(builder.call(basic.both, builder.mask, only, name="only"), builder.note)
        return builder

    def _apply(self, mover: Mover, moment: Moment, state: State, dt: Operand, alone: bool = False) -> None:
        """Write what an operator does over dt; a flow that is not alone does not carry by the velocity."""
        moment.builder.note = mover.node.path
        builder = self.under_conditions(mover, moment)
        operands = self.arguments(mover, moment, state, {"dt": dt})
        if mover.role == "flow":
            kept = mover.writes if alone or not mover.carries else ("velocity",)
            written = [state.read(n) if n in kept else Column("unused", "vec3") for n in mover.writes]
            into: Any = tuple(written)
            if self.method != "sims" and any(mover.follows(name) for name in kept):
                operands = operands_half_way(self.arguments, mover, builder, moment, state, dt, into)
            builder.call(mover.function, *operands, into=into)
            return
        name = "position" if mover.role == "velocity" else "velocity"
        changed = state.read(name)
        assert isinstance(changed, Column)
        rate = builder.call(mover.function, *operands, name=mover.role)
        if (name in mover.arguments or mover.follows(name)) and self.method != "sims":
            rate = self._rate_along(mover, moment, state, builder, name, rate, dt)
        builder.call(basic.advance, changed, rate, dt, into=changed)

    def _rate_along(
        self, mover: Mover, moment: Moment, state: State, builder: Builder, name: str, first: Column, dt: Operand
    ) -> Column:
        """Write the rate of change over dt of what its own rate depends on: that half way; of order 4 to be extrapolated."""
        changed = state.read(name)

        def rate_after(rate: Column, advance: Function) -> Column:
            place = builder.call(advance, changed, rate, dt, name="on the way")
            if mover.follows(name):

                def there(later: Moment) -> Column:
                    operands = self.arguments(mover, later, state, {"dt": dt})
                    made: Column = builder.call(mover.function, *operands, name=f"{mover.role} on the way")
                    return made

                return half_way(builder, moment, state, lambda: builder.call(basic.copy_vector, place, into=changed), there)  # type: ignore[arg-type]
            operands = self.arguments(mover, moment, state, {"dt": dt, name: place})
            found: Column = builder.call(mover.function, *operands, name=f"{mover.role} on the way")
            return found

        middle = rate_after(first, basic.advance_half)
        if len(self.scheme.counts) == 1:
            return middle
        again = rate_after(middle, basic.advance_half)
        made: Column = builder.call(runge_kutta.classical_rate, first, middle, again, rate_after(again, basic.advance))
        return made

    def _apply_paper(self, mover: Mover, moment: Moment, state: State) -> None:
        """Write V' = V + rate dt for a flow that has a rate, but not beyond where it leads; else what is done elsewhere."""
        linear = linear_form(mover)
        if linear is None or not mover.writes_velocity:
            self._apply(mover, moment, state, moment.dt)
            return
        moment.builder.note = mover.node.path
        builder, velocity = self.under_conditions(mover, moment), state.velocity
        assert isinstance(velocity, Column)
        rate = builder.call(linear.function, *self.arguments(linear, moment, state), name="rate")
        end = {name: Column(f"final {name}", "vec3") for name in mover.node.node_type.writes}
        builder.call(mover.function, *self.arguments(mover, moment, state, {"dt": FOR_EVER}), into=tuple(end.values()))
        builder.call(basic.sims_limited, velocity, rate, end["velocity"], moment.dt, into=velocity)

    def _sims(self, moment: Moment, state: State) -> None:
        """Write a step of the paper's scheme: operations in stack order, then move."""
        builder = moment.builder
        before = builder.call(basic.copy_vector, state.velocity, name="before") if state.velocity is not None else None
        for mover in self.movers:
            if mover.idle:
                continue
            if mover.role in INNER_ROLES:
                self._apply_paper(mover, moment, state)
            elif mover.role in ("linear", "noise"):
                write_paper_step(moment, state, self.linear.terms(mover, moment, state, WHOLE_STEP))
        builder.note = "move"
        if before is not None:
            builder.call(basic.sims_move, state.position, before, state.velocity, moment.dt, into=state.position)  # type: ignore[arg-type]
