"""Write linear motion that has the form of a matrix: one exponential for a whole step, several for a step of one's own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import product
from typing import Any

import numpy as np

from graphfx.graph.values import Call
from graphfx.math import Vec3
from graphfx.motion import basic, matrix
from graphfx.plan.evaluate import timed_value
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.matrix_form import STATES, columns_of, random_value
from graphfx.plan.moment import ZERO, Moment, State
from graphfx.plan.movers import Mover
from graphfx.program import Builder, Column, Operand, Uniform, constant_number


@dataclass(eq=False)
class Matrix:
    """A matrix that each run must find: its columns of three numbers are uniforms, one above the other.

    It is exp(A h) and F(h) of some operators, with their parameters at the middle of step `k`; h is `time`, or where there
    is none 2^-`fraction` of a step. Without either it is A itself.
    """

    members: tuple[Mover, ...]
    k: int
    time: Uniform | None
    fraction: int | None
    uniforms: list[Uniform] = field(default_factory=list)
    rates: np.ndarray | None = None
    """A, where its parameters stay the same."""
    known: dict[Any, np.ndarray] = field(default_factory=dict)

    def find(self, rates: np.ndarray, values: dict[int, Any], length: float) -> dict[int, Any]:
        """Return the values of its uniforms, given A."""
        time = float(values[id(self.time)]) if self.time is not None else length * 2.0 ** -(self.fraction or 0)
        key = (time, rates.tobytes())
        if key not in self.known:
            itself = self.time is None and self.fraction is None
            self.known = {key: rates if itself else matrix.propagators(rates, time)}
        found = self.known[key]
        halves = [found[rows, column] for part in range(0, found.shape[1], 6) for rows in (slice(0, 3), slice(3, 6))
                  for column in range(part, part + 6)]  # fmt: skip
        return {id(uniform): tuple(half) for uniform, half in zip(self.uniforms, halves, strict=True)}


def generator(members: tuple[Mover, ...], time: float, frame: int) -> np.ndarray:
    """Return the matrix A of (P, V)' = A (P, V) + ... at a time: 6 x 6."""
    rates = np.zeros((6, 6))
    rates[:3, 3:] = np.eye(3)
    random = np.random.default_rng(1962)
    for mover in members:
        given: dict[str, Any] = {}
        for name, kind in zip(mover.arguments, mover.function.arguments, strict=True):
            assert mover.matrix is not None
            if name in STATES:
                continue
            if name not in mover.matrix.uniform:
                given[name] = random_value(kind, random)
                continue
            value = mover.matrix.uniform[name]
            tree = Call("normalize", (value,)) if value.type == "direction" else value
            found = timed_value(tree, time, frame)
            vector = isinstance(found, tuple)
            given[name] = Vec3(*map(np.float64, found)) if vector else np.bool_(found) if kind == "bool" else np.float64(found)
        first = 3 if mover.writes_velocity else 0
        rates[first : first + 3] += columns_of(mover.function, mover.arguments, given)
    return rates


def find_matrices(
    made: FrameProgram, values: dict[int, Any], middle: Callable[[int], float], frame: int, length: float
) -> dict[int, Any]:
    """Return the values of the uniforms of all matrices of a program; `middle` gives the time of the middle of a step [s]."""
    found: dict[int, Any] = {}
    rates: dict[Any, np.ndarray] = {}
    for each in made.matrices.values():
        key = (tuple(map(id, each.members)), each.k)
        if key not in rates:
            rates[key] = each.rates if each.rates is not None else generator(each.members, middle(each.k), frame)
        if all(mover.constant for mover in each.members):
            each.rates = rates[key]
        found |= each.find(rates[key], values, length)
    return found


@dataclass
class MatrixMotion:
    """The linear motion of operators that all have the form of a matrix."""

    movers: list[Mover]

    def write(self, moment: Moment, state: State, applied: Operand | None, constant: Operand | None, dt: Operand) -> None:
        """Write the flow over dt, for each class of particles that the operators' conditions make."""
        forces = (applied or ZERO, constant or ZERO) if applied is not None or constant is not None else None
        for builder, members in self._classes(moment):
            velocity = state.velocity
            if not isinstance(velocity, Column):  # it stays what it is: nothing here changes it
                velocity = builder.call(basic.copy_vector, velocity or ZERO, name="same velocity")
            columns = (state.position, velocity)
            if isinstance(dt, Uniform):
                _go(builder, columns, _matrix(moment, builder, members, dt), forces)
            else:
                _go_by_fractions(moment, builder, columns, members, forces or (ZERO, ZERO), dt)

    def _classes(self, moment: Moment) -> Iterator[tuple[Builder, tuple[Mover, ...]]]:
        """Yield builders under the mask of each class, and the operators that act there."""
        selective = [mover for mover in self.movers if mover.node.only is not None and mover.matrix and mover.matrix.matrix]
        for chosen in product((True, False), repeat=len(selective)):
            builder, left = moment.builder, set()
            for mover, within in zip(selective, chosen, strict=True):
                only = moment.writer.operand(mover.node.only)
                builder = builder.under(builder.call(basic.both if within else basic.but_not, builder.mask, only, name="class"))
                left |= set() if within else {id(mover)}
            yield builder, tuple(mover for mover in self.movers if id(mover) not in left)


def _matrix(
    moment: Moment, builder: Builder, members: tuple[Mover, ...], time: Uniform | None, fraction: int | None = None
) -> list[Uniform]:
    """Return the columns of a matrix, uniforms made when they are first asked for."""
    made = moment.made
    assert made is not None
    k = 0 if all(mover.constant for mover in members) else moment.k
    key = (tuple(map(id, members)), k, id(time), fraction)
    if key not in made.matrices:
        itself = time is None and fraction is None
        name = "A" if itself else "exp(A h)" if fraction is None else f"exp(A h / {2**fraction})"
        count = 12 if itself else 24
        uniforms = [builder.uniform(f"{name}.{number}", "vec3") for number in range(count)]
        made.matrices[key] = Matrix(members, k, time, fraction, uniforms)
    found: list[Uniform] = made.matrices[key].uniforms
    return found


def _go(builder: Builder, state: tuple[Any, Any], columns: list[Uniform], forces: tuple[Operand, Operand] | None) -> None:
    """Write (P, V) = exp(A h) (P, V) + F(h) (u, g)."""
    parts: list[Column] = []
    for half in (0, 6):
        part = builder.call(matrix.product, *state, *columns[half : half + 6], name="part")
        if forces is not None:
            forced = builder.call(matrix.product, *forces, *columns[12 + half : 18 + half], name="forced")
            part = builder.call(basic.sum_of_vectors, part, forced, name="part")
        parts.append(part)
    for into, part in zip(state, parts, strict=True):
        builder.call(basic.copy_vector, part, into=into)


def _go_by_fractions(
    moment: Moment,
    builder: Builder,
    state: tuple[Any, Any],
    members: tuple[Mover, ...],
    forces: tuple[Operand, Operand],
    dt: Operand,
) -> None:
    """Write a step of one's own: the binary fractions of a whole step that it has, and a Taylor series for the rest."""
    assert moment.made is not None
    length = moment.made.time(builder, "length")
    left = builder.call(basic.copy_number, dt, name="left")
    for fraction in range(matrix.FRACTIONS + 1):
        share = constant_number(2.0**-fraction)
        inner = builder.under(builder.call(matrix.is_left, left, length, share, name="fraction"))
        _go(inner, state, _matrix(moment, builder, members, None, fraction), forces)
        inner.call(matrix.less, left, length, share, into=left)
    rates = _matrix(moment, builder, members, None)
    term: tuple[Operand, Operand] = state
    for number in range(1, matrix.TERMS + 1):
        changed = [builder.call(matrix.product, *term, *rates[half : half + 6], name="term") for half in (0, 6)]
        if number == 1:
            changed = [builder.call(basic.sum_of_vectors, part, force) for part, force in zip(changed, forces, strict=True)]
        term = (Column("term", "vec3"), Column("term", "vec3"))
        builder.call(matrix.next_term, *state, *changed, left, constant_number(1.0 / number), into=(*state, *term))
