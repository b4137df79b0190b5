"""The vertices of a mesh in turn: one particle on each, the first again after the last.

    number = id mod number of vertices

The id of a particle is the ordinal of its birth, so an emitter whose `count` is the number of vertices puts one on
each. [Sims 1990, 3.1]

Also called: one per vertex.
"""

from graphfx.geometry import Mesh, vertex, vertex_in_turn, vertex_normal
from graphfx.math import Vec3
from graphfx.node import param, value


@value(results=("point", "normal"))
def at_vertices(
    id: tuple,
    mesh: Mesh = param(required=True, doc="The geometry node whose mesh it is."),
) -> tuple[Vec3, Vec3]:
    """Return the particle's vertex, and the normal there."""
    number = vertex_in_turn(mesh, id)
    return vertex(mesh, number), vertex_normal(mesh, number)
