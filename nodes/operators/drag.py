"""Drag: air that resists with the square of the speed, as it does anything larger than dust.

    dV/dt = -strength |U| U,    U = V - wind

    U' = U / (1 + x),    P' = P + wind dt + U dt log(1 + x) / x,    x = strength |U| dt

The speed falls as 1 / t, so a particle never quite stops. With gravity it falls at sqrt(g / strength) in the end. Exact for
any step where it acts alone. [Newton's resistance; the paper calls for it in 3.4.1]

Also called: air friction.
"""

from graphfx.math import Vec3, length, log, minimum, where
from graphfx.node import operator, param


@operator.flow(writes=("position", "velocity"), neutral="strength == 0")
def drag(
    position: Vec3,
    velocity: Vec3,
    dt: float,
    strength: float = param(0.1, unit="1/m", min=0, max=1e6, doc="Resistance; half the speed is lost in 0.69 / strength metres."),
    wind: Vec3 = param((0, 0, 0), unit="m/s", doc="Velocity of the air."),
) -> tuple[Vec3, Vec3]:
    """Return position and velocity after dt seconds."""
    against = velocity - wind
    grown = 1.0 + minimum(strength * length(against) * dt, 1e30)
    way = where(grown > 1.0, log(grown) / (grown - 1.0), 1.0) * dt
    return position + wind * dt + against * way, wind + against * (1.0 / grown)
