"""Warn of particles whose next step would lead beyond the numbers: it is not taken, and they stay where they were."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from graphfx.cook.simulate import Simulation
from graphfx.errors import Problem
from graphfx.plan.overflow import growing


@dataclass
class Lost:
    """Tells of each source once, at the first frame by which a step of its particles was not taken."""

    told: set[str] = field(default_factory=set)

    def warnings(self, simulation: Simulation, frame: int) -> Iterator[Problem]:
        """Yield what to tell at a frame."""
        for path, particles in simulation.particles.items():
            if path in self.told or not particles.lost:
                continue
            self.told.add(path)
            causes = growing(particles.plan.motion)
            advice = "look in what moves them for what grows without end, a division by 0, or a root of what is below 0"
            if causes:
                names = " and ".join(mover.node.path for mover in causes)
                advice = f"{names} may drive them away faster and faster: lower its rate, or let it end (`during`)"
            message = (
                f"by frame {frame} a step would {particles.lost:,} times have led a particle beyond the numbers of "
                f"{simulation.plan.precision} bits, or to no number; it stayed where it was; {advice}"
            )
            node = causes[0].node if causes else particles.plan.node
            yield Problem(message, node.location, f"nodes.{node.path}")
