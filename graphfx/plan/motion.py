"""Write the motion of one step: flows composed symmetrically around each other, linear parts summed into one exact flow."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Name
from graphfx.motion import basic, linear
from graphfx.motion.probe import LinearForm, probe
from graphfx.plan.moment import Moment, State
from graphfx.plan.rates import Rate, depends_on_time, rate_of
from graphfx.plan.values import folded_call, node_function
from graphfx.program import Builder, Column, Function, Operand, Uniform

X_AXIS, Y_AXIS = Uniform("(1, 0, 0)", "vec3", (1.0, 0.0, 0.0)), Uniform("(0, 1, 0)", "vec3", (0.0, 1.0, 0.0))
ZERO = Uniform("(0, 0, 0)", "vec3", (0.0, 0.0, 0.0))


@dataclass
class Mover:
    """One operator of the motion, as it will run. An `idle` one acts at no time that is simulated."""

    node: FlatNode
    function: Function
    form: LinearForm | None = None
    idle: bool = False

    @property
    def role(self) -> str:
        """Return how the engine treats it: flow, linear, acceleration or surface."""
        role = self.node.node_type.role
        return "acceleration" if role == "linear" and self.form is None and self.writes_velocity else role

    @property
    def writes_velocity(self) -> bool:
        """Return whether it changes the velocity (else the position)."""
        return self.node.node_type.writes == ("velocity",)

    @property
    def time_free(self) -> bool:
        """Return whether what it does to a particle stays the same: its parameters, and that it acts."""
        return self.node.during is None and self.node.only is None and self.constant

    @property
    def constant(self) -> bool:
        """Return whether the values of its parameters stay the same for a particle."""
        return not any(map(depends_on_time, self.node.arguments.values()))


def mover_of(node: FlatNode, idle: bool = False) -> Mover:
    """Return an operator with the form found by probing it."""
    function = node_function(node.node_type)
    form = None
    if node.node_type.role == "linear" and node.node_type.writes == ("velocity",):
        form = probe(function.body, node.node_type.arguments, function.arguments)
    return Mover(node, function, form, idle)


@dataclass
class Coefficients:
    """The linear motion V' = g - d V + w x V, P' = V + u: what there is of it."""

    constant: Operand | None = None
    damping: Operand | None = None
    turning: Operand | None = None
    applied: Operand | None = None


@dataclass
class Motion:
    """All operators of one emitter that move its particles."""

    movers: list[Mover]
    method: str
    has_velocity: bool
    cells: int = 1
    _cached: dict[tuple[int, int], dict[str, Operand]] = field(default_factory=dict)

    def of(self, role: str) -> list[Mover]:
        """Return the operators of one role that act at all, in order."""
        return [mover for mover in self.movers if mover.role == role and not mover.idle]

    def arguments(self, mover: Mover, moment: Moment, state: State, replaced: dict[str, Operand] | None = None) -> list[Operand]:
        """Return the operands of an operator's function."""
        operands: list[Operand] = []
        for name in mover.node.node_type.arguments:
            if replaced and name in replaced:
                operands.append(replaced[name])
            elif name in mover.node.arguments:
                operands.append(moment.writer.argument(mover.node.arguments[name]))
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
        for mover in self.of("linear"):
            if mover.time_free:
                self._terms(mover, moment, state)

    def step(self, moment: Moment, state: State) -> None:
        """Write one step of dt, in place."""
        self.select(moment)
        for mover in self.movers:
            if mover.idle and mover.role in ("flow", "acceleration"):
                self._apply(mover, moment, state, moment.dt)
        if self.method == "sims":
            self._sims(moment, state)
            return
        inner = [*self.of("flow"), *self.of("acceleration")]
        coefficients = self._coefficients(moment, state)
        drifts = self.has_velocity or coefficients.applied is not None
        if not inner:
            self._linear(moment, state, coefficients, moment.dt)
            return
        if drifts:
            self._linear(moment, state, coefficients, moment.half())
        for mover in inner[:-1]:
            self._apply(mover, moment, state, moment.half())
        self._apply(inner[-1], moment, state, moment.dt)
        for mover in reversed(inner[:-1]):
            self._apply(mover, moment, state, moment.half())
        if drifts:
            self._linear(moment, state, coefficients, moment.half())

    def select(self, moment: Moment) -> None:
        """Write whom each operator acts on: found at the start of a step, and held."""
        for mover in self.movers:
            if mover.node.only is not None:
                moment.writer.operand(mover.node.only)

    def under_conditions(self, mover: Mover, moment: Moment) -> Builder:
        """Return the builder under the operator's own conditions: `during`, and `only`."""
        builder = moment.builder
        if mover.node.during is not None:
            start, end = mover.node.during
            ends = [moment.writer.operand(float(t)) for t in (start, end)]
            within = builder.call(basic.is_within, moment.writer.operand(Name("time")), *ends, name="during")
            builder = builder.under(builder.call(basic.both, builder.mask, within), builder.note)
        if mover.node.only is not None:
            only = moment.writer.operand(mover.node.only)
            builder = builder.under(builder.call(basic.both, builder.mask, only, name="only"), builder.note)
        return builder

    def _apply(self, mover: Mover, moment: Moment, state: State, dt: Operand) -> None:
        moment.builder.note = mover.node.path
        builder = self.under_conditions(mover, moment)
        operands = self.arguments(mover, moment, state, {"dt": dt})
        if mover.role == "flow":
            written = tuple(state.read(name) for name in mover.node.node_type.writes)
            builder.call(mover.function, *operands, into=written)  # type: ignore[arg-type]
            return
        rate = builder.call(mover.function, *operands, name="acceleration")
        assert isinstance(state.velocity, Column)
        builder.call(basic.advance, state.velocity, rate, dt, into=state.velocity)

    def _terms(self, mover: Mover, moment: Moment, state: State) -> dict[str, Operand]:
        """Return an operator's terms: constant, damping, turning (of V) or applied (of P)."""
        key = (id(mover), id(moment.builder.program))
        if mover.time_free and key in self._cached:
            return self._cached[key]
        moment.builder.note = mover.node.path
        builder, precision = self.under_conditions(mover, moment), moment.writer.precision

        def evaluate(velocity: Operand) -> Operand:
            given = self.arguments(mover, moment, state, {"velocity": velocity})
            return folded_call(builder, precision, mover.function, *given, name=mover.node.node_type.name)

        terms: dict[str, Operand] = {}
        if mover.writes_velocity:
            assert mover.form is not None
            zero = evaluate(ZERO) if mover.form.constant else None
            if zero is not None:
                terms["constant"] = zero
            if mover.form.damping or mover.form.turning:
                first, second = evaluate(X_AXIS), evaluate(Y_AXIS) if mover.form.turning else None
                if zero is not None:
                    first = folded_call(builder, precision, basic.difference_of_vectors, first, zero)
                    second = (
                        folded_call(builder, precision, basic.difference_of_vectors, second, zero) if second is not None else None
                    )
                if mover.form.damping:
                    terms["damping"] = folded_call(builder, precision, basic.damping_of, first, name="damping")
                if second is not None:
                    terms["turning"] = folded_call(builder, precision, basic.spin_of, first, second, name="turning")
        else:
            terms["applied"] = evaluate(ZERO)
        if mover.node.during is not None or mover.node.only is not None:
            terms = {name: self._zero_outside(moment.builder, builder, term) for name, term in terms.items()}
        if mover.time_free:
            self._cached[key] = terms
        return terms

    @staticmethod
    def _zero_outside(builder: Builder, inside: Builder, term: Operand) -> Operand:
        """Return a term that is zero where the operator does not act."""
        vector = term.type == "vec3"
        nought: Operand = ZERO if vector else Uniform("0", "float", 0.0)
        copy = basic.copy_vector if vector else basic.copy_number
        made = builder.call(copy, nought)
        inside.call(copy, term, into=made)
        return made

    def _coefficients(self, moment: Moment, state: State) -> Coefficients:
        total = Coefficients()
        for mover in self.of("linear"):
            for name, term in self._terms(mover, moment, state).items():
                before = getattr(total, name)
                function = basic.sum_of_vectors if term.type == "vec3" else basic.sum_of_numbers
                summed = (
                    term
                    if before is None
                    else folded_call(moment.builder, moment.writer.precision, function, before, term, name=name)
                )
                setattr(total, name, summed)
        return total

    def _linear(self, moment: Moment, state: State, total: Coefficients, dt: Operand) -> None:
        """Write the exact flow of the linear part over dt."""
        builder = moment.builder
        builder.note = "linear motion"
        position, velocity = state.position, state.velocity
        assert isinstance(position, Column)
        both: Any = (position, velocity)
        constant = total.constant or ZERO
        if total.turning is not None and total.constant is None and total.damping is None:
            factors = builder.call(linear.spin_factors, total.turning, dt, name="factor")
            builder.call(linear.spin, *both, total.turning, dt, *factors, into=both)
        elif total.turning is not None:
            damping = total.damping or Uniform("0", "float", 0.0)
            builder.call(linear.spiral_fall, *both, constant, damping, total.turning, dt, into=both)
        elif total.damping is not None:
            builder.call(linear.damped_fall, *both, constant, total.damping, dt, into=both)
        elif total.constant is not None:
            builder.call(linear.fall, *both, constant, dt, into=both)
        elif velocity is not None:
            builder.call(basic.advance, position, velocity, dt, into=position)
        if total.applied is not None:
            builder.call(basic.advance, position, total.applied, dt, into=position)

    def _sims(self, moment: Moment, state: State) -> None:
        """Write a step of the paper's scheme: operations in stack order, then move."""
        builder = moment.builder
        before = builder.call(basic.copy_vector, state.velocity, name="before") if state.velocity is not None else None
        for mover in self.movers:
            if mover.idle:
                continue
            if mover.role in ("flow", "acceleration"):
                self._apply(mover, moment, state, moment.dt)
            elif mover.role == "linear":
                self._sims_linear(self._terms(mover, moment, state), moment, state)
        builder.note = "move"
        if before is not None:
            builder.call(basic.sims_move, state.position, before, state.velocity, moment.dt, into=state.position)  # type: ignore[arg-type]

    @staticmethod
    def _sims_linear(terms: dict[str, Operand], moment: Moment, state: State) -> None:
        builder, velocity = moment.builder, state.velocity
        if "constant" in terms:
            builder.call(basic.advance, velocity, terms["constant"], moment.dt, into=velocity)  # type: ignore[arg-type]
        if "damping" in terms:
            builder.call(basic.sims_scale, velocity, terms["damping"], moment.dt, into=velocity)  # type: ignore[arg-type]
        if "turning" in terms:
            factors = builder.call(linear.turn_factors, terms["turning"], moment.dt, name="factor")
            builder.call(linear.turn, velocity, terms["turning"], moment.dt, *factors, into=velocity)  # type: ignore[arg-type]
        if "applied" in terms:
            builder.call(basic.advance, state.position, terms["applied"], moment.dt, into=state.position)  # type: ignore[arg-type]
