"""A direction uniformly within a cone, times a length: velocities and axes "straight down, with some variation".

    cos t = 1 - u (1 - cos angle),   V = length (cos t direction + sin t (cos 2 pi v e1 + sin 2 pi v e2))

"""

from graphfx.math import Vec3, around, cos, maximum, sqrt
from graphfx.node import param, value


@value
def in_cone(
    draw: tuple,
    direction: Vec3 = param((0, 1, 0), direction=True, doc="Axis of the cone."),
    angle: float = param(30.0, unit="deg", min=0, max=180, doc="Half the cone's opening; 0 is its axis, 180 all directions."),
    length: float = param(1.0, doc="Length of the vector; a speed, for velocities."),
) -> Vec3:
    """Return a vector of the cone."""
    height = 1.0 - draw[0] * (1.0 - cos(angle * 0.017453292519943295))
    ring = sqrt(maximum(1.0 - height * height, 0.0))
    return (direction * height + around(direction, draw[1]) * ring) * length
