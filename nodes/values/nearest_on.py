"""The point of a mesh's surface that is nearest to a point, such as a particle's own position."""

from graphfx.geometry import Mesh, nearest
from graphfx.math import Vec3, length
from graphfx.node import param, value


@value(results=("point", "normal", "distance"), branches=True)
def nearest_on(
    position: Vec3,
    mesh: Mesh = param(required=True, doc="The geometry node whose mesh it is."),
) -> tuple[Vec3, Vec3, float]:
    """Return the point, the normal of the face there, and how far away it is [m]."""
    point, normal = nearest(mesh, position)
    return point, normal, length(position - point)
