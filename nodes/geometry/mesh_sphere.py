"""A sphere about the origin, of triangles of nearly one size: an icosahedron cut finer and finer.

    faces = 20 4^subdivisions
"""

from graphfx.geometry import Mesh, sphere
from graphfx.node import geometry, param


@geometry
def mesh_sphere(
    sphere_radius: float = param(1.0, unit="m", min=0, doc="Distance of its vertices from the origin."),
    subdivisions: int = param(3, min=0, max=8, doc="How often every triangle is cut in four."),
) -> Mesh:
    """Return the sphere."""
    return sphere(sphere_radius, subdivisions)
