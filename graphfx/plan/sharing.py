"""Leave out instructions whose results are there already: local value numbering.

    same function, same operands unchanged since, same mask unchanged since  ->  the earlier result

Only columns that a single instruction writes stand for each other; those that a program changes in
place keep their instructions. What a loop's body writes is new in every turn: nothing from before the
loop that rests on it is used inside, and nothing from inside is used after.
[Aho, Lam, Sethi and Ullman 2007, Compilers, 8.5]
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from graphfx.program import Call, Column, Draw, Instruction, Loop, Operand, Program, Uniform


def share(program: Program) -> Program:
    """Rewrite a program in place so that nothing is found twice; return it."""
    sharing = _Sharing(Counter(id(column) for instruction in program.walk() for column in _written(instruction)))
    sharing.fixed = {id(column) for column in program.loads.values()}
    program.body[:] = sharing.body(program.body)
    program.stores = {name: sharing.now(column) for name, column in program.stores.items()}
    if program.rejects is not None:
        program.rejects = sharing.now(program.rejects)
    return program


def _written(instruction: Instruction) -> tuple[Column, ...]:
    if isinstance(instruction, Loop):
        return ()
    return instruction.results if isinstance(instruction, Call) else (instruction.result,)


def _written_inside(body: list[Instruction]) -> Iterator[Column]:
    for instruction in body:
        yield from _written(instruction)
        if isinstance(instruction, Loop):
            yield from _written_inside(instruction.body)


@dataclass
class _Sharing:
    """`writes` counts the instructions that write a column; `version` how often it was written so far; `stands`
    maps a column that is not written any more to the one in its place; `found` what is there, by its key."""

    writes: Counter[int]
    fixed: set[int] = field(default_factory=set)
    version: Counter[int] = field(default_factory=Counter)
    stands: dict[int, Column] = field(default_factory=dict)
    found: dict[Any, tuple[Column, ...]] = field(default_factory=dict)

    def now(self, operand: Any) -> Any:
        """Return the operand that holds a value after sharing."""
        return self.stands.get(id(operand), operand)

    def body(self, body: list[Instruction]) -> list[Instruction]:
        """Return the instructions that are left of a body."""
        return [kept for instruction in body if (kept := self._kept(instruction)) is not None]

    def _kept(self, instruction: Instruction) -> Instruction | None:
        if isinstance(instruction, Loop):
            return self._loop(instruction)
        if isinstance(instruction, Call):
            *operands, mask = map(self.now, (*instruction.operands, instruction.mask))
            instruction = replace(instruction, operands=tuple(operands), mask=mask)
            key: Any = (id(instruction.function), *map(self._state, (*operands, mask)))
        else:
            operands = [self.now(getattr(instruction, name)) for name in ("identity", "life", "cell", "mask")]
            instruction = replace(instruction, **dict(zip(("identity", "life", "cell", "mask"), operands, strict=True)))
            key = (instruction.key, *map(self._state, operands))
        return self._shared(instruction, key)

    def _shared(self, instruction: Call | Draw, key: Any) -> Instruction | None:
        results = _written(instruction)
        single = all(map(self._single, results))
        if single and key in self.found:
            self.stands |= {id(column): other for column, other in zip(results, self.found[key], strict=True)}
            return None
        self.version.update(id(column) for column in results)
        if single:
            self.found[key] = results
        return instruction

    def _single(self, column: Column) -> bool:
        return self.writes[id(column)] == 1 and id(column) not in self.fixed

    def _state(self, operand: Operand) -> Any:
        """Return a key of what an operand holds now."""
        if isinstance(operand, Uniform):
            return id(operand) if operand.value is None else (operand.type, repr(operand.value))
        return id(operand), self.version[id(operand)]

    def _loop(self, loop: Loop) -> Loop:
        changing = [id(column) for column in _written_inside(loop.body)]
        self.version.update(changing)
        before = dict(self.found)
        made = replace(loop, mask=self.now(loop.mask), body=self.body(loop.body))
        self.found = before
        self.version.update(changing)
        return made
