"""Write what surfaces are asked: how far from them a place is, and which way is out, at an instant of a step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphfx.graph.values import Literal
from graphfx.math import Vec3
from graphfx.motion.probe import shape_of
from graphfx.plan.moment import Moment, State
from graphfx.plan.motion import Motion, Mover
from graphfx.program import Column, Operand
from graphfx.program.reference import lane_value


def moves(surface: Mover) -> bool:
    """Return whether a surface changes with time by itself, and not with what meets it."""
    return not surface.constant and not surface.follows_state


def shape(surface: Mover) -> str:
    """Return the shape of a surface's solid: "plane", "convex", "hollow", or "" if that is not known, or changes."""
    kinds = dict(zip(surface.arguments, surface.function.arguments, strict=True))
    truths = [surface.node.arguments.get(name) for name, type_ in kinds.items() if type_ == "bool"]
    known = tuple(bool(value.value) for value in truths if isinstance(value, Literal))
    if not surface.constant or len(known) < len(truths):
        return ""
    return shape_of(surface.function.body, surface.arguments, surface.function.arguments, known)


def never_dips(motion: Motion, plane: Mover) -> bool:
    """Return whether no way that ends above a plane may have been below it: nothing drives particles out of the solid.

    V' = g - d V with g . N <= 0, of every operator: what goes in is never turned round.
    """
    normal = _evaluated(plane)
    for mover in motion.movers:
        if mover.idle or mover.role == "surface":
            continue
        form = mover.form if mover.role == "linear" and mover.writes_velocity else None
        if normal is None or form is None or form.turning or form.stiffness:
            return False
        driven = _evaluated(mover) if form.constant else 0.0 * normal
        if driven is None or driven @ normal > 0.0:
            return False
    return True


def _evaluated(mover: Mover) -> np.ndarray | None:
    """Return an operator's vector for a particle at rest at the origin, if it depends on nothing else."""
    state = {name: Literal("vec3", value=(0.0, 0.0, 0.0)) for name in ("position", "velocity")}
    given = [mover.node.arguments.get(name, state.get(name)) for name in mover.arguments]
    values = [value.value for value in given if isinstance(value, Literal)]
    if len(values) < len(given):
        return None
    types = mover.function.arguments
    found = mover.function.body(*(lane_value(value, type_, np.float64) for value, type_ in zip(values, types, strict=True)))
    vector = found if isinstance(found, Vec3) else found[1]
    return np.array([vector.x, vector.y, vector.z])


def distance_of(
    motion: Motion, surface: Mover, moment: Moment, state: State, place: Operand | None = None, begins: bool = False
) -> tuple[Column, Column]:
    """Write the signed distance of a place (where the particle is, if not given) and the normal there.

    A surface that moves stands where it does as the step ends, or `begins`.
    """
    builder = moment.builder
    builder.note = surface.node.path
    if moves(surface):
        moment = replace(moment, writer=moment.opening() if begins else moment.closing())
    operands = motion.arguments(surface, moment, state, {} if place is None else {"position": place})
    distance, normal = builder.call(surface.function, *operands, name="distance normal")
    return distance, normal
