"""The two ways to run a program: on blocks, and in plain Python. They give the same bits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from graphfx.program import Program
from graphfx.program.reference import run_particle

Arrays = Mapping[str, tuple[np.ndarray, ...]]


@dataclass(frozen=True)
class Job:
    """What a program is run on: all of `count` rows, or those `listed`, less the `excluded` ones.

    `arrays` are the store's, by name; `by_place` those that run along with `listed`. `uniforms` are values by
    id(uniform); `now` is the time from which ages count [s].
    """

    count: int
    arrays: Arrays
    listed: np.ndarray | None = None
    excluded: np.ndarray | None = None
    uniforms: Mapping[int, Any] = field(default_factory=dict)
    by_place: Arrays = field(default_factory=dict)
    now: float = 0.0


class Executor(Protocol):
    """Runs programs over rows of columns."""

    def prepare(self, program: Program) -> Any:
        """Make ready to run a program, so that what is wrong with it shows before any work."""
        ...

    def run(self, program: Program, job: Job) -> np.ndarray:
        """Run over the rows of a job; return those rejected."""
        ...


class BlockExecutor:
    """Runs on the block machine; a program is assembled when first seen."""

    def __init__(self, precision: int = 32, threads: int = 1):
        self.precision = precision
        self.threads = threads
        self._assembled: dict[int, Any] = {}

    def prepare(self, program: Program) -> Any:
        """Assemble a program, compiling kernels never used before."""
        from graphfx.machine.assemble import assemble

        if id(program) not in self._assembled:
            self._assembled[id(program)] = assemble(program, self.precision)
        return self._assembled[id(program)]

    def run(self, program: Program, job: Job) -> np.ndarray:
        """Run on blocks of 256 rows, on all threads."""
        from graphfx.machine.run import NO_BITS, NO_ROWS, Rows, bits_of, run

        bits = bits_of(job.excluded, job.count) if job.excluded is not None and job.excluded.size else NO_BITS
        rows = Rows(job.count if job.listed is None else len(job.listed), NO_ROWS if job.listed is None else job.listed, bits)
        return run(self.prepare(program), rows, job.arrays, job.uniforms, job.by_place, job.now, self.threads)


class ReferenceExecutor:
    """Runs in plain Python, a particle at a time: slow, and what the block machine is held to."""

    def __init__(self, precision: int = 32):
        self.precision = precision

    def prepare(self, program: Program) -> None:
        """Do nothing: plain Python needs no preparation."""

    def run(self, program: Program, job: Job) -> np.ndarray:
        """Run row by row."""
        left_out = set() if job.excluded is None else set(job.excluded.tolist())
        rejected = []
        for place, row in enumerate(range(job.count) if job.listed is None else job.listed.tolist()):
            if row in left_out:
                continue
            loaded = {name: self._read(name, column.type, job, row, place) for name, column in program.loads.items()}
            values = run_particle(program, loaded, job.uniforms, self.precision)
            if program.rejects is not None and values.get(id(program.rejects)):
                rejected.append(row)
                continue
            for name, column in program.stores.items():
                value = values[id(column)]
                parts = job.by_place.get(name) or job.arrays[name]
                target = place if name in job.by_place else row
                for part, number in zip(parts, value if column.type == "vec3" else (value,), strict=True):
                    part[target] = number
        return np.array(rejected, np.int64)

    @staticmethod
    def _read(name: str, type_: str, job: Job, row: int, place: int) -> Any:
        parts, index = (job.by_place[name], place) if name in job.by_place else (job.arrays[name], row)
        if name == "age":
            return job.now - parts[0][index]
        return tuple(part[index] for part in parts) if type_ == "vec3" else parts[0][index]
