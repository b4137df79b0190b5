"""Hasty: a turn by Euler's method, which is no exact flow."""

from graphfx.math import Vec3, cross
from graphfx.node import operator, param


@operator.flow(writes="position")
def hasty(position: Vec3, dt: float, axis: Vec3 = param((0, 1, 0), direction=True, doc="Axis of the turn.")) -> Vec3:
    """Return the position after dt seconds."""
    return position + cross(axis, position) * dt
