"""A vector in a cone: the parameters of the real one."""

from graphfx.math import Vec3
from graphfx.node import param, value


@value
def in_cone(
    draw: tuple,
    direction: Vec3 = param((0, 1, 0), direction=True, doc="Axis of the cone."),
    angle: float = param(30.0, unit="deg", min=0, max=180, doc="Half the cone's opening."),
    length: float = param(1.0, doc="Length of the vector."),
) -> Vec3:
    """Return a vector."""
    return direction
