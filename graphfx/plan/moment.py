"""A particle's state, and a step in time, as the operands that programs are written with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Operand


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
    """A step at which motion is written: `dt` [s], a writer whose clock stands in the middle of it, and how to open a mask.

    `then` is when it begins [s from the start of the frame]. `cell_time` gives a time of the p-th cell of held noise
    that the step meets: "cell" is its number, "cell begin" and "cell end" its ends.
    """

    builder: Builder
    dt: Operand
    half: Callable[[], Operand]
    writer: ValueWriter
    then: Operand
    cell_time: Callable[[str, int], Operand]
