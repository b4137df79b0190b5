"""Mind the ends of the numbers: keep what rounding takes from a place, and let what decays end at 0.

A way that is short beside its place is added to `remainder`, what rounding has taken from the place so far, and both are
then joined: P' + r' = P + (r + way), with P' rounded and r' exact. So after any number of steps a place is off by one unit
in its last place, not by one a step. [Knuth 1969, 4.2.2, theorem B; Kahan 1965]

A decay never ends by itself: it goes on among the denormal numbers, which some processors compute thirty times slower.
"""

from __future__ import annotations

from graphfx.motion import basic
from graphfx.plan.moment import Moment, State
from graphfx.program import Column, Uniform

REMAINDER = "remainder"
"""The column of what rounding took from the position [m]."""
LEAST = {
    32: Uniform("2^-110", "float", 2.0**-110),
    64: Uniform("2^-1000", "float", 2.0**-1000),
}
"""Coordinates and speeds less than that are 0: far below what anything is measured in, and no denormal by far."""


def settle(moment: Moment, state: State, position: bool) -> None:
    """Write that a speed next to nothing is none; with `position` a coordinate too."""
    least = LEAST[moment.writer.precision]
    for value in (state.velocity, state.position if position else None):
        if isinstance(value, Column):
            moment.builder.call(basic.settled, value, least, into=value)


def way_of(state: State, keeps: bool) -> Column:
    """Return what a way is added to: the remainder where there is one, else the position."""
    column = state.attribute(REMAINDER) if keeps else state.position
    assert isinstance(column, Column)
    return column
