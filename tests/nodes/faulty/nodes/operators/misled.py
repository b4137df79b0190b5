"""Misled: a drag whose linear form has the wrong sign."""

from graphfx.math import Vec3, exp, phi1
from graphfx.node import INFINITY, operator, param


def slowing(velocity: Vec3, drag: float) -> Vec3:
    """Return what should be the rate of change of the velocity."""
    return velocity * drag


@operator.flow(writes=("position", "velocity"), exact_if="threshold == infinity", linear=slowing)
def misled(
    position: Vec3,
    velocity: Vec3,
    dt: float,
    drag: float = param(1.0, unit="1/s", min=0, max=10, doc="Rate at which speed is lost."),
    threshold: float = param(INFINITY, unit="m/s", min=0, doc="Not used."),
) -> tuple[Vec3, Vec3]:
    """Return position and velocity after dt seconds."""
    return position + velocity * (dt * phi1(-drag * dt)), velocity * exp(-drag * dt)
