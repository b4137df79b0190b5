"""A point of a smooth path through the points of a mesh, at a share of the way: splines to follow, paths of emitters.

    P = Catmull-Rom through the vertices in turn, at `progress` from 0, the first, to 1, the last

Also called a curve or a guide. `tangent` is dP / dprogress. [Catmull and Rom 1974]
"""

from graphfx.geometry import Mesh, along_vertices
from graphfx.math import Vec3
from graphfx.node import param, value


@value(results=("point", "tangent"))
def along_path(
    mesh: Mesh = param(required=True, doc="The geometry node whose points the path goes through, such as mesh_points."),
    progress: float = param(0.0, doc="Share of the way: 0 is its first point, 1 its last; it stays at its ends."),
) -> tuple[Vec3, Vec3]:
    """Return the point, and the way on from there."""
    return along_vertices(mesh, progress)
