"""A program with the times and step values that each run of it must be given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from graphfx.plan.values import StepValues
from graphfx.program import Builder, Operand, Program, Uniform


@dataclass
class FrameProgram:
    """A program with what each run must find: `steps` are the values of each substep, and `times` the uniforms
    that hold times of the frame, by name: "length" and "half" of a step, ("start", k), ("middle", k), ("end", k),
    "opening", "frame start", and ("cell", k, p) with the like for the p-th of `cells` cells of held noise in a step."""

    program: Program
    steps: list[StepValues]
    times: dict[Any, Uniform] = field(default_factory=dict)
    cells: int = 1

    def time(self, builder: Builder, name: Any) -> Uniform:
        """Return the uniform of a time, made when it is first asked for."""
        if name not in self.times:
            shown = name if isinstance(name, str) else " ".join(map(str, name))
            is_word = name == "frame word" or name[0] == "cell"
            self.times[name] = builder.uniform(shown, "word" if is_word else "float")
        return self.times[name]


class LazyClock(dict[str, Operand]):
    """Times by name, each written when it is first asked for."""

    def __init__(self, makers: dict[str, Callable[[], Operand]]):
        super().__init__()
        self.makers = makers

    def __missing__(self, name: str) -> Operand:
        """Write a time."""
        self[name] = self.makers[name]()
        return self[name]

    def __contains__(self, name: object) -> bool:
        """Return whether there is such a time."""
        return name in self.makers
