"""Bounce off a box along the axes: solid, or a container.

    q = |P - center| - size / 2
    distance = |max(q, 0)| outside, the greatest of q inside

The normal is that of the nearest point; both are the other way round with `inside`.

Also called: collider, collision, container.
"""

from graphfx.math import Vec3, absolute, copysign, length, maximum, where
from graphfx.node import operator, param


@operator.surface
def bounce_box(
    position: Vec3,
    center: Vec3 = param((0, 0, 0), unit="m", doc="Center of the box."),
    size: Vec3 = param((1, 1, 1), unit="m", min=0, doc="Width, height and depth of the box."),
    inside: bool = param(False, doc="Whether it is hollow and holds particles in, instead of keeping them out."),
) -> tuple[float, Vec3]:
    """Return the signed distance from the box and the normal."""
    offset = position - center
    x, y, z = absolute(offset.x) - size.x * 0.5, absolute(offset.y) - size.y * 0.5, absolute(offset.z) - size.z * 0.5
    deepest = maximum(maximum(x, y), z)
    along_x = x >= deepest
    along_y = (y >= deepest) & ~along_x
    wall = Vec3(where(along_x, 1.0, 0.0) + x * 0.0, where(along_y, 1.0, 0.0) + x * 0.0,
                where(along_x | along_y, 0.0, 1.0) + x * 0.0)
    apart = Vec3(maximum(x, 0.0), maximum(y, 0.0), maximum(z, 0.0))
    away = length(apart)
    outside = away > 0.0
    towards = where(outside, apart / where(outside, away, 1.0), wall)
    normal = Vec3(copysign(towards.x, offset.x), copysign(towards.y, offset.y), copysign(towards.z, offset.z))
    container = Vec3(copysign(wall.x, offset.x), copysign(wall.y, offset.y), copysign(wall.z, offset.z))
    return where(inside, -deepest, where(outside, away, deepest)), where(inside, -container, normal)
