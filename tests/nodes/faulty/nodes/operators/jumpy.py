"""Jumpy: a flow that moves even when no time passes."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.flow(writes="position")
def jumpy(position: Vec3, dt: float, to: Vec3 = param((0, 1, 0), unit="m", doc="Where all go.")) -> Vec3:
    """Return the position after dt seconds."""
    return to
