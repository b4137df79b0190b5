"""How much energy a method makes or loses, where energy is defined: where the acceleration is the gradient of a potential.

That is so of a source if all its operators give accelerations that depend on the position alone, not on time, with
symmetric derivatives, and nothing else moves its particles. The true motion then keeps each particle's energy, so that what
a method has changed by some time is, against the truth at P_true and V_true,

    E - E_true = (V^2 - V_true^2) / 2 - integral of A . dP from P_true to P

along the straight way between, which is short: by the Gauss-Legendre rule of 8 points. [m^2/s^2]
"""

from __future__ import annotations

import numpy as np

from graphfx.cook.matching import keys_of, matched
from graphfx.cook.trial import States, states_of
from graphfx.study.fields import Field, as_declared

SYMMETRIC = 1e-4
"""How unlike its transpose a matrix of derivatives may be, as a share of its size: differences are no better."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


def is_conserved(fields: list[Field]) -> bool:
    """Return whether energy is defined for a source, and kept: at the states in which its particles are now."""
    if not fields:
        return False
    plan, particles = fields[0].particles.plan, fields[0].particles
    acting = [mover for mover in plan.motion.movers if not mover.idle]
    known = {id(each.mover) for each in fields}
    moved = {"position", "velocity"} & set(plan.holder.changing)
    if moved or not particles.store.count or any(id(mover) not in known for mover in acting):
        return False
    if not all(each.mover.writes_velocity and as_declared(each.mover).role != "flow" and each.mover.time_free for each in fields):
        return False
    for each in fields:
        by_place, by_speed = each.derivatives("position"), each.derivatives("velocity")
        if by_speed is not None and np.abs(by_speed).max(initial=0.0) > 0:
            return False
        if by_place is not None and not _is_symmetric(by_place):
            return False
    return True


def _is_symmetric(matrices: np.ndarray) -> bool:
    size = np.abs(matrices).max(axis=(1, 2))
    unlike = np.abs(matrices - matrices.transpose(0, 2, 1)).max(axis=(1, 2))
    return bool((unlike <= SYMMETRIC * np.maximum(size, size.max(initial=0.0) * 1e-3)).all())


def drifts(fields: list[Field], true: States, other: States) -> np.ndarray:
    """Return E - E_true of each particle that all have [m^2/s^2]; the fields stand at the same instant."""
    particles = fields[0].particles
    here = {int(key): row for row, key in enumerate(keys_of(states_of(particles)))}
    rows, theirs = matched(true, other)
    known = np.array([int(key) in here for key in keys_of(true)[rows]], bool)
    rows, theirs = rows[known], theirs[known]
    places = particles.living()[[here[int(key)] for key in keys_of(true)[rows]]]
    way = other.position[theirs] - true.position[rows]
    work = np.zeros(len(rows))
    columns = particles.store.column("position")
    kept = [part.copy() for part in columns]
    for node, weight in zip((NODES + 1) / 2, WEIGHTS / 2, strict=True):
        point = true.position[rows] + node * way
        for k, part in enumerate(columns):
            part[places] = point[:, k]
        acceleration = np.sum([each.rates()[places] for each in fields], axis=0)
        work += weight * np.sum(acceleration * way, axis=1)
    for part, before in zip(columns, kept, strict=True):
        part[:] = before
    speeds = [np.sum(each**2, axis=1) for each in (other.velocity[theirs], true.velocity[rows])]
    return np.asarray((speeds[0] - speeds[1]) / 2 - work)
