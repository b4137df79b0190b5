"""Bounce off a disc: a thin round sheet, from either side.

    met where the way of a step goes through the plane no farther than radius from the center

A particle is kept a hair's breadth (64 units in the last place) off the sheet, so that it never ends up behind it.

Also called: collider, collision.
"""

from graphfx.geometry import meets_plane, skin, skin_near
from graphfx.math import Vec3, dot, length
from graphfx.node import operator, param


@operator.surface
def bounce_disc(
    start: Vec3,
    end: Vec3,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Center of the disc."),
    normal: Vec3 = param((0, 1, 0), direction=True, doc="The disc is square to it."),
    disc_radius: float = param(1.0, unit="m", min=0, max=1e6, doc="Radius of the disc."),
) -> tuple[bool, Vec3, Vec3]:
    """Return whether the way meets the disc, a point of the plane where it stops, and the normal to its side."""
    thickness = skin_near(center) + skin(disc_radius)
    met, passing, level, facing = meets_plane(start, end, center, normal, thickness)
    offset = passing - center
    across = offset - normal * dot(offset, normal)
    return met & (length(across) <= disc_radius + thickness), center + facing * level, facing
