"""Above: particles higher than a height."""

from graphfx.math import Vec3
from graphfx.node import param, selector


@selector
def above(position: Vec3, height: float = param(0.0, unit="m", doc="The height.")) -> bool:
    """Return whether the particle is higher."""
    return position.y > height
