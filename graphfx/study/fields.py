"""What an operator does to particles where they are: its rate of change of the velocity or the position, and how that varies.

The rates are written as a program of the plan itself, so parameters are what they are in the graph; derivatives are
central differences.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from graphfx.cook.particles import Particles, padded
from graphfx.cook.simulate import Simulation
from graphfx.motion import basic
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.make import EmitterPlan, Plan
from graphfx.plan.moment import Constants, Moments
from graphfx.plan.movers import Mover, linear_form
from graphfx.plan.setting import as_column
from graphfx.plan.values import node_function
from graphfx.program import Builder, Column, Uniform

ROLES = ("linear", "acceleration", "velocity", "flow")
NUDGE = 1e-5
"""The way of a difference, as a share of a place or a speed, and at least that many metres or metres a second."""
SHORT = 1e-4
"""The time in which a flow shows its rate [s]."""
ZERO = Uniform("(0, 0, 0)", "vec3", (0.0, 0.0, 0.0))


def rate_program(plan: Plan, emitter: EmitterPlan, mover: Mover) -> FrameProgram:
    """Return the program that finds the rate of an operator at the middle of a frame: zero where it does not act."""
    motion, seed, precision = emitter.motion, plan.flat.seed, plan.precision
    builder = Builder.begin(f"{mover.node.path}: rate")
    made = FrameProgram(builder.program, cells=motion.cells)
    constants = Constants(emitter.holder, emitter.attributes, seed, precision)
    moments = Moments(seed, emitter.path, precision, emitter.attributes, constants.find, made)
    state = moments.state(builder, motion.has_velocity)
    moment = moments.whole_step(builder, 0, state)
    result = as_column(builder, ZERO, "vec3", "rate", always=True)
    inside = motion.under_conditions(mover, moment)
    acting = linear_form(mover) or as_declared(mover)
    if acting.role != "flow":
        found = inside.call(acting.function, *motion.arguments(acting, moment, state), name="found")
        inside.call(basic.copy_vector, found, into=result)
    else:
        name = "velocity" if mover.writes_velocity else "position"
        after = {each: Column(f"{each} after", "vec3") for each in mover.writes}
        dt = Uniform("short", "float", SHORT)
        inside.call(mover.function, *motion.arguments(mover, moment, state, {"dt": dt}), into=tuple(after.values()))
        change = inside.call(basic.difference_of_vectors, after[name], state.read(name), name="change")
        inside.call(basic.advance, ZERO, change, Uniform("per short", "float", 1 / SHORT), into=result)
    builder.store("rate", result)
    return made


def as_declared(mover: Mover) -> Mover:
    """Return an operator that runs as the exact flow of its acceleration as that acceleration; others as they are."""
    declared = mover.node.node_type
    if mover.role != "flow" or declared.role != "acceleration":
        return mover
    return Mover(mover.node, node_function(declared), declared.arguments, "acceleration")


@dataclass
class Field:
    """The rates of one operator on the particles of a simulation, where that stands."""

    simulation: Simulation
    particles: Particles
    mover: Mover
    made: FrameProgram = field(init=False)

    def __post_init__(self) -> None:
        """Write and prepare the program."""
        plan = self.simulation.plan
        self.made = rate_program(plan, self.particles.plan, self.mover)
        self.simulation.programs.meshes.prepare(self.made)
        self.simulation.programs.executor.prepare(self.made.program)

    def rates(self) -> np.ndarray:
        """Return the rate of each particle where it is, (n, 3)."""
        count, programs = self.particles.store.count, self.simulation.programs
        rate = tuple(padded(np.zeros(count), programs.real) for _ in range(3))
        with np.errstate(all="ignore"):
            programs.run(self.made, self.particles, self.simulation.interval, np.arange(count), by_place={"rate": rate})
        return np.stack([part[:count] for part in rate], axis=1).astype(np.float64)

    def derivatives(self, name: str) -> np.ndarray | None:
        """Return how the rate changes with the position, or with the velocity: (n, 3, 3), columns by its components."""
        store = self.particles.store
        if name not in store.columns or name not in self.made.program.loads:
            return None
        columns = store.column(name)
        found = []
        for part in columns:
            kept = part.copy()
            nudge = NUDGE * np.maximum(np.abs(kept), 1.0)
            part[:] = kept + nudge
            ahead = self.rates()
            part[:] = kept - nudge
            behind = self.rates()
            part[:] = kept
            found.append((ahead - behind) / (2 * nudge[:, None]))
        return np.stack(found, axis=2)


def fields_of(simulation: Simulation) -> dict[str, list[Field]]:
    """Return the fields of all operators that have a rate, by source."""
    return {path: [Field(simulation, particles, mover) for mover in particles.plan.motion.movers
                   if mover.role in ROLES and not mover.idle]
            for path, particles in simulation.particles.items()}
