"""Find half way what depends on a particle's state: it goes there on trial, and back. Of second order, and as stable as it was.

    x' = A(x) x:    x(h) = exp(A(x~) h) x(0),    x~ = exp(A(x(0)) h/2) x(0)    [the exponential midpoint rule]
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from graphfx.motion import basic
from graphfx.plan.linear_motion import Coefficients, LinearMotion, write_flow
from graphfx.plan.moment import Moment, State
from graphfx.plan.movers import Mover
from graphfx.plan.scheme import kept_state, put_back
from graphfx.program import Builder, Column, Operand

Found = TypeVar("Found")


def anew(moment: Moment) -> Moment:
    """Return a step in which values are found again from the state as it is now; who is acted on stays."""
    return replace(moment, writer=moment.writer.again(), conditions=moment.conditions or moment.writer)


def half_way(
    builder: Builder, moment: Moment, state: State, go: Callable[[], None], find: Callable[[Moment], Found]
) -> Found:
    """Write `go`, which takes the state half way, and what is found there; then put the state back."""
    first = kept_state(builder, state)
    go()
    found = find(anew(moment))
    put_back(builder, state, first)
    return found


def operands_half_way(
    arguments: Callable[[Mover, Moment, State, dict[str, Operand]], list[Operand]],
    mover: Mover,
    builder: Builder,
    moment: Moment,
    state: State,
    dt: Operand,
    into: tuple[Column, ...],
) -> list[Operand]:
    """Return the operands of a flow over dt, its parameters as they are half way; one that is the state itself is copied."""
    short = arguments(mover, moment, state, {"dt": builder.call(basic.half, dt, name="half")})

    def there(later: Moment) -> list[Operand]:
        operands, own = arguments(mover, later, state, {"dt": dt}), (state.position, state.velocity)
        return [
            builder.call(basic.copy_vector, operand, name="there") if name in mover.node.arguments and operand in own else operand
            for name, operand in zip(mover.arguments, operands, strict=True)
        ]

    return half_way(builder, moment, state, lambda: builder.call(mover.function, *short, into=into), there)


def write_linear(
    linear: LinearMotion, moment: Moment, state: State, coefficients: Coefficients, cell: int, keeps: bool, dt: Operand
) -> None:
    """Write the linear motion over dt: as it is half way, where it depends on the state."""
    builder = moment.builder
    if linear.follows_state:
        half, now = builder.call(basic.half, dt, name="half"), anew(moment)
        first = linear.coefficients(now, state, cell)
        coefficients = half_way(
            builder,
            now,
            state,
            lambda: write_flow(now, state, first, half),
            lambda there: linear.coefficients(there, state, cell),
        )
    write_flow(moment, state, coefficients, dt, keeps)
