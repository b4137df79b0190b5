"""Spring: pull each particle back to where it belongs, as cloth and jelly do.

    dV/dt = -frequency^2 (P - rest_position) - 2 damping_ratio frequency V

The paper's acceleration towards the local coordinates. Undamped, a particle swings about its rest position
`frequency / 2 pi` times a second; with a damping ratio of 1 it comes back as fast as it can without overshooting. The
mass does not matter. Exact for any step, however stiff. [Sims 1990, 3.4]
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="velocity", neutral="frequency == 0")
def spring(
    position: Vec3,
    velocity: Vec3,
    rest_position: Vec3,
    frequency: float = param(10.0, unit="rad/s", min=0, max=1e6, doc="Angular frequency of the undamped spring: its stiffness."),
    damping_ratio: float = param(0.1, min=0, max=1000, doc="0 swings for ever, below 1 overshoots, 1 and more does not."),
) -> Vec3:
    """Return the rate of change of the velocity."""
    return (position - rest_position) * -(frequency * frequency) - velocity * (damping_ratio * frequency * 2.0)
