"""Run a scalar function over many values on the machine, and in plain Python."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from graphfx.machine.assemble import assemble
from graphfx.machine.run import Rows, run
from graphfx.machine.transfer import BLOCK
from graphfx.math import Vec3
from graphfx.program import Builder, Bundle, Function

KINDS: dict[int, Any] = {32: np.float32, 64: np.float64}
WIDTHS = [(32, 0), (64, 0), (32, 1), (64, 1)]
"""Precision, and lanes: 0 is all of a register, 16 or 8."""


def adversarial(precision: int) -> np.ndarray:
    """Return the values at which arithmetic goes wrong."""
    kind = KINDS[precision]
    about = np.finfo(kind)
    plain = [
        0,
        0.5,
        1,
        1.5,
        2,
        2.5,
        3,
        7.5,
        1 / 3,
        0.1,
        np.pi / 4,
        np.pi / 2,
        np.pi,
        6.2831855,
        10,
        87.3,
        88.72,
        89,
        100,
        103.9,
        127,
        128,
        708.3,
        709.78,
        710,
        745,
        1e3,
        1e5,
        1e10,
        2.0**23 - 0.5,
        2.0**24,
        2.0**52 + 0.5,
        1e-10,
        1e-20,
        1e30,
    ]
    edges = [about.tiny, about.max, about.eps, about.smallest_subnormal, about.tiny / 3, 1 - about.epsneg, 1 + about.eps, np.inf]
    values = np.array([*plain, *(float(edge) for edge in edges)], kind)
    return np.concatenate([values, -values, np.array([np.nan], kind)])


def scattered(precision: int, count: int, seed: int) -> np.ndarray:
    """Return random values of all sizes: half of them of any exponent, half within a few units of 0."""
    draw = np.random.default_rng(seed)
    bits = draw.integers(0, 2**precision, count // 2, dtype=np.uint64).astype(f"u{precision // 8}")
    wild = bits.view(KINDS[precision])
    return np.concatenate([np.where(np.isnan(wild), 1.0, wild), draw.normal(0, 4, count - count // 2)]).astype(KINDS[precision])


def pairs(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return every pair of the values."""
    first, second = np.meshgrid(values, values)
    return first.ravel(), second.ravel()


@cache
def _lane_by_lane(bundle: Bundle) -> Bundle:
    """Return the same functions in a bundle that is compiled for one lane at a time, as for `branches=True`."""
    narrow = Bundle(f"{bundle.name}_by_lane")
    narrow.functions += [replace(member, branches=True, bundle=narrow) for member in bundle.functions]
    return narrow


def _parts(columns: list[Any], types: tuple[str, ...]) -> list[tuple[np.ndarray, ...]]:
    return [tuple(column) if type_ == "vec3" else (column,) for column, type_ in zip(columns, types, strict=True)]


def on_lanes(function: Function, columns: list[Any], precision: int, width: int = 0) -> list[np.ndarray]:
    """Return the parts of a function's results over columns (a vec3 is three), as the machine finds them."""
    if width == 1:
        assert function.bundle is not None
        function = _lane_by_lane(function.bundle).functions[function.number]
    builder = Builder.begin("one call")
    given = [builder.load(f"given {k}", type_) for k, type_ in enumerate(function.arguments)]
    results = builder.call(function, *given)
    made = results if isinstance(results, tuple) else (results,)
    for k, column in enumerate(made):
        builder.store(f"made {k}", column)
    parts = _parts(columns, function.arguments)
    count = len(parts[0][0])
    room = (count + BLOCK - 1) // BLOCK * BLOCK
    arrays = {f"given {k}": tuple(_padded(part, room, precision) for part in both) for k, both in enumerate(parts)}
    kinds = [np.dtype(np.uint8) if type_ == "bool" else np.dtype(KINDS[precision]) for type_ in function.results]
    arrays |= {
        f"made {k}": tuple(np.zeros(room, kind) for _ in range(3 if type_ == "vec3" else 1))
        for k, (type_, kind) in enumerate(zip(function.results, kinds, strict=True))
    }
    run(assemble(builder.program, precision), Rows(count), arrays)
    return [part[:count] for k in range(len(made)) for part in arrays[f"made {k}"]]


def _padded(part: np.ndarray, room: int, precision: int) -> np.ndarray:
    array = np.zeros(room, np.uint8 if part.dtype == bool else KINDS[precision])
    array[: len(part)] = part
    return array


def in_plain_python(function: Function, columns: list[Any], precision: int) -> list[np.ndarray]:
    """Return the same by calling the function on NumPy scalars, one particle after another."""
    rows = []
    vectors = [
        column if type_ != "vec3" else [Vec3(*parts) for parts in zip(*column, strict=True)]
        for column, type_ in zip(columns, function.arguments, strict=True)
    ]
    with np.errstate(all="ignore"):
        for row in zip(*vectors, strict=True):
            result = function.body(*row)
            values = result if len(function.results) > 1 else (result,)
            rows.append(
                [
                    number
                    for value, type_ in zip(values, function.results, strict=True)
                    for number in ((value,) if type_ != "vec3" else (value.x, value.y, value.z))
                ]
            )
    return [np.array(part, KINDS[precision]) for part in zip(*rows, strict=True)]


def same_bits(got: list[np.ndarray], wanted: list[np.ndarray], columns: list[Any] = ()) -> None:
    """Assert that two results have the same bits; any NaN is as good as another, and all others must match."""
    for mine, other in zip(got, wanted, strict=True):
        mine = mine.astype(other.dtype)
        word = np.uint32 if other.dtype == np.float32 else np.uint64
        wrong = (mine.view(word) != other.view(word)) & ~(np.isnan(mine) & np.isnan(other))
        if wrong.any():
            place = int(np.flatnonzero(wrong)[0])
            flat = [part for column in columns for part in (column if isinstance(column, (tuple, list)) else (column,))]
            raise AssertionError(
                f"{int(wrong.sum())} of {len(wrong)} differ, the first at {[part[place] for part in flat]}: "
                f"{mine[place]!r}, not {other[place]!r}"
            )
