"""Unbounded: a pull that is infinite at its center."""

from graphfx.math import Vec3, dot
from graphfx.node import operator, param


@operator.acceleration
def unbounded(position: Vec3, center: Vec3 = param((0, 0, 0), unit="m", doc="The center.")) -> Vec3:
    """Return the acceleration."""
    return (center - position) / dot(position - center, position - center)
