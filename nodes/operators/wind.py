"""Wind: air that moves takes particles along.

    dV/dt = drag (wind - V)

The velocity tends to that of the wind. Without wind it is `damp`; with gravity it ends at wind + g / drag. Exact for
any dt. The wind may be any value, such as one keyed in time. [after Sims 1990, 3.4.1]
"""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.linear(writes="velocity", neutral="drag == 0")
def wind(
    velocity: Vec3,
    wind: Vec3 = param((1, 0, 0), unit="m/s", doc="Velocity of the air."),
    drag: float = param(1.0, unit="1/s", min=0, doc="How fast the air takes particles along; the heavier, the less."),
) -> Vec3:
    """Return the rate of change of the velocity."""
    return (wind - velocity) * drag
