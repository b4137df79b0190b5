"""Uniformly on the surface of a sphere.

    z = 2 u - 1, P = center + radius (sqrt(1 - z^2) cos 2 pi v, sqrt(1 - z^2) sin 2 pi v, z)

Equal heights of a sphere have equal areas (Archimedes). [Sims 1990, 3.1]
"""

from graphfx.math import Vec3, on_unit_sphere
from graphfx.node import param, value


@value
def on_sphere(
    draw: tuple,
    center: Vec3 = param((0, 0, 0), doc="Center of the sphere."),
    radius: float = param(1.0, min=0, doc="Radius of the sphere."),
) -> Vec3:
    """Return a point of the surface."""
    return center + on_unit_sphere(draw[0], draw[1]) * radius
