"""Write the linear part of a motion: the terms of its operators, their sum, and the one exact flow of that."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from typing import Any

from graphfx.motion import basic, linear, spring
from graphfx.plan.matrix_motion import MatrixMotion
from graphfx.plan.moment import ZERO, Moment, State
from graphfx.plan.movers import Mover
from graphfx.plan.rounding import way_of
from graphfx.plan.values import folded_call
from graphfx.plan.white_noise import NOUGHT, WhiteNoise
from graphfx.program import Builder, Column, Operand, Uniform

X_AXIS, Y_AXIS = Uniform("(1, 0, 0)", "vec3", (1.0, 0.0, 0.0)), Uniform("(0, 1, 0)", "vec3", (0.0, 1.0, 0.0))
ONE = Uniform("1", "float", 1.0)
FAR_AWAY = Uniform("(2^60, 0, 0)", "vec3", (basic.FAR, 0.0, 0.0))
"""So far that what pulls there tells its stiffness to the last digit, wherever it pulls to."""

Terms = dict[str, Operand]
Arguments = Callable[..., list[Operand]]


@dataclass
class Coefficients:
    """The linear motion V' = g - d V + w x V - k P, P' = V + u: what there is of it."""

    constant: Operand | None = None
    damping: Operand | None = None
    turning: Operand | None = None
    stiffness: Operand | None = None
    applied: Operand | None = None
    matrix: MatrixMotion | None = None

    @property
    def empty(self) -> bool:
        """Return whether there is nothing of it."""
        return all(getattr(self, each.name) is None for each in fields(self))


@dataclass
class LinearMotion:
    """The linear operators of one emitter, and its noise, which is constant within a cell and a step.

    `arguments` gives the operands of an operator's function, `conditions` the builder under those of an operator;
    `changing` are the attributes that are set within a frame; `noise` writes random vectors.
    """

    movers: list[Mover]
    arguments: Arguments
    conditions: Callable[[Mover, Moment], Builder]
    changing: frozenset[str]
    noise: WhiteNoise
    _cached: dict[tuple[int, int], Terms] = field(default_factory=dict)

    @property
    def matrix(self) -> MatrixMotion | None:
        """Return the motion by the exponential of a matrix, where the operators have that form."""
        linear = [mover for mover in self.movers if mover.role == "linear"]
        return MatrixMotion(linear) if any(mover.matrix for mover in linear) else None

    @property
    def follows_state(self) -> bool:
        """Return whether what it is depends on where a particle is, or on how it moves."""
        return any(mover.follows_state for mover in self.movers)

    @property
    def springs(self) -> bool:
        """Return whether what it does depends on the place."""
        return self.matrix is not None or any(mover.form is not None and mover.form.stiffness for mover in self.movers)

    def prepare(self, moment: Moment, state: State) -> None:
        """Write, once for all steps, the terms that stay the same."""
        for mover in self.movers:
            if self._is_fixed(mover):
                self.terms(mover, moment, state)

    def _is_fixed(self, mover: Mover) -> bool:
        """Return whether an operator's terms stay the same through a frame."""
        return mover.role == "linear" and mover.time_free and not self.changing.intersection(mover.arguments)

    def coefficients(self, moment: Moment, state: State, cell: int = 0) -> Coefficients:
        """Write the sum of all terms; noise is that of the `cell`-th cell that the step meets."""
        total = Coefficients(matrix=self.matrix)
        for mover in self.movers:
            for name, term in self.terms(mover, moment, state, cell).items():
                before = getattr(total, name)
                function = basic.sum_of_vectors if term.type == "vec3" else basic.sum_of_numbers
                summed = term if before is None else _folded(moment, function, before, term, name=name)
                setattr(total, name, summed)
        return total

    def terms(self, mover: Mover, moment: Moment, state: State, cell: int = 0) -> Terms:
        """Write an operator's terms: constant, damping, turning (of V), stiffness (of P) or applied (to P)."""
        key = (id(mover), id(moment.builder.program))
        fixed = self._is_fixed(mover)
        if fixed and key in self._cached:
            return self._cached[key]
        moment.builder.note = mover.node.path
        builder = self.conditions(mover, moment)
        found = self._noise(mover, moment, state, cell) if mover.role == "noise" else self._linear(mover, moment, state, builder)
        if mover.node.during is not None or mover.node.only is not None:
            found = {name: zero_outside(moment.builder, builder, term) for name, term in found.items()}
        if fixed:
            self._cached[key] = found
        return found

    def _noise(self, mover: Mover, moment: Moment, state: State, cell: int) -> Terms:
        """Write what is random in a cell and what the operator makes of it."""
        random = {"draw": self.noise.draw, "noise": self.noise.vector}
        handed = {name: write(mover, moment, cell) for name, write in random.items() if name in mover.arguments}
        given = self.arguments(mover, moment, state, handed)
        made = moment.builder.call(mover.function, *given, name=mover.node.node_type.name)
        return {"constant" if mover.writes_velocity else "applied": made}

    def _linear(self, mover: Mover, moment: Moment, state: State, builder: Builder) -> Terms:
        """Write what an operator's form has, found by evaluating it at a few states."""

        def evaluate(position: Operand, velocity: Operand) -> Operand:
            given = self.arguments(mover, moment, state, {"position": position, "velocity": velocity})
            return folded_call(builder, moment.writer.precision, mover.function, *given, name=mover.node.node_type.name)

        if mover.matrix is not None:
            name = "constant" if mover.writes_velocity else "applied"
            return {name: evaluate(ZERO, ZERO)} if mover.matrix.constant else {}
        if mover.form is None:
            return {"applied": evaluate(ZERO, ZERO)}
        form, found = mover.form, {}
        zero = evaluate(ZERO, ZERO) if form.constant else None

        def change(position: Operand, velocity: Operand) -> Operand:
            rate = evaluate(position, velocity)
            return rate if zero is None else _folded_under(builder, moment, basic.difference_of_vectors, rate, zero)

        if zero is not None:
            found["constant"] = zero
        first = change(ZERO, X_AXIS) if form.damping or form.turning else None
        if form.damping:
            found["damping"] = _folded_under(builder, moment, basic.damping_of, first, name="damping")
        if form.turning:
            found["turning"] = _folded_under(builder, moment, basic.spin_of, first, change(ZERO, Y_AXIS), name="turning")
        if form.stiffness:
            found["stiffness"] = _folded_under(builder, moment, basic.stiffness_of, change(FAR_AWAY, ZERO), name="stiffness")
        return found


def write_flow(moment: Moment, state: State, total: Coefficients, dt: Operand, keeps: bool = False) -> None:
    """Write the exact flow of a linear motion over dt; with `keeps` what rounding takes from the place is kept."""
    builder = moment.builder
    builder.note = "linear motion"
    position, velocity = state.position, state.velocity
    assert isinstance(position, Column)
    if total.matrix is not None:
        total.matrix.write(moment, state, total.applied, total.constant, dt)
        return
    if total.stiffness is not None:
        _write_spring(moment, state, total, dt)
        return
    way = way_of(state, keeps)
    both: Any = (way, velocity)
    constant = total.constant or ZERO
    if total.turning is not None and total.constant is None and total.damping is None:
        factors = builder.call(linear.spin_factors, total.turning, dt, name="factor")
        builder.call(linear.spin, *both, total.turning, dt, *factors, into=both)
    elif total.turning is not None:
        builder.call(linear.spiral_fall, *both, constant, total.damping or NOUGHT, total.turning, dt, into=both)
    elif total.damping is not None:
        builder.call(linear.damped_fall, *both, constant, total.damping, dt, into=both)
    elif total.constant is not None:
        builder.call(linear.fall, *both, constant, dt, into=both)
    elif velocity is not None:
        builder.call(basic.advance, way, velocity, dt, into=way)
    if total.applied is not None:
        builder.call(basic.advance, way, total.applied, dt, into=way)
    if keeps:
        builder.call(basic.joined, position, way, into=(position, way))


def write_without_drift(moment: Moment, state: State, total: Coefficients, dt: Operand) -> None:
    """Write the exact flow of a linear motion over dt in which velocities carry nothing: V' = (g - k P) - d V + w x V, P' = u."""
    builder, position, velocity = moment.builder, state.position, state.velocity
    assert isinstance(position, Column)
    constant = total.constant
    if total.stiffness is not None:
        constant = builder.call(basic.sims_pull, constant or ZERO, position, total.stiffness, ONE, name="constant")
    still = builder.call(basic.copy_vector, position, name="still")
    if velocity is not None and (constant is not None or total.damping is not None or total.turning is not None):
        alone = Coefficients(constant, total.damping, total.turning)
        write_flow(moment, State(still, velocity, state.attribute), alone, dt)
    if total.applied is not None:
        builder.call(basic.advance, position, total.applied, dt, into=position)


def _write_spring(moment: Moment, state: State, total: Coefficients, dt: Operand) -> None:
    """Write the flow of a motion with a spring in it.

    An applied velocity u moves the place at which a spring pulls: with W = V + u in place of V, P' = W and
    W' = (g + d u - w x u) - d W + w x W - k P.
    """
    builder, velocity, stiffness = moment.builder, state.velocity, total.stiffness
    assert isinstance(velocity, Column) and stiffness is not None
    constant, damping, turning = total.constant or ZERO, total.damping or NOUGHT, total.turning
    if total.applied is not None:
        constant = _folded(moment, spring.constant_carried, constant, damping, turning or ZERO, total.applied, name="constant")
        builder.call(basic.sum_of_vectors, velocity, total.applied, into=velocity)
    both: Any = (state.position, velocity)
    if turning is None:
        factors = builder.call(spring.spring_factors, damping, stiffness, dt, name="factor")
        builder.call(spring.damped_spring, *both, constant, stiffness, dt, *factors, into=both)
    else:
        along = builder.call(spring.spring_factors, damping, stiffness, dt, name="factor")
        across = builder.call(spring.turned_factors, damping, turning, stiffness, dt, name="factor")
        builder.call(spring.spiral_spring, *both, constant, turning, stiffness, dt, *along, *across, into=both)
    if total.applied is not None:
        builder.call(basic.difference_of_vectors, velocity, total.applied, into=velocity)


def write_paper_step(moment: Moment, state: State, terms: Terms) -> None:
    """Write what one linear operator does in a step of the paper's scheme."""
    builder, velocity = moment.builder, state.velocity
    into: Any = velocity
    if "constant" in terms:
        builder.call(basic.advance, velocity, terms["constant"], moment.dt, into=into)  # type: ignore[arg-type]
    if "stiffness" in terms:
        builder.call(basic.sims_pull, velocity, state.position, terms["stiffness"], moment.dt, into=into)  # type: ignore[arg-type]
    if "damping" in terms:
        builder.call(basic.sims_scale, velocity, terms["damping"], moment.dt, into=into)  # type: ignore[arg-type]
    if "turning" in terms:
        factors = builder.call(linear.turn_factors, terms["turning"], moment.dt, name="factor")
        builder.call(linear.turn, velocity, terms["turning"], moment.dt, *factors, into=into)  # type: ignore[arg-type]
    if "applied" in terms:
        builder.call(basic.advance, state.position, terms["applied"], moment.dt, into=state.position)  # type: ignore[arg-type]


def _folded(moment: Moment, function: Any, *operands: Operand, name: str = "") -> Operand:
    return _folded_under(moment.builder, moment, function, *operands, name=name)


def _folded_under(builder: Builder, moment: Moment, function: Any, *operands: Any, name: str = "") -> Operand:
    return folded_call(builder, moment.writer.precision, function, *operands, name=name)


def zero_outside(builder: Builder, inside: Builder, term: Operand) -> Operand:
    """Return a term that is zero where the operator does not act."""
    vector = term.type == "vec3"
    copy = basic.copy_of(term.type)
    made = builder.call(copy, ZERO if vector else NOUGHT)
    inside.call(copy, term, into=made)
    return made
