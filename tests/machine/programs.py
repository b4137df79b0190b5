"""Random programs, and how to run a program both ways: on the machine and in plain Python."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphfx.cook.executor import Job, ReferenceExecutor
from graphfx.machine.assemble import assemble
from graphfx.machine.run import NO_ROWS, Rows, bits_of, run
from graphfx.machine.transfer import BLOCK
from graphfx.motion import basic
from graphfx.motion.contact import respond
from graphfx.plan.arithmetic import EXPRESSIONS, random_number
from graphfx.program import Builder, Column, Function, Operand, Program, Uniform

KINDS: dict[int, Any] = {32: np.float32, 64: np.float64}
FUNCTIONS = [*basic.MOTION.functions, respond, *EXPRESSIONS.functions]
LOADS = {"a": "float", "b": "float", "p": "vec3", "v": "vec3", "flag": "bool", "id": "id", "cell": "word", "age": "float"}
NOW = 3.5


def arrays_for(program: Program, count: int, precision: int, seed: int = 0) -> dict[str, tuple[np.ndarray, ...]]:
    """Return arrays of whole blocks for what a program loads and stores; those that it only stores hold 7."""
    draw = np.random.default_rng(seed)
    room = (count + BLOCK - 1) // BLOCK * BLOCK
    made: dict[str, tuple[np.ndarray, ...]] = {}
    for name, column in (program.stores | program.loads).items():
        if name == "age":
            made[name] = (draw.uniform(0, 3, room),)
        elif column.type == "bool":
            made[name] = (draw.integers(0, 2, room).astype(np.uint8),)
        elif column.type == "id":
            made[name] = (draw.integers(0, 2**64, room, dtype=np.uint64),)
        elif column.type == "word":
            made[name] = (draw.integers(0, 2**31, room).astype(np.int32),)
        else:
            parts = range(3 if column.type == "vec3" else 1)
            made[name] = tuple(
                (draw.normal(0, 2, room) if name in program.loads else np.full(room, 7.0)).astype(KINDS[precision]) for _ in parts
            )
    return made


@dataclass
class Setting:
    """How a program is run."""

    count: int
    precision: int
    listed: np.ndarray | None = None
    excluded: np.ndarray | None = None
    uniforms: dict[int, Any] = field(default_factory=dict)
    threads: int = 1
    by_place: tuple[str, ...] = ()


def on_machine(program: Program, arrays: dict[str, Any], setting: Setting) -> np.ndarray:
    """Run in place on the block machine; return the rejected rows."""
    listed, count = setting.listed, setting.count
    bits = bits_of(setting.excluded, count) if setting.excluded is not None else np.zeros(0, np.uint16)
    rows = Rows(count if listed is None else len(listed), NO_ROWS if listed is None else listed, bits)
    apart = {name: arrays[name] for name in setting.by_place}
    return run(assemble(program, setting.precision), rows, arrays, setting.uniforms, apart, NOW, setting.threads)


def in_plain_python(program: Program, arrays: dict[str, Any], setting: Setting) -> np.ndarray:
    """Run in place particle by particle; return the rejected rows."""
    apart = {name: arrays[name] for name in setting.by_place}
    job = Job(setting.count, arrays, setting.listed, setting.excluded, setting.uniforms, apart, NOW)
    return ReferenceExecutor(setting.precision).run(program, job)


def copied(arrays: dict[str, Any]) -> dict[str, Any]:
    """Return arrays that may be written."""
    return {name: tuple(part.copy() for part in parts) for name, parts in arrays.items()}


def differences(first: dict[str, Any], second: dict[str, Any], count: int) -> list[str]:
    """Return where two sets of arrays differ in a bit within `count` rows; any NaN is as good as another."""
    found = []
    for name in first:
        for one, other in zip(first[name], second[name], strict=True):
            one, other = one[:count], other[:count]
            bits = f"u{one.dtype.itemsize}"
            rows = np.flatnonzero((one.view(bits) != other.view(bits)) & ~((one != one) & (other != other)))
            found += [f"{name}[{row}]: {one[row]!r} and {other[row]!r}" for row in rows]
    return found


def same_both_ways(program: Program, setting: Setting, seed: int = 0) -> None:
    """Assert that the machine and plain Python leave the same bits, and reject the same rows."""
    arrays = arrays_for(program, setting.count, setting.precision, seed)
    first, second = copied(arrays), copied(arrays)
    rejected = on_machine(program, first, setting), in_plain_python(program, second, setting)
    found = differences(first, second, setting.count)
    assert not found, f"{len(found)} differ, machine and plain Python: {found[:5]}"
    assert rejected[0].tolist() == rejected[1].tolist(), "different rows were rejected"


class RandomProgram:
    """Writes a program at random: calls, draws, masks, loops in loops.

    What is written under a mask is read only under it, as plans do; under a narrower mask, columns that have
    values already are written over.
    """

    def __init__(self, seed: int, size: int = 25):
        self.draw = np.random.default_rng(seed)
        self.uniforms: dict[int, Any] = {}
        builder = Builder.begin(f"random {seed}")
        known: dict[str, list[Operand]] = {type_: [] for type_ in ("float", "vec3", "bool", "draw", "id", "word")}
        for name, type_ in LOADS.items():
            known[type_].append(builder.load(name, type_))
        for value in (0.0, -0.0, 0.3, float(self.draw.normal())):
            known["float"].append(Uniform(str(value), "float", value))
        given = builder.uniform("given", "float"), builder.uniform("vector", "vec3")
        self.uniforms |= {id(given[0]): float(self.draw.normal()), id(given[1]): tuple(self.draw.normal(size=3))}
        known["float"].append(given[0])
        known["vec3"] += [given[1], Uniform("up", "vec3", (0.0, 1.0, 0.0))]
        known["word"].append(Uniform("0", "word", 0))
        for _ in range(4):
            self._draw_numbers(builder, known)
            self._call(builder, known, fresh=True)
        self._body(builder, known, size, 0)
        for k, operand in enumerate([o for type_ in ("float", "vec3", "bool") for o in known[type_] if isinstance(o, Column)]):
            loaded = operand in builder.program.loads.values() and operand.name != "age"
            builder.store(operand.name if loaded else f"out {k}", operand)
        self.program = builder.program

    def _one(self, known: dict[str, list[Operand]], type_: str) -> Operand:
        return known[type_][int(self.draw.integers(len(known[type_])))]

    def _call(self, builder: Builder, known: dict[str, list[Operand]], fresh: bool, function: Function | None = None) -> Any:
        function = function or FUNCTIONS[int(self.draw.integers(len(FUNCTIONS)))]
        operands = [self._one(known, type_) for type_ in function.arguments]
        into = None
        if not fresh and "bool" not in function.results and self.draw.random() < 0.6:
            columns = [[o for o in known[type_] if isinstance(o, Column) and o.name != "age"] for type_ in function.results]
            into = tuple(options[int(self.draw.integers(len(options)))] for options in columns)
            into = into if len(set(map(id, into))) == len(into) else None
        results = builder.call(function, *operands, into=into)
        for column in results if isinstance(results, tuple) else (results,):
            if into is None:
                known[column.type].append(column)
        return results

    def _draw_numbers(self, builder: Builder, known: dict[str, list[Operand]]) -> None:
        key = int(self.draw.integers(2**32)), int(self.draw.integers(2**32))
        column = builder.draw(key, self._one(known, "id"), self._one(known, "word"), self._one(known, "word"))
        known["draw"].append(column)
        self._call(builder, known, True, random_number)

    def _body(self, builder: Builder, known: dict[str, list[Operand]], size: int, depth: int) -> None:
        for _ in range(size):
            kind = self.draw.random()
            if kind < 0.75 or depth > 2:
                self._call(builder, known, fresh=False)
            elif kind < 0.8:
                self._draw_numbers(builder, known)
            elif kind < 0.9:
                narrower = builder.call(basic.both, builder.mask, self._one(known, "bool"))
                self._body(builder.under(narrower), {type_: list(names) for type_, names in known.items()}, size // 4, depth + 1)
            else:
                self._loop(builder, known, size, depth)

    def _loop(self, builder: Builder, known: dict[str, list[Operand]], size: int, depth: int) -> None:
        counter = builder.call(basic.copy_number, Uniform("0", "float", 0.0), name="counter")
        end = builder.call(basic.sum_of_numbers, self._one(known, "float"), Uniform("1.5", "float", 1.5), name="end")
        going = builder.call(basic.is_less, counter, end, name="going")
        inner = builder.loop(going, int(self.draw.integers(1, 5)))
        self._body(inner, {type_: list(names) for type_, names in known.items()}, size // 4, depth + 1)
        inner.call(basic.sum_of_numbers, counter, Uniform("1", "float", 1.0), into=counter)
        inner.call(basic.is_less, counter, end, into=going)
