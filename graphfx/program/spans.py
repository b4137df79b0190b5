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
    """Numbers instructions: `spans` are from the first use of each operand to the last; `inside` tells, of each loop in which it
    is used, whether the first use there reads it. Loops have the numbers of their first instructions; `ends` are of their last.
    """

    number: int = 0
    spans: dict[int, Span] = field(default_factory=dict)
    inside: dict[int, dict[int, bool]] = field(default_factory=dict)
    ends: dict[int, int] = field(default_factory=dict)
    open: list[int] = field(default_factory=list)

    def use(self, operand: Operand, read: bool) -> None:
        span = self.spans.setdefault(id(operand), Span(operand, self.number, self.number))
        span.last = self.number
        if self.open:
            inside = self.inside.setdefault(id(operand), {})
            for loop in self.open:
                inside.setdefault(loop, read)

    def body(self, body: list[Instruction]) -> None:
        for instruction in body:
            self.number += 1
            if isinstance(instruction, Loop):
                self.open.append(self.number)
            for operand in _read_by(instruction):
                self.use(operand, True)
            if isinstance(instruction, Loop):
                self.body(instruction.body)
                self.number += 1
                self.ends[self.open.pop()] = self.number
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
    for key, inside in numbering.inside.items():
        span = numbering.spans[key]
        for first, read in sorted(inside.items(), key=lambda loop: numbering.ends[loop[0]]):  # inner ones before outer ones
            if read or span.first < first or span.last > numbering.ends[first]:
                span.first, span.last = min(span.first, first), max(span.last, numbering.ends[first])
    return numbering.spans
