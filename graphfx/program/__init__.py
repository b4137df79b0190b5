"""Programs of vector instructions: the language between the plan and the machine."""

from graphfx.program.instructions import (
    COMPONENTS,
    Builder,
    Bundle,
    Call,
    Column,
    Draw,
    Function,
    Instruction,
    Loop,
    Operand,
    Program,
    Uniform,
    constant_number,
    function,
)

__all__ = [
    "COMPONENTS",
    "Builder",
    "Bundle",
    "Call",
    "Column",
    "Draw",
    "Function",
    "Instruction",
    "Loop",
    "Operand",
    "Program",
    "Uniform",
    "constant_number",
    "function",
]
