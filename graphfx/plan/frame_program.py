"""A program with the times and step values that each run of it must be given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from graphfx.plan.values import StepValues
from graphfx.program import Builder, Operand, Program, Uniform


@dataclass
class FrameProgram:
    """A program with what each run must find: `steps` are values found once, each with the time of the frame at which
    they are found, and `times` the uniforms that hold times of the frame. Times have names: "length" and "half" of a
    step, ("start", k), ("middle", k), ("end", k), "opening", "frame start", "frame end", and ("cell", k, p) with the
    like for the p-th of `cells` cells of noise in a step."""

    program: Program
    steps: list[tuple[Any, StepValues]] = field(default_factory=list)
    times: dict[Any, Uniform] = field(default_factory=dict)
    cells: int = 1
    matrices: dict[Any, Any] = field(default_factory=dict)
    meshes: dict[tuple[str, int], Uniform] = field(default_factory=dict)
    """Meshes by path and substep, each as it stands in the middle of that; of the whole frame for substep -1."""

    def values_at(self, time: Any) -> StepValues:
        """Return a place for values that are found once, at a time."""
        made = StepValues()
        self.steps.append((time, made))
        return made

    def time(self, builder: Builder, name: Any) -> Uniform:
        """Return the uniform of a time, made when it is first asked for."""
        if name not in self.times:
            shown = name if isinstance(name, str) else " ".join(map(str, name))
            is_word = name == "frame word" or name[0] == "cell"
            self.times[name] = builder.uniform(shown, "word" if is_word else "float")
        return self.times[name]

    def mesh(self, builder: Builder, path: str, k: int = -1) -> Uniform:
        """Return the uniform of a mesh in substep k, made when it is first asked for."""
        if (path, k) not in self.meshes:
            self.meshes[path, k] = builder.uniform(f"mesh {path}", "mesh")
        return self.meshes[path, k]


class LazyClock(dict[str, Operand]):
    """Times by name, each written when it is first asked for; and meshes, as "mesh " and the path."""

    def __init__(self, makers: dict[str, Callable[[], Operand]], mesh: Callable[[str], Operand] | None = None):
        super().__init__()
        self.makers = makers
        self.mesh = mesh

    def __missing__(self, name: str) -> Operand:
        """Write a time."""
        is_mesh = self.mesh is not None and name.startswith("mesh ")
        self[name] = self.mesh(name.removeprefix("mesh ")) if self.mesh and is_mesh else self.makers[name]()
        return self[name]

    def __contains__(self, name: object) -> bool:
        """Return whether there is such a time."""
        return name in self.makers
