"""Uniformly in a ball.

    r = radius w^(1/3), in a direction uniform on the sphere

[Sims 1990, 3.1]
"""

from graphfx.math import Vec3, on_unit_sphere, power
from graphfx.node import param, value


@value
def in_sphere(
    draw: tuple,
    center: Vec3 = param((0, 0, 0), doc="Center of the ball."),
    radius: float = param(1.0, min=0, doc="Radius of the ball."),
) -> Vec3:
    """Return a point of the ball."""
    return center + on_unit_sphere(draw[0], draw[1]) * (radius * power(draw[2], 0.3333333333333333))
