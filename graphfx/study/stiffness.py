"""How stiff a scene is: the largest rates that its particles really reach, against what each method takes.

Of an operator that changes the velocity by A(P, V), with the eigenvalues e of the derivatives at the particles' states,

    w = max sqrt(|e(dA/dP)|),    d = max(-Re e(dA/dV)),    s = max |Im e(dA/dV)|,

and of one that moves the position by U(P), s = max |e(dU/dP)|. With h the length of a frame, m steps of `strang` are stable
for w h < 2 m where the operator is composed around others (flows and linear motion are exact, without a limit), `rk45` for
w h < m and d h < 3.3 m, and `sims` for (1 - d h / m)(1 + (w h / m)^2 / 2) < 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from graphfx.cook.sample import Sample
from graphfx.cook.trial import States, Trials, spread_frames
from graphfx.graph.flat import FlatGraph
from graphfx.study.candidates import settings
from graphfx.study.energy import drifts, is_conserved
from graphfx.study.fields import Field, fields_of

FRAMES = 12
"""Frames at which rates are measured."""
MOST = 1024
"""Steps beyond which no number is told."""


@dataclass
class Stiffness:
    """The largest rates of one operator on one source [1/s], times the length of a frame; `exact` if no method has a limit."""

    source: str
    operator: str
    type: str
    exact: bool
    w: float = 0.0
    d: float = 0.0
    s: float = 0.0

    @property
    def strang(self) -> int:
        """Return the steps a frame that `strang` needs to be stable."""
        return 1 if self.exact else _steps(self.w / 2)

    @property
    def rk45(self) -> int:
        """Return the steps a frame that `rk45` needs at least."""
        return _steps(max(self.w, self.d / 3.3, self.s / 3.3))

    @property
    def sims(self) -> int | None:
        """Return the steps a frame that `sims` needs to be stable, None where it never is."""
        for m in (2**k for k in range(11)):
            if (1 - self.d / m) * (1 + (self.w / m) ** 2 / 2) < 1 and self.d / m < 2:
                return m
        return None if self.w > 0 else 1


def _steps(needed: float) -> int:
    return MOST if not needed < MOST else max(math.floor(needed) + 1, 1)


@dataclass
class Scene:
    """A simulation that was followed to a frame: what its operators reach on the way, and their fields where it stands."""

    flat: FlatGraph
    sample: Sample | None
    last: int
    reached: list[Stiffness] = field(default_factory=list)
    fields: dict[str, list[Field]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Follow the particles, and measure every operator at the states that they reach."""
        simulation = Trials(_followed(self.flat), self.sample).simulation()
        simulation.programs.prepare()
        self.fields = fields_of(simulation)
        every = [(path, each) for path, several in self.fields.items() for each in several]
        self.reached = [Stiffness(path, each.mover.node.path, each.mover.node.node_type.name,
                                  each.mover.role in ("linear", "flow") or each.mover is each.particles.plan.motion.base)
                        for path, each in every]
        wanted = set(spread_frames(range(self.flat.time.first, self.last + 1), FRAMES))
        with np.errstate(all="ignore"):
            for frame in simulation.frames(self.last):
                for made, (_, each) in zip(self.reached, every, strict=True):
                    if frame in wanted and each.particles.store.count:
                        _measure(each, made, 1 / self.flat.time.fps)

    def drift(self, path: str, true: States, other: States) -> float:
        """Return the RMS of the energy that was made or lost, over the mean of the kinetic energy; of what never moved 0."""
        with np.errstate(all="ignore"):
            found = drifts(self.fields[path], true, other)
            scale = float(np.mean(np.sum(true.velocity**2, axis=1)) / 2) if len(true) else 0.0
            return float(np.sqrt(np.mean(found**2)) / scale) if len(found) and scale > 0 else 0.0

    def conserved(self) -> list[str]:
        """Return the sources of which energy is defined, and kept."""
        with np.errstate(all="ignore"):
            return [path for path, fields in self.fields.items() if is_conserved(fields)]


def _followed(flat: FlatGraph) -> FlatGraph:
    """Return a graph whose particles go near enough to where they should: four symmetric steps a frame."""
    return replace(flat, time=settings(flat.time, "strang", 64, 4))


def _measure(of: Field, made: Stiffness, h: float) -> None:
    """Note the largest rates of a field where particles are now, times h."""
    by_place, by_speed = of.derivatives("position"), of.derivatives("velocity")
    along = eigenvalues(by_place)
    if of.mover.writes_velocity:
        made.w = max(made.w, float(np.sqrt(np.abs(along).max(initial=0.0))) * h)
        speeds = eigenvalues(by_speed)
        made.d = max(made.d, float((-speeds.real).max(initial=0.0)) * h)
        made.s = max(made.s, float(np.abs(speeds.imag).max(initial=0.0)) * h)
    else:
        made.s = max(made.s, float(np.abs(along).max(initial=0.0)) * h)


def eigenvalues(matrices: np.ndarray | None) -> np.ndarray:
    """Return the eigenvalues of all matrices that are numbers."""
    if matrices is None:
        return np.zeros(0, complex)
    return np.linalg.eigvals(matrices[np.isfinite(matrices).all(axis=(1, 2))]).ravel()
