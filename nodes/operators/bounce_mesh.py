"""Bounce off a mesh, from either side: it need not be closed, and may hold particles in.

The way of each step is searched in a tree of boxes for the first face that it meets; the contact is then found
along the true path. A particle is kept a hair's breadth (64 units in the last place of the mesh's greatest coordinate)
off the mesh, so that it never ends up behind it. One that starts on the mesh counts as in front of it. It goes particle
by particle.

A mesh that moves is met where it stands in the middle of each step, and gives particles nothing of its own speed; one
that sweeps on faster than they get away may pass over them.

Also called: collider, collision, collide with geometry.
"""

from graphfx.geometry import Mesh, first_meeting
from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.surface(branches=True)
def bounce_mesh(
    start: Vec3,
    end: Vec3,
    mesh: Mesh = param(required=True, doc="The geometry node whose mesh it is."),
) -> tuple[bool, Vec3, Vec3]:
    """Return whether the way meets the mesh, a point of the plane where it stops, and the normal to its side."""
    return first_meeting(mesh, start, end)
