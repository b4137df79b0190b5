"""Slanted: a plane whose normal has not length 1."""

from graphfx.math import Vec3, dot
from graphfx.node import operator, param


@operator.surface
def slanted(position: Vec3, normal: Vec3 = param((0, 2, 0), doc="The normal.")) -> tuple[float, Vec3]:
    """Return the distance and the normal."""
    return dot(position, normal), normal
