"""Near: particles within a distance of a point.

    |P - center| < distance

"""

from graphfx.math import Vec3, length
from graphfx.node import param, selector


@selector
def near(
    position: Vec3,
    center: Vec3 = param((0, 0, 0), unit="m", doc="The point."),
    distance: float = param(1.0, unit="m", min=0, doc="How far particles may be."),
) -> bool:
    """Return whether the particle is near."""
    return length(position - center) < distance
