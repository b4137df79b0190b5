"""Damp: slow particles down, as air does, but not below a threshold.

    dV/dt = -damping V while |V| > threshold,    so V' = V max(exp(-damping dt), min(1, threshold / |V|))

and the position moves by the integral of V: the particle slows down until t = log(|V| / threshold) / damping and goes on
evenly from there. The paper's V' = V max(1 - d dt, ...) is its first-order form, which overshoots at d dt > 1; this one is
exact for any step. A negative damping speeds up, without a limit but e^68 in one step: `undamp` has one. [Sims 1990, 3.4.1]

Also called: air friction, slow down.
"""

from graphfx.math import Vec3, exp, length, log, maximum, minimum, phi1, where
from graphfx.node import INFINITY, operator, param


def slowing(velocity: Vec3, damping: float) -> Vec3:
    """Return the rate of change of the velocity where there is no threshold."""
    return velocity * -damping


@operator.flow(writes=("position", "velocity"), neutral="damping == 0", exact_if="threshold == 0", linear=slowing)
def damp(
    position: Vec3,
    velocity: Vec3,
    dt: float,
    damping: float = param(1.0, unit="1/s", min=-50, doc="Rate at which speed is lost; 0 to 10 is usual."),
    threshold: float = param(0.0, unit="m/s", min=0, doc="Speed below which nothing is lost."),
) -> tuple[Vec3, Vec3]:
    """Return position and velocity after dt seconds."""
    speed = length(velocity)
    fast = (speed > threshold) | (damping < 0.0)
    least = where(fast, where(damping < 0.0, 0.0, threshold / speed), 1.0)
    slow = minimum(where(fast, where(damping > 0.0, log(1.0 / least) / damping, INFINITY), 0.0), dt)
    way = slow * phi1(minimum(-(damping * slow), 68.0)) + least * (dt - slow)
    return position + velocity * way, velocity * maximum(exp(minimum(-(damping * dt), 68.0)), least)
