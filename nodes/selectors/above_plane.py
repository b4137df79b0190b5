"""Above a plane, on the side to which its normal points.

    (P - point) . normal > 0

Also called: mask, region, half-space.
"""

from graphfx.math import Vec3, dot
from graphfx.node import param, selector


@selector
def above_plane(
    position: Vec3,
    point: Vec3 = param((0, 0, 0), unit="m", doc="Any point of the plane."),
    normal: Vec3 = param((0, 1, 0), direction=True, doc="Points upwards."),
) -> bool:
    """Return whether the particle is above."""
    return dot(position - point, normal) > 0.0
