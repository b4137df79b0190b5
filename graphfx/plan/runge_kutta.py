"""Write a step of the method rk45: rates of change of the whole motion at seven instants, and what they sum up to."""

from __future__ import annotations

from typing import Any

from graphfx.motion import basic, runge_kutta
from graphfx.plan.linear_motion import zero_outside
from graphfx.plan.moment import ZERO, Moment, State
from graphfx.plan.movers import INNER_ROLES
from graphfx.plan.scheme import kept_state, put_back
from graphfx.plan.white_noise import NOUGHT
from graphfx.program import Builder, Column, Operand, constant_number

Rates = dict[str, Operand]


def write_runge_kutta(motion: Any, moment: Moment, state: State) -> dict[str, Operand]:
    """Write a step of dt in place; return the differences of the results of orders 5 and 4."""
    builder = moment.builder
    first = kept_state(builder, state)
    rates: list[Rates] = []
    for instant, shares in zip(runge_kutta.INSTANTS, runge_kutta.STAGES, strict=True):
        put_back(builder, state, first)
        for earlier, share in zip(rates, shares, strict=True):
            _advance(builder, state, earlier, moment.dt, share)
        rates.append(_rates_at(motion, moment.instant(instant), state))
    errors: dict[str, Operand] = {}
    for name in first:
        error = builder.call(basic.copy_vector, ZERO, name=f"error of {name}")
        for rate, share in zip(rates, runge_kutta.ERRORS, strict=True):
            if share and name in rate:
                builder.call(runge_kutta.advance_by, error, rate[name], moment.dt, constant_number(share), into=error)
        errors[name] = error
    return errors


def _advance(builder: Builder, state: State, rates: Rates, dt: Operand, share: float) -> None:
    for name, rate in rates.items():
        into = state.read(name)
        if share and isinstance(into, Column):
            builder.call(runge_kutta.advance_by, into, rate, dt, constant_number(share), into=into)


def _rates_at(motion: Any, moment: Moment, state: State) -> Rates:
    """Write the rates of change of position and velocity at an instant."""
    builder = moment.builder
    motion.select(moment)
    total = motion.linear.coefficients(moment, state, moment.cell or 0)
    velocity = state.velocity
    rates: Rates = {}
    if motion.has_velocity and velocity is not None:
        rates["position"] = builder.call(basic.copy_vector, velocity, name="rate of position")
        factors = (total.damping or NOUGHT, total.turning or ZERO, total.stiffness or NOUGHT)
        rate = builder.call(runge_kutta.linear_rate, state.position, velocity, *factors, name="rate of velocity")
        if total.constant is not None:
            rate = builder.call(basic.sum_of_vectors, rate, total.constant, name="rate of velocity")
        rates["velocity"] = rate
    if total.applied is not None:
        _add(builder, rates, "position", total.applied)
    for mover in (mover for role in INNER_ROLES for mover in motion.of(role)):
        builder.note = mover.node.path
        inside = motion.under_conditions(mover, moment)
        rate = inside.call(mover.function, *motion.arguments(mover, moment, state), name=mover.role)
        if mover.node.during is not None or mover.node.only is not None:
            rate = zero_outside(builder, inside, rate)
        _add(builder, rates, "position" if mover.role == "velocity" else "velocity", rate)
    return rates


def _add(builder: Builder, rates: Rates, name: str, rate: Operand) -> None:
    before = rates.get(name)
    rates[name] = rate if before is None else builder.call(basic.sum_of_vectors, before, rate, name=f"rate of {name}")
