"""Kernels: a scalar function over one block of 256 particles, as vector code.

A kernel has one fixed signature, `kernel(scratch, operands, masks)`. `operands` lists first the
context mask, then for every argument (offset, lane mask), then the results' offsets.
Lane mask -1 reads a column, 0 a value splatted over one vector, so one compiled kernel serves
uniform and per-particle arguments alike. Groups of lanes that the context leaves out are skipped.
Lanes outside the context keep what their columns hold; a truth is false there.
"""

from __future__ import annotations

import linecache
import sys
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any

from numba import types
from numba.core import errors
from numba.core.ccallback import CFunc

from graphfx.lanes import any_lane, operands, register
from graphfx.lanes.cache import CheckedCache, digest_of, engine_digest
from graphfx.lanes.memory import FLOAT_LANES
from graphfx.lanes.tables import read_mesh
from graphfx.lanes.types import Real
from graphfx.machine.inline import inline_body
from graphfx.machine.mistakes import located
from graphfx.program import Function
from graphfx.store.processors import BLOCK

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
        memory = "M" if type_ == "bool" else "S"
        lines.append(f"a{position} = read_{'mask' if type_ == 'bool' else type_}(R, {memory}, C, {place}, l)")
        names.append(f"a{position}")
        place += 2
    return lines, names, place


def _stores(function: Function, place: int) -> list[str]:
    lines = []
    for position, type_ in enumerate(function.results):
        value = "r" if len(function.results) == 1 else f"r[{position}]"
        if type_ == "bool":
            lines.append(f"write_mask(R, M, C, {place}, l, on & {value})")
        else:
            lines.append(f"write_{type_}(R, S, C, {place}, l, on, {value})")
        place += 1
    return lines


def _pass(function: Function, width: int, body: str, first: int) -> tuple[list[str], dict[str, Any]]:
    """Return the lines of one pass over a block, and the names in them; the function's operands begin at `first`."""
    loads, names, place = _loads(function, first)
    stores = _stores(function, place)
    truths = [line.partition(" & ")[0] + ")" for line in stores if line.startswith("write_mask")]
    inlined = inline_body(function.body, names, body)
    result, scope = inlined or (f"{body}({', '.join(names)})", {body: function.body})
    lines = [f"for l in range(0, {BLOCK}, {width}):", "    on = read_mask(R, M, C, 0, l)",
             "    if on:" if width == 1 else "    if any_lane(on):",
             *(f"        {line}" for line in (*loads, f"r = {result}", *stores))]
    if truths:
        lines += ["    else:", *(f"        {line}" for line in truths)]
    return lines, scope


def kernel_source(function: Function, width: int) -> tuple[str, dict[str, Any]]:
    """Return the Python source of a function's kernel, or of its bundle's, and the functions that it names.

    A bundle's kernel is told the function's number by its second operand.
    """
    lines: list[str] = ["def kernel(S, C, M):"]
    scope: dict[str, Any] = {}
    if function.bundle is None:
        inner, scope = _pass(function, width, "body", 1)
        lines += [f"    {line}" for line in inner]
    else:
        lines.append("    number = read_number(C, 1)")
        for member in function.bundle.functions:
            lines.append(f"    {'elif' if member.number else 'if'} number == {member.number}:  # {member.name}")
            inner, named = _pass(member, width, f"body{member.number}", 2)
            lines += [f"        {line}" for line in inner]
            scope |= named
    return "\n".join(lines) + "\n", scope


def _memory(real: Real) -> dict[str, Any]:
    names = [name for name in vars(operands) if name.startswith(("read_", "write_"))]
    own = {"R": real, "any_lane": any_lane, "uniform_of": operands.uniform_of, "read_mesh": read_mesh}
    return {name: getattr(operands, name) for name in names} | own


def compile_source(name: str, source: str, named: dict[str, Any], real: Real, stamp: str) -> Kernel:
    """Compile a kernel's source, or load it from the cache; `named` are the functions that it names."""
    module_name = f"graphfx_kernels.{name}_{real.dtype}_{real.width}"
    module = ModuleType(module_name)
    sys.modules[module_name] = module
    module.__dict__.update(_memory(real), **named)
    file = f"<{module_name}>"
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    exec(compile(source, file, "exec"), module.__dict__)
    pointer = types.CPointer(real.dtype)
    arguments = (pointer, types.CPointer(types.int64), types.CPointer(types.uint16))
    handle: Any = CFunc(module.kernel, (arguments, types.void), locals={}, options={"error_model": "numpy", "nogil": True})
    handle._cache = CheckedCache(f"kernel.{name}", source.encode(), stamp)
    handle.compile()
    return Kernel(int(handle.address), handle, source)


def kernel_of(function: Function, precision: int = 32, width: int = 0) -> Kernel:
    """Return the kernel of a function, or of the bundle it is in; `width` 1 or the machine's own (0)."""
    return _kernel_of(function.bundle.functions[0] if function.bundle else function, precision, width)


@cache
def _kernel_of(function: Function, precision: int, width: int) -> Kernel:
    dtype = DTYPES[precision]
    width = width or (1 if function.branches else FLOAT_LANES[dtype])
    members = function.bundle.functions if function.bundle else [function]
    files = sorted(set().union(*(register(member.body) for member in members)))
    closed = [repr(cell.cell_contents).encode() for member in members for cell in member.body.__closure__ or ()]
    closed += [member.body.__module__.encode() for member in members]
    stamp = digest_of([engine_digest("math", "lanes", "machine").encode(), *(file.read_bytes() for file in files), *closed])
    name = function.bundle.name if function.bundle else function.name
    source, named = kernel_source(function, width)
    try:
        return compile_source(name, source, named, Real(dtype, width), stamp)
    except errors.NumbaError as error:
        raise located(function, error) from error
