"""Warn of particles so far from the origin that 32 bits tell places only coarsely apart.

Neighbours among numbers of 32 bits are 2^-23 of their size apart: a sixteenth of a metre at 1e6 m. What moves less than
half of that in a step stands still.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from graphfx.cook.simulate import Simulation
from graphfx.errors import Problem
from graphfx.graph.values import Literal
from graphfx.plan.make import EmitterPlan

FAR = 1e6
"""Coordinates from which on particles of 32 bits are told of [m]."""


@dataclass
class FarAway:
    """Tells of each source once, at the first frame that shows particles of it far away; and of surfaces as large or far."""

    told: set[str] = field(default_factory=set)

    def warnings(self, simulation: Simulation, frame: int) -> Iterator[Problem]:
        """Yield what to tell at a frame."""
        if simulation.plan.precision == 64:
            return
        for path, particles in simulation.particles.items():
            yield from self._surfaces(particles.plan)
            if path in self.told or not particles.alive or not particles.has("position"):
                continue
            farthest = max(_farthest(np.asarray(part)) for part in particles.value("position"))
            if farthest >= FAR:
                self.told.add(path)
                message = f"from frame {frame} on there are particles at coordinates of {_coarse(farthest)}"
                yield Problem(message, particles.plan.node.location, f"nodes.{path}")

    def _surfaces(self, emitter: EmitterPlan) -> Iterator[Problem]:
        """Yield what to tell of surfaces with a length or a place that is as great, once."""
        for node in emitter.holder.of_role("surface"):
            for name, value in node.arguments.items():
                declared = node.node_type.parameters.get(name)
                if declared is None or declared.unit != "m" or not isinstance(value, Literal) or node.path in self.told:
                    continue
                size = _farthest(np.array(value.value, float))
                if size >= FAR:
                    self.told.add(node.path)
                    yield Problem(f"its {name} is {_coarse(size)}", value.location, f"nodes.{node.path}.{name}")


def _coarse(size: float) -> str:
    place = f"{size:,.0f}" if size < 1e12 else f"{size:.3g}"
    return (f"{place} m, where 32 bits tell places {np.spacing(np.float32(size)):g} m apart at best; add \"precision\": 64 to "
            "`time`, or bring the scene nearer to the origin")


def _farthest(coordinates: np.ndarray) -> float:
    """Return the greatest finite size of coordinates [m]."""
    flat = coordinates.ravel()
    size = float(max(np.fmax.reduce(flat, initial=0.0), -np.fmin.reduce(flat, initial=0.0)))
    if np.isfinite(size):
        return size
    finite = np.abs(flat[np.isfinite(flat)])
    return float(finite.max(initial=0.0))
