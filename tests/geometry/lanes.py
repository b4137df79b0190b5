"""Run functions of meshes over many particles on the machine, and in plain Python."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphfx.geometry.tables import MeshTables
from graphfx.machine.assemble import assemble
from graphfx.machine.run import Rows, run
from graphfx.math import Vec3
from graphfx.program import Builder, Function
from graphfx.store.processors import BLOCK

KINDS: dict[int, Any] = {32: np.float32, 64: np.float64}
PRECISIONS = (32, 64)


def function_of(node: Any) -> Function:
    """Return a node as an instruction."""
    from graphfx.plan.values import node_function

    return node_function(node)


def _padded(part: np.ndarray) -> np.ndarray:
    padded = np.zeros((len(part) + BLOCK - 1) // BLOCK * BLOCK, part.dtype)
    padded[: len(part)] = part
    return padded


def on_lanes(function: Function, given: list[Any], precision: int) -> list[np.ndarray]:
    """Return a function's results, a row a particle. `given` holds arrays, of ids as uint64, and meshes."""
    kind = KINDS[precision]
    builder = Builder.begin("one call")
    operands, arrays, meshes = [], {}, {}
    for k, (value, type_) in enumerate(zip(given, function.arguments, strict=True)):
        if isinstance(value, MeshTables):
            operands.append(builder.uniform("mesh", "mesh"))
            meshes[id(operands[-1])] = value
            continue
        operands.append(builder.load(f"given {k}", type_))
        parts = [value] if type_ in ("id", "float") else list(value.T)
        arrays[f"given {k}"] = tuple(_padded(part if type_ == "id" else part.astype(kind)) for part in parts)
    count = next(len(value) for value in given if isinstance(value, np.ndarray))
    results = builder.call(function, *operands)
    made = results if isinstance(results, tuple) else (results,)
    for k, column in enumerate(made):
        builder.store(f"made {k}", column)
        size = 3 if column.type == "vec3" else 1
        arrays[f"made {k}"] = tuple(_padded(np.zeros(count, np.uint8 if column.type == "bool" else kind)) for _ in range(size))
    run(assemble(builder.program, precision), Rows(count), arrays, meshes)
    return [np.stack([part[:count] for part in arrays[f"made {k}"]], axis=1) for k in range(len(made))]


def in_plain_python(function: Function, given: list[Any], precision: int) -> list[np.ndarray]:
    """Return the same, one particle at a time."""
    kind = KINDS[precision]
    count = next(len(value) for value in given if isinstance(value, np.ndarray))
    rows: list[list[Any]] = [[] for _ in function.results]
    with np.errstate(all="ignore"):
        for k in range(count):
            pairs = zip(given, function.arguments, strict=True)
            results = function.body(*(_plain(value, k, type_, kind) for value, type_ in pairs))
            for row, result, type_ in zip(rows, results if len(rows) > 1 else (results,), function.results, strict=True):
                row.append([result.x, result.y, result.z] if type_ == "vec3" else [result])
    return [np.array(row, np.uint8 if type_ == "bool" else kind) for row, type_ in zip(rows, function.results, strict=True)]


def _plain(value: Any, k: int, type_: str, kind: Any) -> Any:
    if isinstance(value, MeshTables):
        return value.of(kind)
    if type_ == "id":
        return int(value[k])
    if type_ == "draw":
        return tuple(map(kind, value[k]))
    return Vec3(*map(kind, value[k])) if type_ == "vec3" else kind(value[k])


def same_bits(function: Function, given: list[Any], precision: int) -> bool:
    """Return whether machine and plain Python give the same."""
    pairs = zip(on_lanes(function, given, precision), in_plain_python(function, given, precision), strict=True)
    return all(a.tobytes() == b.tobytes() for a, b in pairs)


def random_draws(count: int, seed: int = 0) -> np.ndarray:
    """Return four uniform numbers for each particle, of the 24 bits that both precisions have."""
    return np.random.default_rng(seed).integers(0, 1 << 24, (count, 4)) * 2.0**-24
