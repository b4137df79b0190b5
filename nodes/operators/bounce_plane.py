"""Bounce off a plane: the half-space under it is solid.

    distance = (P - point) . normal

At the instant of contact V' = (1 - friction) Vt - resilience Vn, where Vn and Vt are the parts of the velocity
along the normal and along the plane. [Sims 1990, 3.4.3] Infinitely many bounces, of a particle pressed on a surface with
less resilience than 1, end in finite time: 2 v / (g (1 - resilience)) from the first on, then it rests (with friction) or
slides (without, and with a friction_threshold: no faster than that as it begins to) until what presses it turns away. A surface
that moves carries particles along its normal; it gives them nothing of its own speed.

Also called: collision, collider, ground, floor.
"""

from graphfx.math import Vec3, dot
from graphfx.node import operator, param


@operator.surface
def bounce_plane(
    position: Vec3,
    point: Vec3 = param((0, 0, 0), unit="m", doc="Any point of the plane."),
    normal: Vec3 = param((0, 1, 0), direction=True, doc="Points out of the solid side."),
) -> tuple[float, Vec3]:
    """Return the signed distance from the plane and its normal."""
    return dot(position - point, normal), normal
