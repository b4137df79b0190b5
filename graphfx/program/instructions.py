"""The instruction set: what the plan writes, and what the block machine and the reference path read.

A program works on the columns of one processor set. Every instruction acts under a mask, the
context of the Connection Machine: lanes outside it keep what they hold. No instruction moves a
value from one lane to another, so a lane's result depends on nothing but the lane.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

COMPONENTS = {"float": 1, "vec3": 3, "bool": 0, "id": 2, "draw": 4, "word": 1, "mesh": 2}
"""Columns that a value of each type takes; a bool takes none: it is a mask. A mesh is only ever one for all."""


@dataclass(frozen=True)
class Function:
    """A scalar function as an instruction: one kernel per function and precision, compiled once.

    A function of a `bundle` is compiled together with the others of it, and told from them by `number`.
    """

    name: str
    body: Callable[..., Any]
    arguments: tuple[str, ...]
    results: tuple[str, ...]
    branches: bool = False
    bundle: Bundle | None = field(default=None, compare=False)
    number: int = 0

    def __repr__(self) -> str:
        return self.name


def function(arguments: str, results: str) -> Callable[[Callable[..., Any]], Function]:
    """Make an instruction of a scalar function: types are named in one string, parted by spaces."""
    return lambda body: Function(body.__name__, body, tuple(arguments.split()), tuple(results.split()))


@dataclass(eq=False)
class Bundle:
    """Small functions that share one kernel, so that using another of them compiles nothing."""

    name: str
    functions: list[Function] = field(default_factory=list)

    def add(self, body: Callable[..., Any], arguments: tuple[str, ...], results: tuple[str, ...], name: str = "") -> Function:
        """Make a function of this bundle."""
        made = Function(name or body.__name__, body, arguments, results, bundle=self, number=len(self.functions))
        self.functions.append(made)
        return made

    def function(self, arguments: str, results: str) -> Callable[[Callable[..., Any]], Function]:
        """Make an instruction of a scalar function, in this bundle."""
        return lambda body: self.add(body, tuple(arguments.split()), tuple(results.split()))


@dataclass(frozen=True, eq=False)
class Operand:
    """A value that instructions read. Two operands are the same only if they are one object."""

    name: str
    type: str

    def __repr__(self) -> str:
        return self.name


@dataclass(frozen=True, eq=False, repr=False)
class Column(Operand):
    """One value per particle, in the scratch of a block."""


@dataclass(frozen=True, eq=False, repr=False)
class Uniform(Operand):
    """One value for all particles: constant (`value` given), or found anew for each run of the program."""

    value: Any = None

    def __repr__(self) -> str:
        return self.name


def constant_number(value: float) -> Uniform:
    """Return one number for all particles, which listings show as it is."""
    return Uniform(f"{value:g}", "float", float(value))


@dataclass(frozen=True)
class Call:
    """results = function(operands) under a mask."""

    function: Function
    operands: tuple[Operand, ...]
    results: tuple[Column, ...]
    mask: Column
    note: str = ""


@dataclass(frozen=True)
class Draw:
    """Four uniform random numbers from Philox, keyed by `key`, counted by (id, life, cell)."""

    key: tuple[int, int]
    identity: Operand
    life: Operand
    cell: Operand
    result: Column
    mask: Column
    note: str = ""


@dataclass(frozen=True, eq=False)
class Loop:
    """Run the body again while any lane of `mask` is on, at most `limit` times."""

    mask: Column
    body: list[Instruction]
    limit: int
    note: str = ""


Instruction = Call | Draw | Loop


@dataclass
class Program:
    """Instructions with their ends: what is loaded from the store and what is stored again.

    `loads` and `stores` name columns of the processor set, or arrays that the run hands over.
    `context` is the mask of the lanes that run at all. `uniforms` are found anew for each run.
    Lanes of `rejects` are not stored: the run reports them instead.
    """

    name: str
    context: Column
    body: list[Instruction] = field(default_factory=list)
    loads: dict[str, Column] = field(default_factory=dict)
    stores: dict[str, Column] = field(default_factory=dict)
    uniforms: list[Uniform] = field(default_factory=list)
    rejects: Column | None = None

    def walk(self) -> Iterator[Call | Draw | Loop]:
        """Yield every instruction, those inside loops too, in order."""
        yield from _walk(self.body)


def _walk(body: Any) -> Iterator[Call | Draw | Loop]:
    for instruction in body:
        yield instruction
        if isinstance(instruction, Loop):
            yield from _walk(instruction.body)


@dataclass
class Builder:
    """Writes instructions one after another under a current mask."""

    program: Program
    mask: Column
    body: list[Instruction] = field(default_factory=list)
    note: str = ""

    @classmethod
    def begin(cls, name: str) -> Builder:
        """Start a program."""
        context = Column("context", "bool")
        program = Program(name, context)
        return cls(program, context, program.body)

    def load(self, name: str, type_: str) -> Column:
        """Return the column that holds `name` of the store at the start."""
        if name not in self.program.loads:
            self.program.loads[name] = Column(name, type_)
        return self.program.loads[name]

    def store(self, name: str, column: Column) -> None:
        """Have the store take `column` back as `name` at the end."""
        self.program.stores[name] = column

    def uniform(self, name: str, type_: str) -> Uniform:
        """Return a value that each run of the program sets."""
        made = Uniform(name, type_)
        self.program.uniforms.append(made)
        return made

    def call(
        self, function: Function, *operands: Operand, into: tuple[Column, ...] | Column | None = None, name: str = ""
    ) -> Any:
        """Write a call; return its result column, or a tuple of them. `name` may name each, parted by spaces."""
        results = (into,) if isinstance(into, Column) else into
        if results is None:
            names = [name or function.name] if len(function.results) == 1 else (name or function.name).split()
            names += names[-1:] * (len(function.results) - len(names))
            results = tuple(map(Column, names, function.results))
        self.body.append(Call(function, operands, results, self.mask, self.note))
        return results[0] if len(results) == 1 else results

    def draw(self, key: tuple[int, int], identity: Operand, life: Operand, cell: Operand) -> Column:
        """Write a draw of four random numbers; return its column."""
        result = Column("draw", "draw")
        self.body.append(Draw(key, identity, life, cell, result, self.mask, self.note))
        return result

    def under(self, mask: Column, note: str = "") -> Builder:
        """Return a builder that goes on in the same body under another mask."""
        return Builder(self.program, mask, self.body, note or self.note)

    def loop(self, mask: Column, limit: int, note: str = "") -> Builder:
        """Open a loop; what the returned builder writes is its body, under `mask`."""
        inner: list[Instruction] = []
        self.body.append(Loop(mask, inner, limit, note or self.note))
        return Builder(self.program, mask, inner, note or self.note)
