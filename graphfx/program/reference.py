"""What a program means: plain Python, one particle at a time, on NumPy scalars.

Slow on purpose, and without Numba. The block machine must give the same bits.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from graphfx.math import Vec3
from graphfx.math.random import philox4x32
from graphfx.program.instructions import Call, Column, Draw, Loop, Operand, Program, Uniform

KINDS = {32: np.float32, 64: np.float64}
Values = dict[int, Any]


def lane_value(value: Any, type_: str, kind: Any) -> Any:
    """Return a Python value as the lane value of a type: rounded to the precision, three numbers as a Vec3."""
    if type_ == "bool":
        return np.bool_(value)
    if type_ == "vec3":
        parts = (value.x, value.y, value.z) if isinstance(value, Vec3) else value
        return Vec3(*(kind(part) for part in parts))
    if type_ in ("id", "word"):
        return int(value)
    if type_ == "mesh":
        return value.of(kind)
    if type_ == "draw":
        return tuple(kind(part) for part in value)
    return kind(value)


def uniforms_of_words(words: Any, kind: Any) -> tuple[Any, ...]:
    """Return words as numbers in [0, 1): (bits >> 8) 2^-24 in float32, bits 2^-32 in float64."""
    if kind is np.float32:
        return tuple(np.float32(int(word) >> 8) * np.float32(2.0**-24) for word in words)
    return tuple(np.float64(int(word)) * 2.0**-32 for word in words)


def _read(operand: Operand, values: Values, kind: Any) -> Any:
    if id(operand) not in values and isinstance(operand, Uniform) and operand.value is not None:
        values[id(operand)] = lane_value(operand.value, operand.type, kind)
    return values[id(operand)]


def _write(column: Column, value: Any, values: Values, kind: Any) -> None:
    values[id(column)] = lane_value(value, column.type, kind)


def execute(body: list[Any], values: Values, precision: int = 32) -> None:
    """Run instructions for one particle. `values` maps id(operand) to its value, and takes the results."""
    kind = KINDS[precision]
    for instruction in body:
        if isinstance(instruction, Loop):
            turn = 0
            while turn < instruction.limit and values.get(id(instruction.mask)):
                execute(instruction.body, values, precision)
                turn += 1
        elif not _read(instruction.mask, values, kind):
            if isinstance(instruction, Call):
                values.update((id(column), np.bool_(False)) for column in instruction.results if column.type == "bool")
        elif isinstance(instruction, Draw):
            identity = _read(instruction.identity, values, kind)
            counter = (
                identity & 0xFFFFFFFF,
                identity >> 32,
                _read(instruction.life, values, kind),
                _read(instruction.cell, values, kind),
            )
            _write(instruction.result, uniforms_of_words(philox4x32(counter, instruction.key), kind), values, kind)
        else:
            _call(instruction, values, kind)


def _call(instruction: Call, values: Values, kind: Any) -> None:
    result = instruction.function.body(*(_read(operand, values, kind) for operand in instruction.operands))
    results = result if len(instruction.results) > 1 else (result,)
    for column, value in zip(instruction.results, results, strict=True):
        _write(column, value, values, kind)


def run_particle(program: Program, loaded: Mapping[str, Any], uniforms: Mapping[int, Any], precision: int = 32) -> Values:
    """Run a whole program for one particle whose context is on; return all values by id(operand)."""
    kind = KINDS[precision]
    values: Values = {id(program.context): np.bool_(True)}
    for name, column in program.loads.items():
        values[id(column)] = lane_value(loaded[name], column.type, kind)
    types = {id(uniform): uniform.type for uniform in program.uniforms}
    for key, value in uniforms.items():
        values[key] = lane_value(value, types.get(key, "float"), kind)
    with np.errstate(all="ignore"):
        execute(program.body, values, precision)
    return values
