"""Run one node's function on the block machine and in plain Python."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.contract.inputs import Row
from graphfx.cook.executor import BlockExecutor, Executor, Job, ReferenceExecutor
from graphfx.geometry.shapes import box
from graphfx.geometry.tables import MeshTables
from graphfx.math import Vec3
from graphfx.node import NodeType
from graphfx.plan.values import node_function
from graphfx.program import Builder, Column, Operand, Program, Uniform

BLOCK = 256
KINDS: dict[int, Any] = {32: np.float32, 64: np.float64}
KEY = (0x6A09E667, 0xBB67AE85)
"""Of the random numbers that a function is handed."""
MESH = MeshTables(box((2.0, 1.0, 3.0)), searched=True)
"""What a function is handed for a mesh."""
Columns = dict[str, tuple[np.ndarray, ...]]


class BothWays:
    """One function as a program of one instruction, with a column for every argument."""

    def __init__(self, node_type: NodeType):
        self.node_type = node_type
        self.function = node_function(node_type)
        self.program = self._program()

    def _program(self) -> Program:
        builder = Builder.begin(self.node_type.name)
        self.meshes: dict[int, MeshTables] = {}
        operands = [self._operand(builder, name, kind)
                    for name, kind in zip(self.node_type.arguments, self.function.arguments, strict=True)]
        results = builder.call(self.function, *operands)
        for k, column in enumerate(results if isinstance(results, tuple) else (results,)):
            builder.store(f"result {k}", column)
        return builder.program

    def _operand(self, builder: Builder, name: str, kind: str) -> Operand:
        if kind == "mesh":
            uniform = builder.uniform(name, kind)
            self.meshes[id(uniform)] = MESH
            return uniform
        if kind == "draw":
            nought = Uniform("0", "word", 0)
            drawn: Column = builder.draw(KEY, builder.load("given identity", "id"), nought, nought)
            return drawn
        return builder.load("given identity" if kind == "id" else f"given {name}", kind)

    def columns(self, rows: list[Row], precision: int) -> Columns:
        """Return the arrays for some rows, whole blocks long."""
        room = -(-len(rows) // BLOCK) * BLOCK
        made: Columns = {}
        for name, column in (self.program.loads | self.program.stores).items():
            argument = name.removeprefix("given ")
            given = [row[argument] for row in rows] if argument in rows[0] else []
            made[name] = _arrays(column.type, given, room, KINDS[precision])
        return made

    def run(self, rows: list[Row], precision: int, on_machine: bool, order: np.ndarray | None = None) -> Columns:
        """Return the results for some rows, in their order; they run in another, where `order` lists them."""
        arrays = self.columns(rows, precision)
        executor: Executor = BlockExecutor(precision) if on_machine else ReferenceExecutor(precision)
        executor.run(self.program, Job(len(rows), arrays, order, uniforms=self.meshes))
        return {name: tuple(part[: len(rows)] for part in arrays[name]) for name in self.program.stores}


def _arrays(kind: str, given: list[Any], room: int, dtype: Any) -> tuple[np.ndarray, ...]:
    if kind == "id":
        return (np.arange(room, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15),)
    if kind == "bool":
        return (_filled(given, room, np.uint8),)
    if kind == "vec3":
        return tuple(_filled([vector[k] for vector in given], room, dtype) for k in range(3))
    return (_filled(given, room, dtype),)


def _filled(given: list[Any], room: int, dtype: Any) -> np.ndarray:
    filled = np.zeros(room, dtype)
    filled[: len(given)] = given
    return filled


def same_bits(one: Columns, other: Columns) -> np.ndarray:
    """Return, for each row, whether two sets of results agree to the last bit; any NaN is as good as another."""
    same = np.ones(len(next(iter(one.values()))[0]), bool)
    for name in one:
        for first, second in zip(one[name], other[name], strict=True):
            bits = f"u{first.dtype.itemsize}"
            same &= (first.view(bits) == second.view(bits)) | ((first != first) & (second != second))
    return same


def finite(results: Columns) -> np.ndarray:
    """Return, for each row, whether all results are finite."""
    return np.all([np.isfinite(part) for parts in results.values() for part in parts], axis=0)


def plainly(node_type: NodeType, row: Row, real: Any = np.float64, **changed: Any) -> tuple[np.ndarray, ...]:
    """Return what a node's function gives in plain Python, each result as an array; `real` is the type of its numbers."""
    given = {**row, **changed}
    types = {name: node_type.argument_type(name) for name in node_type.arguments}
    arguments = [MESH.of(real) if kind == "mesh" else _scalar(kind, given.get(name, 0), real) for name, kind in types.items()]
    with np.errstate(all="ignore"):
        results = node_type.function(*arguments)
    several = results if isinstance(results, tuple) else (results,)
    return tuple(np.array([*result], float) if isinstance(result, Vec3) else np.array([result], float) for result in several)


def _scalar(kind: str, value: Any, real: Any) -> Any:
    if kind == "bool":
        return np.bool_(value)
    if kind == "draw":
        return tuple(real(part) for part in value)
    if kind == "id":
        return int(value)
    return Vec3(*(real(part) for part in value)) if np.size(value) == 3 else real(value)
