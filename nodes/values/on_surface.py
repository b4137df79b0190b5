"""Evenly on the surface of a mesh: every face as likely as its area.

    A + (B - A) u + (C - A) v,  u + v <= 1

With the point come the normal of the face and its up-most tangent, the tangent that points most nearly up; on a
horizontal face that is +x. Where it gives the position, they are the particle's `normal` and `tangent`; for more of
them, name the value, `"values": {"spot": {"on_surface": ...}}`, and read `spot.normal`. [Sims 1990, 3.1 and 5.3]

Also called: scatter on a surface.
"""

from graphfx.geometry import Mesh, choose_face, face_normal, face_point, upmost_tangent
from graphfx.math import Vec3
from graphfx.node import param, value


@value(results=("point", "normal", "tangent"))
def on_surface(
    draw: tuple,
    mesh: Mesh = param(required=True, doc="The geometry node whose mesh it is."),
) -> tuple[Vec3, Vec3, Vec3]:
    """Return a point of the surface, with the normal and the up-most tangent there."""
    face = choose_face(mesh, draw[0], draw[1])
    normal = face_normal(mesh, face)
    return face_point(mesh, face, draw[2], draw[3]), normal, upmost_tangent(normal)
