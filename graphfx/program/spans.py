"""How long the columns of a program are needed, so that others may have their places afterwards.

Instructions are numbered in the order in which they stand, those inside loops too. A column is needed from its first
occurrence to its last. It is needed through all of a loop in which it occurs if it occurs outside as well, or if what it
holds comes from the turn before: if its first occurrence in the body reads it.
[Aho, Lam, Sethi and Ullman 2007, Compilers, 8.8]
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from graphfx.program.instructions import Call, Draw, Instruction, Loop, Operand, Program


@dataclass
class Span:
    """An operand and the numbers of the first and the last instruction that need it."""

    operand: Operand
    first: int
    last: int


@dataclass
class _Numbering:
    """Numbers instructions: `uses` are (number, whether it is read) of each operand in order, `loops` first and last numbers,
    inner ones before outer ones."""

    number: int = 0
    operands: dict[int, Operand] = field(default_factory=dict)
    uses: dict[int, list[tuple[int, bool]]] = field(default_factory=dict)
    loops: list[tuple[int, int]] = field(default_factory=list)

    def use(self, operand: Operand, read: bool) -> None:
        self.operands[id(operand)] = operand
        self.uses.setdefault(id(operand), []).append((self.number, read))

    def body(self, body: list[Instruction]) -> None:
        for instruction in body:
            self.number += 1
            for operand in _read_by(instruction):
                self.use(operand, True)
            if isinstance(instruction, Loop):
                first = self.number
                self.body(instruction.body)
                self.number += 1
                self.loops.append((first, self.number))
            else:
                for operand in instruction.results if isinstance(instruction, Call) else (instruction.result,):
                    self.use(operand, False)


def _read_by(instruction: Instruction) -> Iterator[Operand]:
    if isinstance(instruction, Call):
        yield from instruction.operands
    elif isinstance(instruction, Draw):
        yield from (instruction.identity, instruction.life, instruction.cell)
    yield instruction.mask


def spans_of(program: Program) -> dict[int, Span]:
    """Return the span of every operand by its id: what is loaded from the start, what is stored to the end."""
    numbering = _Numbering()
    for column in program.loads.values():
        numbering.use(column, False)
    numbering.body(program.body)
    numbering.number += 1
    for column in (*program.stores.values(), program.context, *([program.rejects] if program.rejects else [])):
        numbering.use(column, True)
    spans: dict[int, Span] = {}
    for key, uses in numbering.uses.items():
        spans[key] = span = Span(numbering.operands[key], uses[0][0], uses[-1][0])
        for first, last in numbering.loops:
            inside = [read for number, read in uses if first <= number <= last]
            if inside and (inside[0] or span.first < first or span.last > last):
                span.first, span.last = min(span.first, first), max(span.last, last)
    return spans
