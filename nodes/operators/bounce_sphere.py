"""Bounce off a sphere: solid, or a container.

    distance = |P - center| - radius,    normal = (P - center) / |P - center|

both the other way round with `inside`. A particle at the very center has no nearest point; its normal is zero and
it stays. [Sims 1990, 3.4.3]

Also called: collider, collision.
"""

from graphfx.math import Vec3, length, where
from graphfx.node import operator, param


@operator.surface
def bounce_sphere(
    position: Vec3,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Center of the sphere."),
    sphere_radius: float = param(1.0, unit="m", min=0, doc="Radius of the sphere."),
    inside: bool = param(False, doc="Whether it is hollow and holds particles in, instead of keeping them out."),
) -> tuple[float, Vec3]:
    """Return the signed distance from the sphere and its normal."""
    offset = position - center
    R = length(offset)
    distance, normal = R - sphere_radius, offset * where(R > 0.0, 1.0 / R, 0.0)
    return where(inside, -distance, distance), where(inside, -normal, normal)
