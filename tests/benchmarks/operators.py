"""Time every moving operator alone: `python tests/benchmarks/operators.py`.

Each acts on a quarter of a million moving particles, on one thread, in CPU time: with parameters that
are one for all, with parameters that stand in columns of the particles, and with parameters drawn for each particle's life,
which are found again in every frame. The three take their frames in turn, so that a busy moment falls on each alike;
medians count, and ratios are the medians of the ratios of frames. What free flight alone takes is told first, to be
taken off. Aim: parameters in columns at most twice as dear as uniform ones. The last column tells what keeps a kernel
from being vector code, if anything does; `tests/machine/test_vector_code.py` holds all to it.

    --operators NAME ...   these alone
    --substeps N           steps of a frame: what is drawn for a life is found once in each
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.executor import BlockExecutor, Job
from graphfx.cook.simulate import Simulation
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.lanes.host import use_wide_registers
from graphfx.node import INFINITY, Library, NodeType, Parameter, library_roots

LIBRARY = Library(library_roots())
ROLES = ("linear", "flow", "velocity", "acceleration", "noise")
WARM_UP = 3
WAYS = ("uniform", "columns", "drawn")


class Watched(BlockExecutor):
    """The block machine with a clock on the program of whole steps."""

    def __init__(self, main: Any):
        super().__init__(32, 1)
        self.main = main
        self.seconds = 0.0

    def run(self, program: Any, job: Job) -> np.ndarray:
        """Run a program and note its CPU time."""
        began = time.process_time()
        result = super().run(program, job)
        if program is self.main:
            self.seconds = time.process_time() - began
        return result


def middle_of(parameter: Parameter) -> Any:
    """Return a value of a parameter at which its operator acts."""
    if isinstance(parameter.default, tuple):
        return list(parameter.default) if any(parameter.default) else [1.0, 0.5, 0.25]
    if parameter.type == "bool" or parameter.default == INFINITY:
        return None
    return parameter.default or (1 if parameter.type == "int" else 0.5)


def around(middle: Any) -> dict[str, Any]:
    """Return a draw around a value."""
    if isinstance(middle, list):
        return {"rand": [[0.9 * x for x in middle], [1.1 * x for x in middle]]}
    return {"rand": [0.9 * middle, 1.1 * middle]}


def effect_of(node_type: NodeType | None, way: str, particles: int, substeps: int) -> Effect:
    """Return the effect of an operator whose parameters are given in one of the WAYS."""
    sets: dict[str, Any] = {
        name: {"in_box": {"min": [0.2] * 3, "max": [2] * 3}} for name in ("position", "velocity", "spiral_axis", "rest_position")
    }
    sets["mass"] = {"rand": [0.5, 2]}
    attributes: dict[str, Any] = {}
    operator: dict[str, Any] = {"type": node_type.name} if node_type else {}
    for parameter in node_type.parameters.values() if node_type else ():
        middle = middle_of(parameter)
        if middle is None:
            continue
        if way == "columns" and parameter.type != "int":
            own = f"its_{parameter.name}"
            attributes[own] = {"type": "vec3" if isinstance(middle, list) else "float", "default": middle, "doc": "It."}
            sets[own] = around(middle)
            operator[parameter.name] = {"expr": own}
        else:
            operator[parameter.name] = around(middle) if way == "drawn" and parameter.type != "int" else middle
    document = {
        "graphfx": 1,
        **({"attributes": attributes} if attributes else {}),
        "time": {"fps": 24, "frames": [1, 100_000], "substeps": substeps},
        "nodes": {
            "sky": {"type": "emit", "count": particles, "set": sets},
            **({"act": {**operator, "from": "sky"}} if operator else {}),
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act" if operator else "sky", "camera": "view", "shutter": 0},
        },
    }
    return Effect(flatten(document_of(document), LIBRARY))


def frames_of(effect: Effect) -> Iterator[float]:
    """Yield, for every frame, the CPU seconds of the program of whole steps."""
    plan = effect.plan
    main = plan.emitters["sky"].main
    assert main is not None
    executor = Watched(main.program)
    for _ in Simulation(plan, executor).frames(plan.flat.time.last):
        yield executor.seconds


def measure(node_type: NodeType | None, ways: tuple[str, ...], particles: int, rounds: int, substeps: int) -> np.ndarray:
    """Return nanoseconds a particle and step for each round and way, in turn."""
    runs = [frames_of(effect_of(node_type, way, particles, substeps)) for way in ways]
    for _ in range(WARM_UP):
        for run in runs:
            next(run)
    return np.array([[next(run) for run in runs] for _ in range(rounds)]) * 1e9 / (particles * substeps)


def faults_of(node_type: NodeType) -> str:
    """Return why an operator's kernel is not vector code, or nothing."""
    return "branches=True: lane by lane" if node_type.branches else ""


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--particles", type=int, default=1 << 18)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--operators", nargs="*", default=[])
    parser.add_argument("--substeps", type=int, default=1)
    options = parser.parse_args()
    given = options.particles, options.rounds, options.substeps
    use_wide_registers()
    flight = np.median(measure(None, ("uniform",), *given))
    steps = f"{options.substeps} step{'s' * (options.substeps > 1)} a frame"
    print(f"{options.particles} particles, 32 bits, {steps}, one thread, CPU time; load {os.getloadavg()[0]:.1f}")
    print(f"ns a particle and step; free flight alone {flight:.2f}")
    print(f"{'':20} {'role':12} {'uniform':>8} {'columns':>8} {'ratio':>6} {'drawn':>8} {'ratio':>6}  not vector code")
    for name in options.operators or LIBRARY:
        node_type = LIBRARY[name]
        if node_type.kind != "operators" or node_type.role not in ROLES:
            continue
        times = measure(node_type, WAYS, *given)
        middle = np.median(times, axis=0)
        ratios = np.median(times / times[:, :1], axis=0)
        print(
            f"{name:20} {node_type.role:12} {middle[0]:8.2f} {middle[1]:8.2f} {ratios[1]:6.2f} {middle[2]:8.2f} {ratios[2]:6.2f}"
            f"  {faults_of(node_type)}",
            flush=True,
        )


if __name__ == "__main__":
    main()
