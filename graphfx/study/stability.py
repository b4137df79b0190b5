"""Stability: every operator at the ends of its declared ranges, alone and in pairs, at steps from 1e-12 to 1e6 s.

Particles of all sizes of place and speed go two steps. What comes out is finite, or given up and reported, or is refused with
a message. Who is given up within a millisecond has not grown so far: an operator is wrong there, as where a number that is
none is kept (a bug).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from graphfx.cook.simulate import Simulation
from graphfx.cook.trial import Trials
from graphfx.errors import GraphfxError
from graphfx.graph.document import document_of
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.motion.clock import most_cells
from graphfx.node import Library, NodeType, Parameter
from graphfx.plan.support import MOVING_ROLES

STEPS = (1e-12, 1e-6, 1e-3, 1 / 24, 1.0, 1e3, 1e6)
"""Lengths of a step [s]."""
RUNS = tuple(("strang", precision, step) for precision in (32, 64) for step in STEPS)
"""Methods, precisions and steps; `strang` is exact wherever that can be, and `sims` is left out: it is known to be unstable."""
ALONE = (*RUNS, ("adaptive", 64, 1e-12), ("adaptive", 64, 1 / 24))
"""What an operator is tried with alone."""
GREAT = 1e6
"""What stands for the end of a range that has none."""
PLACES = (0.0, 1e-30, 1e-3, 1.0, 1e6)
SPEEDS = (0.0, 1e-30, 1e-3, 1.0, 1e5)
DIRECTIONS = ((1.0, 0.0, 0.0), (0.36, -0.48, 0.8))
SHORT = 1e-3
"""Steps in which nothing sound grows beyond the numbers [s]."""
MOST_CELLS = 100
"""Cells of noise that a step may meet here; planning for more takes long."""
ROLES = (*MOVING_ROLES, "assign")
NAMES = {"finite": "finite", "infinite": "grows beyond the numbers", "failed": "given up, and reported", "refused": "refused",
         "not_tried": "not tried", "bug": "beyond the numbers at once"}
"""What can come out, the better first."""


@dataclass(frozen=True)
class Ends:
    """An operator with parameters at some ends of their ranges, and what that is called."""

    name: str
    label: str
    arguments: tuple[tuple[str, Any], ...]

    def entry(self) -> dict[str, Any]:
        """Return the operator as it stands in a document."""
        return {"type": self.name, **dict(self.arguments)}


@dataclass
class Case:
    """One run: operators, method, precision, step [s], and what came out."""

    operators: tuple[Ends, ...]
    method: str
    precision: int
    step: float
    outcome: str = "finite"
    message: str = ""
    greatest: float = 0.0
    """The farthest finite place [m]."""

    @property
    def what(self) -> str:
        """Return the run in words."""
        operators = " and ".join(f"{each.name} ({each.label})" for each in self.operators)
        return f"{operators}; {self.method}, {self.precision} bits, steps of {self.step:.3g} s"


@dataclass
class Stability:
    """All runs, and the operators that could not be tried, with the reason."""

    cases: list[Case] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)
    stopped: bool = False

    @property
    def operators(self) -> list[str]:
        """Return the operators that were tried, in order."""
        return list(dict.fromkeys(each.name for case in self.cases for each in case.operators))

    def count(self, outcome: str, *names: str) -> int:
        """Return how many runs of these operators together, or of all, came out so."""
        return sum(case.outcome == outcome and (not names or sorted(names) == sorted(each.name for each in case.operators))
                   for case in self.cases)


def tried(library: Library) -> tuple[list[NodeType], dict[str, str]]:
    """Return the operators of a library that move particles, and those that cannot be tried, with the reason."""
    moving = [found for found in library.values() if found.kind == "operators" and found.role in ROLES]
    left = {}
    for found in moving:
        needs = [each for each in found.parameters.values() if each.required and each.type != "mesh" and not _ends(each)]
        if needs:
            left[found.name] = f"its parameter '{needs[0].name}' is a {needs[0].type}, and none is made up here"
    return [found for found in moving if found.name not in left], left


def _ends(parameter: Parameter) -> tuple[Any, ...]:
    """Return the ends of a parameter's range: the least and the greatest that it may be."""
    low = parameter.min if parameter.min is not None and math.isfinite(parameter.min) else -GREAT
    high = parameter.max if parameter.max is not None and math.isfinite(parameter.max) else GREAT
    if parameter.type in ("float", "int"):
        return (int(low), int(high)) if parameter.type == "int" else (low, high)
    if parameter.type in ("vec3", "point"):
        return [low] * 3, [high] * 3
    if parameter.type == "bool":
        return False, True
    if parameter.type == "direction":
        return [0.0, 1.0, 0.0], [0.6, 0.0, -0.8]
    return parameter.choices


def ends_of(node_type: NodeType) -> list[Ends]:
    """Return an operator at its defaults, with all parameters at their low ends, at their high ends, and with each one alone."""
    name, needed = node_type.name, {each.name: "shape" for each in node_type.parameters.values() if each.type == "mesh"}
    ranges = {each.name: ends for each in node_type.parameters.values() if len(ends := _ends(each)) > 1}

    def made(label: str, given: dict[str, Any]) -> Ends:
        return Ends(name, label, tuple((needed | given).items()))

    found = [made("defaults", {}), made("all low", {key: ends[0] for key, ends in ranges.items()}),
             made("all high", {key: ends[-1] for key, ends in ranges.items()})]
    found += [made(f"{key} {value if not isinstance(value, list) else value[0]:.6g}" if not isinstance(value, (str, bool))
                   else f"{key} {value}", {key: value}) for key, ends in ranges.items() for value in ends]
    return found


def graph_of(operators: Sequence[Ends], library: Library) -> FlatGraph:
    """Return the graph of particles under operators, in order."""
    count = len(PLACES) * len(SPEEDS) * len(DIRECTIONS)
    sets: dict[str, Any] = {"position": {"in_box": {}}, "velocity": {"in_sphere": {}}}
    document = {
        "graphfx": 1, "time": {"frames": [0, 2]},
        "nodes": {
            "shape": {"type": "mesh_box"},
            "dots": {"type": "emit", "rate": 0, "count": count, "set": sets},
            "act": {"type": "stack", "from": "dots", "ops": [each.entry() for each in operators]},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
        },
    }
    return flatten(document_of(document, "stability"), library)


def states() -> tuple[np.ndarray, np.ndarray]:
    """Return the places [m] and velocities [m/s] that are tried, (n, 3) each: all sizes of both, along and across an axis."""
    pairs = list(itertools.product(PLACES, SPEEDS, DIRECTIONS))
    way = np.array([direction for _, _, direction in pairs])
    across = np.roll(way, 1, axis=1)
    return way * np.array([[place] for place, _, _ in pairs]), across * np.array([[speed] for _, speed, _ in pairs])


def run_case(case: Case, flat: FlatGraph) -> None:
    """Run a case and note what came out."""
    fps = 1 / case.step
    cells = most_cells(fps, 0.0, 1)
    if cells > MOST_CELLS and any(node.node_type.role == "noise" for node in flat.nodes.values()):
        case.outcome, case.message = "not_tried", f"each step would meet {cells:,} cells of noise"
        return
    time = replace(flat.time, fps=fps, method=case.method, precision=case.precision)
    try:
        simulation = Trials(replace(flat, time=time)).simulation()
        with np.errstate(all="ignore"):
            _follow(simulation, case)
    except GraphfxError as error:
        case.outcome, case.message = "refused", error.problems[0].message


def _follow(simulation: Simulation, case: Case) -> None:
    """Put particles where they are to begin, and watch them for two steps."""
    particles = simulation.particles["dots"]
    infinite = np.zeros(len(states()[0]), bool)
    for number, _ in enumerate(simulation.frames(2)):
        if number == 0:
            for name, value in zip(("position", "velocity"), states(), strict=True):
                if particles.has(name) and name in particles.store.columns:
                    for k, part in enumerate(particles.store.column(name)):
                        part[:] = value[:, k]
            continue
        arrays = [np.stack(particles.store.column(name)) for name in ("position", "velocity") if name in particles.store.columns]
        every = np.concatenate(arrays) if arrays else np.zeros((3, particles.store.count))
        ids = particles.store.column("id")[0]
        infinite[ids] |= np.isinf(every).any(axis=0)
        if (np.isnan(every).any(axis=0) & ~infinite[ids]).any():
            case.outcome = "bug"
            return
        known = np.abs(every[:3][np.isfinite(every[:3])])
        case.greatest = max(case.greatest, float(known.max(initial=0.0)))
    why = [reason for count, reason in ((particles.lost, "a step would lead beyond the numbers"),
                                        (particles.failed, "no step was short enough"),
                                        (particles.unfinished, "too many contacts in a step")) if count]
    wrong = particles.lost and case.step <= SHORT
    case.outcome = "bug" if wrong else "infinite" if infinite.any() else "failed" if why else "finite"
    case.message = ", ".join(why)


def cases_of(library: Library, pairs: bool = True) -> tuple[list[tuple[Ends, ...]], dict[str, str]]:
    """Return the operators to be run alone, then in pairs; and what is left out."""
    found, left = tried(library)
    ends = [ends_of(each) for each in found]
    alone: list[tuple[Ends, ...]] = [(each,) for several in ends for each in several]
    if not pairs:
        return alone, left
    together = [(first[k], second[n]) for first, second in itertools.combinations(ends, 2)
                for k, n in ((0, 0), (1, 1), (2, 2), (1, 2), (2, 1))]
    return alone + together, left


def stability(
    library: Library, tell: Callable[[str, float], None] = lambda what, share: None, every: int = 1
) -> Stability:
    """Try all operators of a library, or every n-th combination; what is stopped by Ctrl-C keeps what is done."""
    combinations, left = cases_of(library)
    made = Stability(left_out=left)
    combinations = combinations[::every]
    try:
        for number, operators in enumerate(combinations):
            tell(" and ".join(f"{each.name} ({each.label})" for each in operators), number / len(combinations))
            made.cases += cases_with(operators, library)
    except KeyboardInterrupt:
        made.stopped = True
    return made


def cases_with(operators: tuple[Ends, ...], library: Library) -> Iterator[Case]:
    """Run operators together, alone with more methods."""
    try:
        flat, refusal = graph_of(operators, library), ""
    except GraphfxError as error:
        flat, refusal = None, error.problems[0].message
    for method, precision, step in ALONE if len(operators) == 1 else RUNS:
        case = Case(operators, method, precision, step)
        if flat is None:
            case.outcome, case.message = "refused", refusal
        else:
            run_case(case, flat)
        yield case
