"""Assemble a program: give every operand a place in the scratch, and write the code of the loop."""

from __future__ import annotations

from dataclasses import dataclass, field
from heapq import heappop, heappush
from typing import Any

import numpy as np

from graphfx.lanes.memory import FLOAT_LANES
from graphfx.machine.draw import draw_kernel
from graphfx.machine.kernels import DTYPES, kernel_of
from graphfx.machine.loop import CALL, DEPTH, LOOP
from graphfx.machine.transfer import BLOCK
from graphfx.program import COMPONENTS, Draw, Loop, Operand, Program, Uniform
from graphfx.program.spans import Span, spans_of

CALL_HEADER = 3


@dataclass
class Assembled:
    """A program ready to run: `template` is the scratch with all constants in place."""

    program: Program
    precision: int
    code: np.ndarray
    template: np.ndarray
    masks: np.ndarray
    places: dict[int, int]
    vectors: list[Uniform] = field(default_factory=list)

    @property
    def lanes(self) -> int:
        """Return the number of lanes over which a uniform is splatted."""
        return FLOAT_LANES[DTYPES[self.precision]]

    def place(self, operand: Operand) -> int:
        """Return the first element of an operand in the scratch, or the first lane of a mask."""
        return self.places[id(operand)]

    def set_uniform(self, scratch: np.ndarray, masks: np.ndarray, uniform: Uniform, value: Any) -> None:
        """Splat a value: a number, three for a vec3, a truth for a mask, an integer for a word, an address for a mesh."""
        place = self.place(uniform)
        if uniform.type == "bool":
            masks[place >> 4 : (place + BLOCK) >> 4] = 0xFFFF if value else 0
        elif uniform.type in ("word", "id", "mesh"):
            value = value.address(self.precision) if uniform.type == "mesh" else value
            words = scratch.view(np.uint32 if self.precision == 32 else np.uint64)
            for k in range(COMPONENTS[uniform.type]):
                words[place + k * self.lanes : place + (k + 1) * self.lanes] = int(value) >> (32 * k) & 0xFFFFFFFF
        else:
            values = value if COMPONENTS[uniform.type] > 1 else (value,)
            for k, number in enumerate(values):
                scratch[place + k * self.lanes : place + (k + 1) * self.lanes] = number


class _Places:
    """Hands out places, and takes back those of columns that are read no more."""

    def __init__(self, start: int, unit: int):
        self.top = start
        self.unit = unit
        self.free: dict[int, list[int]] = {}

    def take(self, count: int) -> int:
        waiting = self.free.get(count)
        if waiting:
            return waiting.pop()
        place = self.top
        self.top += count * self.unit
        return place

    def give(self, place: int, count: int) -> None:
        self.free.setdefault(count, []).append(place)


def assemble(program: Program, precision: int = 32) -> Assembled:
    """Give places and write code; kernels that were never compiled are compiled here."""
    lanes = FLOAT_LANES[DTYPES[precision]]
    spans = spans_of(program)
    uniforms = [span.operand for span in spans.values() if isinstance(span.operand, Uniform)]
    places: dict[int, int] = {}
    splats, mask_lanes = _Places(0, lanes), _Places(BLOCK, BLOCK)
    same: dict[Any, int] = {}
    for uniform in uniforms:
        key = (uniform.type, repr(uniform.value)) if uniform.value is not None else id(uniform)  # 0.0 == -0.0
        if key not in same:
            target = mask_lanes if uniform.type == "bool" else splats
            same[key] = target.take(max(COMPONENTS[uniform.type], 1))
        places[id(uniform)] = same[key]
    columns = _Places((splats.top + 15) // 16 * 16, BLOCK)
    places[id(program.context)] = 0
    _place_columns(spans, places, columns, mask_lanes, program)
    dtype = np.float32 if precision == 32 else np.float64
    code = np.array(_encode(program.body, places, precision) or [], np.int64)
    made = Assembled(program, precision, code, np.zeros(columns.top, dtype), np.zeros(mask_lanes.top // 16, np.uint16), places)
    for uniform in uniforms:
        if uniform.value is not None:
            made.set_uniform(made.template, made.masks, uniform, uniform.value)
        else:
            made.vectors.append(uniform)
    return made


def _place_columns(
    spans: dict[int, Span], places: dict[int, int], columns: _Places, masks: _Places, program: Program
) -> None:
    """Give places in the order of first needs; one that is needed no more is the next one's of its size."""
    waiting = sorted(
        (span.first, order, key)
        for order, (key, span) in enumerate(spans.items())
        if not isinstance(span.operand, Uniform) and span.operand is not program.context
    )
    busy: list[tuple[int, int, int]] = []
    for first, order, key in waiting:
        while busy and busy[0][0] < first:
            operand = spans[(ended := heappop(busy))[2]].operand
            (masks if operand.type == "bool" else columns).give(places[ended[2]], max(COMPONENTS[operand.type], 1))
        operand = spans[key].operand
        places[key] = (masks if operand.type == "bool" else columns).take(max(COMPONENTS[operand.type], 1))
        heappush(busy, (spans[key].last, order, key))


def _read(operand: Operand, places: dict[int, int]) -> list[int]:
    uniform = isinstance(operand, Uniform) and operand.type != "bool"
    return [places[id(operand)], 0 if uniform else -1]


def _encode(body: list[Any], places: dict[int, int], precision: int, depth: int = 0) -> list[int]:
    if depth > DEPTH:
        raise ValueError(f"loops are nested {depth} deep; the machine holds {DEPTH}")
    code: list[int] = []
    for instruction in body:
        if isinstance(instruction, Loop):
            inner = _encode(instruction.body, places, precision, depth + 1)
            code += [LOOP, len(inner) + 4, places[id(instruction.mask)], instruction.limit, *inner]
            continue
        operands = [places[id(instruction.mask)]]
        if isinstance(instruction, Draw):
            address = draw_kernel(precision).address
            for operand in (instruction.identity, instruction.life, instruction.cell):
                operands += _read(operand, places)
            operands += [places[id(instruction.result)], *instruction.key]
        else:
            address = kernel_of(instruction.function, precision).address
            if instruction.function.bundle:
                operands.append(instruction.function.number)
            for operand in instruction.operands:
                operands += _read(operand, places)
            operands += [places[id(column)] for column in instruction.results]
        code += [CALL, len(operands) + CALL_HEADER, address, *operands]
    return code
