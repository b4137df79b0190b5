"""The height of the particle: a value that reads an attribute."""

from graphfx.math import Vec3
from graphfx.node import param, value


@value
def height(position: Vec3, scale: float = param(required=True, doc="What it is multiplied by.")) -> float:
    """Return a number."""
    return position.y * scale
