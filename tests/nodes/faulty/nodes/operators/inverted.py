"""Inverted: a plane whose normal points into the solid."""

from graphfx.math import Vec3, dot
from graphfx.node import operator, param


@operator.surface
def inverted(position: Vec3, normal: Vec3 = param((0, 1, 0), direction=True, doc="The normal.")) -> tuple[float, Vec3]:
    """Return the distance and the normal."""
    return dot(position, normal), -normal
