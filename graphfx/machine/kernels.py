"""Kernels: a scalar function over one block of 256 particles, as vector code.

A kernel has one fixed signature, `kernel(scratch, operands, masks)`. `operands` lists first the
context mask, then for every component of every argument (offset, lane mask), then the results.
Lane mask -1 reads a column, 0 a value splatted over one vector, so one compiled kernel serves
uniform and per-particle arguments alike. Groups of lanes that the context leaves out are skipped.
Lanes outside the context keep what their columns hold; a truth is false there.
"""

from __future__ import annotations

import linecache
import re
import sys
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any

from numba import carray, types
from numba.core import errors
from numba.core.ccallback import CFunc

from graphfx.errors import Location, NodeError, Problem
from graphfx.lanes import register
from graphfx.lanes.arithmetic import BRANCH, LaneBranchError
from graphfx.lanes.cache import CheckedCache, digest_of, engine_digest
from graphfx.lanes.memory import FLOAT_LANES
from graphfx.lanes.types import Real
from graphfx.program import Function

BLOCK = 256
"""Particles in a block."""

DTYPES = {32: types.float32, 64: types.float64}


@dataclass(frozen=True)
class Kernel:
    """Compiled code for one function: its address, and Numba's handle, which keeps it alive."""

    address: int
    handle: Any
    source: str

    @property
    def assembly(self) -> str:
        """Return the machine code as text."""
        return self.handle._library.get_asm_str()


def _loads(function: Function, place: int) -> tuple[list[str], list[str], int]:
    lines, names = [], []
    for position, type_ in enumerate(function.arguments):
        name = f"a{position}"
        if type_ == "bool":
            lines.append(f"{name} = mask_at(R, M, C[{place}] + (l & C[{place + 1}]))")
            place += 2
        else:
            count = {"float": 1, "vec3": 3, "draw": 4}[type_]
            parts = [f"load_at(R, S, C[{place + 2 * k}] + (l & C[{place + 2 * k + 1}]))" for k in range(count)]
            place += 2 * count
            made = {"float": parts[0], "vec3": f"Vec3({', '.join(parts)})", "draw": f"({', '.join(parts)})"}[type_]
            lines.append(f"{name} = {made}")
        names.append(name)
    return lines, names, place


def _stores(function: Function, place: int) -> list[str]:
    lines = []
    for position, type_ in enumerate(function.results):
        value = "r" if len(function.results) == 1 else f"r[{position}]"
        if type_ == "bool":
            lines.append(f"store_mask_at(R, M, C[{place}] + l, on & {value})")
            place += 1
        else:
            parts = [value] if type_ == "float" else [f"{value}.{name}" for name in "xyz"]
            for part in parts:
                lines.append(f"store_at(R, S, C[{place}] + l, on, {part})")
                place += 1
    return lines


def _pass(function: Function, width: int, body: str, first: int) -> list[str]:
    """Return the lines of one pass over a block: operands of the function begin at `first`."""
    loads, names, place = _loads(function, first)
    stores = _stores(function, place)
    truths = [line.partition(" & ")[0] + ")" for line in stores if line.startswith("store_mask_at")]
    lines = [f"for l in range(0, {BLOCK}, {width}):", "    on = mask_at(R, M, C[0] + l)",
             "    if on:" if width == 1 else "    if any_lane(on):",
             *(f"        {line}" for line in (*loads, f"r = {body}({', '.join(names)})", *stores))]
    if truths:
        lines += ["    else:", *(f"        {line}" for line in truths)]
    return lines


def kernel_source(function: Function, width: int) -> str:
    """Return the Python source of a function's kernel, or of its bundle's: that one is told the number first."""
    lines = ["def kernel(S, operands, M):", "    C = carray(operands, (64,))"]
    if function.bundle is None:
        lines += [f"    {line}" for line in _pass(function, width, "body0", 1)]
    else:
        for member in function.bundle.functions:
            lines.append(f"    {'elif' if member.number else 'if'} C[1] == {member.number}:  # {member.name}")
            lines += [f"        {line}" for line in _pass(member, width, f"body{member.number}", 2)]
    return "\n".join(lines) + "\n"


def _scope(real: Real) -> dict[str, Any]:
    from graphfx.lanes import any_lane, memory
    from graphfx.math import Vec3

    scope = {name: getattr(memory, name) for name in
             ("load_at", "store_at", "mask_at", "store_mask_at", "word_at", "uniform_of")}
    return scope | {"R": real, "Vec3": Vec3, "carray": carray, "any_lane": any_lane}


def compile_source(name: str, source: str, bodies: list[Any], real: Real, stamp: str) -> Kernel:
    """Compile a kernel's source, or load it from the cache; `bodies` are its `body0`, `body1`, ..."""
    module_name = f"graphfx_kernels.{name}_{real.dtype}_{real.width}"
    module = ModuleType(module_name)
    sys.modules[module_name] = module
    module.__dict__.update(_scope(real), **{f"body{k}": body for k, body in enumerate(bodies)})
    file = f"<{module_name}>"
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    exec(compile(source, file, "exec"), module.__dict__)
    pointer = types.CPointer(real.dtype)
    arguments = (pointer, types.CPointer(types.int64), types.CPointer(types.uint16))
    handle = CFunc(module.kernel, (arguments, types.void), locals={}, options={"error_model": "numpy", "nogil": True})
    handle._cache = CheckedCache(f"kernel.{name}", source.encode(), stamp)
    handle.compile()
    return Kernel(handle.address, handle, source)


def kernel_of(function: Function, precision: int = 32, width: int = 0) -> Kernel:
    """Return the kernel of a function, or of the bundle it is in; `width` 1 or the machine's own (0)."""
    return _kernel_of(function.bundle.functions[0] if function.bundle else function, precision, width)


@cache
def _kernel_of(function: Function, precision: int, width: int) -> Kernel:
    dtype = DTYPES[precision]
    width = width or (1 if function.branches else FLOAT_LANES[dtype])
    members = function.bundle.functions if function.bundle else [function]
    files = sorted(set().union(*(register(member.body) for member in members)))
    stamp = digest_of([engine_digest("math", "lanes", "machine").encode(), *(file.read_bytes() for file in files)])
    name = function.bundle.name if function.bundle else function.name
    try:
        return compile_source(name, kernel_source(function, width), [member.body for member in members], Real(dtype, width), stamp)
    except errors.NumbaError as error:
        raise _located(function, error) from error


def _located(function: Function, error: Exception) -> NodeError:
    """Say what Numba found wrong at the author's own file and line."""
    text = str(error)
    source = function.body.__code__.co_filename
    lines = [int(line) for file, line in re.findall(r"at (\S+) \((\d+)\)", text) if file == source]
    lines += [int(line) for file, line in re.findall(r'File "([^"]+)", line (\d+)', text) if file == source]
    line = lines[0] if lines else function.body.__code__.co_firstlineno
    if BRANCH in text or isinstance(error, LaneBranchError):
        message = BRANCH
    else:
        found = re.findall(r"No implementation of function (.*?) found for signature:\s+>>> (.*)", text)
        message = f"no lane code for {found[-1][1].strip()}" if found else text.strip().splitlines()[-1]
    return NodeError(Problem(message, Location(source, line), function.name))
