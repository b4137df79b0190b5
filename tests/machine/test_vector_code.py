"""Kernels are vector code: packed arithmetic on whole registers, no lane by itself, no calls.

What an optimiser makes of code can change without a word; so the machine code itself is read. It is compiled
anew for that, since code out of the cache cannot be shown.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import llvmlite.binding
import pytest

from graphfx.cook.effect import load
from graphfx.machine.draw import draw_kernel
from graphfx.machine.kernels import _kernel_of
from graphfx.motion import spring
from graphfx.node import Library, library_roots
from graphfx.plan.make import make_plan
from graphfx.plan.values import node_function
from graphfx.program import Call, Draw, Function

ROOT = Path(__file__).resolve().parents[2]
GRAPHS = {"snow": ROOT / "tests/snow.json", "ten operators": ROOT / "tests/benchmarks/ten_operators.json"}
LIBRARY = Library(library_roots())
OPERATORS = [name for name in LIBRARY if LIBRARY.kind_of(name) == "operators" and not LIBRARY[name].language]
FEATURES = llvmlite.binding.get_host_cpu_features()
ARITHMETIC = r"v(?:add|sub|mul|div|sqrt|max|min|cmp\w*|blendm?|blendv|rndscale|round|fn?m(?:add|sub)\d+|cvt\w+|xor|and|mova|movu)"
PACKED = re.compile(rf"\s{ARITHMETIC}p[sd]\s.*%[yz]mm")
SCALAR = re.compile(r"\sv?(?:add|sub|mul|div|sqrt|max|min|u?comi|rndscale|round|fn?m(?:add|sub)\d+)s[sd]\s.*")
SYMBOL = re.compile(r"(?:movabsq\s+\$|call\w*\s+)([A-Za-z_]\w*)")

pytestmark = pytest.mark.skipif(not (FEATURES.get("avx2") and FEATURES.get("fma")), reason="a processor without AVX2 and FMA")


def instructions_of(graph: str) -> list[Call | Draw]:
    """Return one instruction of each function in a graph's programs."""
    found: dict[str, Call | Draw] = {}
    for emitter in make_plan(load(GRAPHS[graph]).flat).emitters.values():
        for program in emitter.programs:
            for step in program.walk():
                if isinstance(step, (Call, Draw)):
                    found.setdefault(step.function.name if isinstance(step, Call) else "draw", step)
    return list(found.values())


def code_of(instruction: Call | Draw, precision: int) -> str:
    """Return the machine code of an instruction's kernel; one that shares a bundle's kernel is compiled alone."""
    if isinstance(instruction, Draw):
        return draw_kernel.__wrapped__(precision).assembly
    return _kernel_of.__wrapped__(replace(instruction.function, bundle=None), precision, 0).assembly


def faults(name: str, types: set[str], code: str) -> list[str]:
    """Return what is wrong with a kernel's code."""
    found = [f"{name}: {line.strip()}" for line in SCALAR.findall(code)]
    found += [f"{name}: calls {symbol}" for symbol in SYMBOL.findall(code) if "graphfx_kernels" not in symbol]
    if types != {"bool"} and not PACKED.search(code):
        found.append(f"{name}: nothing packed in it")
    return found


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("graph", GRAPHS)
def test_every_kernel_is_vector_code(graph, precision, tmp_path, monkeypatch):
    """Every kernel of these graphs computes on whole registers, holds no scalar arithmetic and calls no function."""
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path))
    found = []
    for instruction in instructions_of(graph):
        called = isinstance(instruction, Call)
        name = instruction.function.name if called else "draw"
        types = {*instruction.function.arguments, *instruction.function.results} if called else {"draw"}
        found += faults(name, types, code_of(instruction, precision))
    assert not found


@pytest.mark.parametrize("name", OPERATORS)
def test_every_operator_is_vector_code(name, tmp_path, monkeypatch):
    """The kernel of every operator of the library is vector code, but for those that declare branches.

    What is one number for all of a mesh, such as that of its last vertex, may be found once by scalar code.
    """
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path))
    node_type = LIBRARY[name]
    if node_type.branches:
        pytest.skip("it goes lane by lane, and says so")
    function = node_function(node_type)
    code = _kernel_of.__wrapped__(function, 32, 0).assembly
    found = faults(name, {*function.arguments, *function.results}, code)
    assert len(found) <= (4 if "mesh" in function.arguments else 0), found


SPRINGS = [f for f in vars(spring).values() if isinstance(f, Function)]


@pytest.mark.parametrize("function", SPRINGS, ids=lambda function: function.name)
def test_springs_are_vector_code(function, tmp_path, monkeypatch):
    """The kernels that solve springs are vector code."""
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path))
    code = _kernel_of.__wrapped__(function, 32, 0).assembly
    assert not faults(function.name, {*function.arguments, *function.results}, code)


def test_a_kernel_that_goes_lane_by_lane_would_be_seen(tmp_path, monkeypatch):
    """The same vortex compiled lane by lane is found out."""
    monkeypatch.setenv("GRAPHFX_CACHE", str(tmp_path))
    called = (step.function for step in instructions_of("ten operators") if isinstance(step, Call))
    vortex = next(function for function in called if function.name == "vortex")
    assert len(faults("vortex", {"float"}, _kernel_of.__wrapped__(vortex, 32, 1).assembly)) > 10
