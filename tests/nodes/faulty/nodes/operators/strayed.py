"""Strayed: a pull along an axis whose exact flow forgets half of it."""

from graphfx.math import Vec3
from graphfx.node import operator, param


def fallen(position: Vec3, velocity: Vec3, pull: Vec3, dt: float) -> tuple[Vec3, Vec3]:
    """Its fall."""
    return position + velocity * dt + pull * (0.25 * dt * dt), velocity + pull * (0.5 * dt)


@operator.acceleration(flow=fallen, exact_if="growth == 0")
def strayed(
    position: Vec3,
    pull: Vec3 = param((0, -1, 0), unit="m/s^2", doc="The pull."),
    growth: float = param(0.0, unit="1/m", min=0, max=1, doc="Growth of the pull with the distance."),
) -> Vec3:
    """Return the acceleration."""
    return pull * (1.0 + growth * (position.x * position.x))
