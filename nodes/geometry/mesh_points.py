"""A cloud of points, for from_points and at_vertices: it has no surface."""

from graphfx.geometry import Mesh, points
from graphfx.node import geometry, param


@geometry
def mesh_points(
    coordinates: list = param(type="list", required=True, doc="The points, one after another: x, y, z, x, y, z, ..."),
) -> Mesh:
    """Return the points."""
    return points(coordinates)
