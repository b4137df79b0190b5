"""Follow path: put particles on a smooth path through the points of a mesh, each at its own share of the way.

    P = C(progress) + offset,    C = Catmull-Rom through the vertices in turn

It sets the position on each frame, whatever it was: `"progress": {"expr": "age / 3"}` takes three seconds from end to
end. Also called curve guide. [Sims 1990, 3; Catmull and Rom 1974]
"""

from graphfx.geometry import Mesh, along_vertices
from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.assign(writes="position")
def follow_path(
    mesh: Mesh = param(required=True, doc="The geometry node whose points the path goes through, such as mesh_points."),
    progress: float = param(0.0, doc="Share of the way: 0 is its first point, 1 its last; it stays at its ends."),
    offset: Vec3 = param((0, 0, 0), unit="m", doc="Added to the position; each particle may have its own."),
) -> Vec3:
    """Return the position."""
    point, _ = along_vertices(mesh, progress)
    return point + offset
