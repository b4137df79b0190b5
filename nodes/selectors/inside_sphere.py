"""Inside a sphere.

    |P - center| <= radius

Also called: mask, region.
"""

from graphfx.math import Vec3, length
from graphfx.node import param, selector


@selector
def inside_sphere(
    position: Vec3,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Center of the sphere."),
    radius: float = param(1.0, unit="m", min=0, doc="Radius of the sphere."),
) -> bool:
    """Return whether the particle is in the sphere."""
    return length(position - center) <= radius
