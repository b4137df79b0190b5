"""Bounce off a plane: the parameters of the real one."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.surface
def bounce_plane(
    position: Vec3,
    point: Vec3 = param((0, 0, 0), unit="m", doc="Any point of the plane."),
    normal: Vec3 = param((0, 1, 0), direction=True, doc="Points out of the solid side."),
) -> tuple[float, Vec3]:
    """Return the distance and the normal."""
    return position.y, normal
