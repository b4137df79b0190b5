"""What every program must keep to, so that a lane's result depends on nothing but the lane."""

from __future__ import annotations

from typing import Any

import pytest

from graphfx.plan.make import make_plan
from graphfx.program import Call, Draw, Loop, Program, Uniform

from .test_leaving_out import GRAVITY, RAND, SETS, SPIRAL, VORTEX, plan

SURFACES = [
    {"type": "bounce_plane"},
    {"type": "bounce_sphere", "resilience": RAND},
    {"type": "bounce_plane", "id": "two", "normal": [1, 1, 0]},
]
STACKS = {
    "none": [],
    "linear": [GRAVITY, SPIRAL, {"type": "damp", "damping": RAND}],
    "flows": [VORTEX, VORTEX | {"id": "b", "during": [0, 0.4]}, GRAVITY],
    "surfaces": [GRAVITY, *SURFACES],
    "all": [
        GRAVITY,
        SPIRAL,
        VORTEX | {"magnitude": {"expr": "age * position.x"}},
        VORTEX | {"id": "b", "only": {"expr": "radius > 0.5"}},
        *SURFACES,
    ],
}


def programs(stack: str, method: str, substeps: int, shutter: float, prune: bool) -> list[Program]:
    """Return all programs of a stack's plan."""
    emit = {"set": {**SETS, "radius": RAND}, "life": RAND}
    made = plan(STACKS[stack], emit, {"shutter": shutter}, method=method, substeps=substeps)
    return make_plan(made.flat, prune=prune).emitters["sky"].programs


def operands_read(instruction: Any) -> list[Any]:
    """Return what an instruction reads, its mask first."""
    if isinstance(instruction, Call):
        return [instruction.mask, *instruction.operands]
    if isinstance(instruction, Draw):
        return [instruction.mask, instruction.identity, instruction.life, instruction.cell]
    return [instruction.mask]


def results_of(instruction: Any) -> list[Any]:
    """Return the columns that an instruction writes."""
    return (
        list(instruction.results)
        if isinstance(instruction, Call)
        else [instruction.result]
        if isinstance(instruction, Draw)
        else []
    )


CASES = [
    (stack, method, substeps, shutter, prune)
    for stack in STACKS
    for method in ("strang", "adaptive", "sims")
    for substeps, shutter, prune in ((1, 0.5, True), (3, 0.0, True), (2, 1.0, False))
]


@pytest.mark.parametrize("stack, method, substeps, shutter, prune", CASES)
def test_nothing_is_read_before_it_is_written(stack, method, substeps, shutter, prune):
    """Every operand is loaded, given, or the result of an instruction above; what is stored is too."""
    for program in programs(stack, method, substeps, shutter, prune):
        known = {id(program.context), *map(id, program.loads.values())}
        for instruction in program.walk():
            for operand in operands_read(instruction):
                assert isinstance(operand, Uniform) or id(operand) in known, f"{operand} in {instruction}"
            known.update(map(id, results_of(instruction)))
        assert all(id(column) in known for column in program.stores.values())


@pytest.mark.parametrize("stack, method, substeps, shutter, prune", CASES)
def test_truths_of_a_loop_stay_in_it(stack, method, substeps, shutter, prune):
    """A truth is made false where its mask is off, in turns that other lanes take as well: after the loop only its own
    mask, and truths written for all lanes, still tell what the lane's own turns said."""
    for program in programs(stack, method, substeps, shutter, prune):
        inside: set[int] = set()

        def gather(loop: Loop, context: Any, inside: set[int]) -> None:
            for instruction in loop.body:
                if isinstance(instruction, Loop):
                    gather(instruction, context, inside)
                    inside.discard(id(instruction.mask))
                elif isinstance(instruction, Call) and instruction.mask is not context:
                    inside.update(
                        id(column) for column in instruction.results if column.type == "bool" and column is not loop.mask
                    )

        for instruction in program.body:
            if isinstance(instruction, Loop):
                gather(instruction, program.context, inside)
                inside.discard(id(instruction.mask))
            else:
                assert not any(id(operand) in inside for operand in operands_read(instruction)), str(instruction)
                inside.difference_update(map(id, results_of(instruction)))
        assert not any(id(column) in inside for column in program.stores.values())
