"""Uniformly on the surface of a sphere.

    z = 2 u - 1, P = center + radius (sqrt(1 - z^2) cos 2 pi v, sqrt(1 - z^2) sin 2 pi v, z)

Equal heights of a sphere have equal areas (Archimedes). [Sims 1990, 3.1]
"""

from graphfx.math import Vec3, maximum, sincos, sqrt
from graphfx.node import param, value


@value
def on_sphere(
    draw: tuple,
    center: Vec3 = param((0, 0, 0), doc="Center of the sphere."),
    radius: float = param(1.0, min=0, doc="Radius of the sphere."),
) -> Vec3:
    """Return a point of the surface."""
    z = draw[0] * 2.0 - 1.0
    ring = sqrt(maximum(1.0 - z * z, 0.0))
    sine, cosine = sincos(draw[1] * 6.283185307179586)
    return center + Vec3(ring * cosine, ring * sine, z) * radius
