"""Undamp: speed particles up to a threshold, smoothly, along the way that they go.

    dV/dt = rate V while |V| < threshold,    so V' = V min(exp(rate dt), max(1, threshold / |V|))

and the position moves by the integral of V: the particle speeds up until t = log(threshold / |V|) / rate and goes on
evenly from there. Faster ones, and those that do not move, are left alone. Exact for any step. [Sims 1990, 3.4.1]
"""

from graphfx.math import Vec3, exp, length, log, maximum, minimum, phi1, where
from graphfx.node import INFINITY, operator, param


def speeding(velocity: Vec3, rate: float) -> Vec3:
    """Return the rate of change of the velocity where there is no threshold."""
    return velocity * rate


@operator.flow(writes=("position", "velocity"), neutral="rate == 0", exact_if="threshold == infinity", linear=speeding)
def undamp(
    position: Vec3,
    velocity: Vec3,
    dt: float,
    rate: float = param(1.0, unit="1/s", min=0, max=50, doc="Rate at which speed is gained."),
    threshold: float = param(INFINITY, unit="m/s", min=0, doc="Speed that is reached; faster particles are left alone."),
) -> tuple[Vec3, Vec3]:
    """Return position and velocity after dt seconds."""
    speed = length(velocity)
    most = where(speed > 0.0, maximum(threshold / speed, 1.0), 1.0)
    gaining = minimum(where(rate > 0.0, log(most) / rate, INFINITY), dt)
    coasting = where(gaining < dt, most * (dt - gaining), 0.0)
    way = gaining * phi1(rate * gaining) + coasting
    return position + velocity * way, velocity * minimum(exp(rate * dt), most)
