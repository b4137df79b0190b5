"""One of the points of a mesh or a cloud of points, each as likely.

    number = floor(count u)
"""

from graphfx.geometry import Mesh, choose_vertex, vertex, vertex_normal
from graphfx.math import Vec3
from graphfx.node import param, value


@value(results=("point", "normal"))
def from_points(
    draw: tuple,
    mesh: Mesh = param(required=True, doc="The geometry node whose points they are."),
) -> tuple[Vec3, Vec3]:
    """Return a point, and the normal there (0 in a cloud of points)."""
    number = choose_vertex(mesh, draw[0], draw[1])
    return vertex(mesh, number), vertex_normal(mesh, number)
