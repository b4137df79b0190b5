"""Write what becomes of particles that leave the numbers: they stay where they were, and are counted.

    a step that leads from numbers to what is infinite, or to no number, is not taken

Whole steps reject such a particle, unchanged; its own time takes the step back. So a picture is never given a place that
is none because of how a particle moves, and what grows without end is told, in its own words, where it happens.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.graph.values import Call, Literal, children
from graphfx.math import Vec3
from graphfx.motion import basic, overflow
from graphfx.plan.evaluate import constant_value
from graphfx.plan.matrix_form import columns_of, random_value
from graphfx.plan.moment import State
from graphfx.plan.motion import Motion
from graphfx.plan.movers import INNER_ROLES, STATE, Mover, linear_form
from graphfx.plan.rounding import REMAINDER
from graphfx.plan.scheme import kept_state, put_back
from graphfx.program import Builder, Column

TRIALS = 16
DOUBTFUL = {"divide", "modulo", "power", "exp", "log", "sqrt", "smoothstep"}
"""Functions of expressions that make of some numbers what is none."""


def may_overflow(motion: Motion) -> bool:
    """Return whether steps are looked at: not where all that acts is a constant, slows down or pulls back, nor in the paper's
    scheme, whose particles are told of where they are drawn."""
    if motion.method == "sims":
        return False
    if motion.linear.matrix is not None or any(motion.of(role) for role in (*INNER_ROLES, "surface")):
        return True
    return any(may_grow(mover) or mover.follows_state or any(map(_may_be_none, mover.node.arguments.values()))
               for mover in motion.linear.movers)


def _may_be_none(value: Any) -> bool:
    """Return whether a parameter may be infinite, or no number: it has a division in it, a root or the like."""
    return (isinstance(value, Call) and value.function in DOUBTFUL) or any(map(_may_be_none, children(value)))


def growing(motion: Motion) -> list[Mover]:
    """Return the linear operators, or flows with such a form, that may drive particles away faster and faster."""
    return [mover for mover in motion.movers if not mover.idle and may_grow(linear_form(mover) or mover)]


def may_grow(mover: Mover) -> bool:
    """Return whether a rate of change may have a positive factor of what it changes: -d of g - d V + w x V - k P, or -k.

    Parameters that are no constants are tried with some random numbers in the ranges that they are declared to have.
    """
    if mover.role != "linear" or not {*STATE}.intersection(mover.arguments):
        return False
    random = np.random.default_rng(1969)
    for _ in range(TRIALS):
        given = {name: _some_value(mover, name, kind, random)
                 for name, kind in zip(mover.arguments, mover.function.arguments, strict=True) if name not in STATE}
        matrix = columns_of(mover.function, mover.arguments, given)
        of_place, of_speed = np.diagonal(matrix).max(), np.diagonal(matrix, 3).max()
        if of_place > 0 or (mover.writes_velocity and of_speed > 0):
            return True
    return False


def _some_value(mover: Mover, name: str, kind: str, random: np.random.Generator) -> object:
    value, declared = mover.node.arguments.get(name), mover.node.node_type.parameters.get(name)
    if isinstance(value, Literal):
        found = constant_value(value)
        return Vec3(*map(np.float64, found)) if kind == "vec3" else np.bool_(found) if kind == "bool" else np.float64(found)
    if kind == "float" and declared is not None:
        low = declared.min if declared.min is not None and np.isfinite(declared.min) else -1.0
        return np.float64(low + random.choice([0.0, 1.0]) * random.uniform(0.0, 2.0))
    return random_value(kind, random)


def beyond(builder: Builder, state: State) -> Column | None:
    """Write who has left the numbers; return None where nothing of the motion is stored."""
    builder.note = "beyond the numbers"
    parts = [part for part in (state.position, state.velocity) if isinstance(part, Column)]
    if not parts:
        return None
    found: Column = builder.call(overflow.are_beyond if len(parts) > 1 else overflow.is_beyond, *parts, name="beyond")
    return found


@dataclass
class Guard:
    """Keeps the particles of one program within the numbers; `lost` are those for whom a step was not taken."""

    lost: Column
    keeps: bool

    @classmethod
    def begin(cls, builder: Builder, keeps: bool) -> Guard:
        """Begin with nobody lost; with `keeps` what rounding takes from places is kept."""
        return cls(builder.call(basic.but_not, builder.mask, builder.mask, name="lost"), keeps)

    def start(self, builder: Builder, state: State) -> dict[str, Column]:
        """Keep where a step starts."""
        kept = kept_state(builder, state)
        if self.keeps:
            kept[REMAINDER] = builder.call(basic.copy_vector, state.read(REMAINDER), name=f"first {REMAINDER}")
        return kept

    def end(self, builder: Builder, state: State, kept: dict[str, Column], step: Column, whole: Column) -> None:
        """Take the step back of those whom it leads beyond the numbers; they stand still for the `whole` of it."""
        first = State(kept.get("position", state.position), kept.get("velocity", state.velocity), state.attribute)
        gone, before = beyond(builder, state), beyond(builder, first)
        if gone is None or before is None:
            return
        found = builder.call(basic.but_not, gone, before, name="lost")
        inside = builder.under(found)
        put_back(inside, state, kept)
        inside.call(basic.copy_number, whole, into=step)
        builder.under(builder.program.context).call(basic.either, self.lost, found, into=self.lost)
