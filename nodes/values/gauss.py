"""A normally distributed number (Box and Muller 1958).

    x = mean + deviation sqrt(-2 log(1 - u)) cos(2 pi v)

"""

from graphfx.math import cos, log, sqrt
from graphfx.node import param, value


@value
def gauss(
    draw: tuple,
    mean: float = param(0.0, doc="Mean of the distribution."),
    deviation: float = param(1.0, min=0, doc="Standard deviation."),
) -> float:
    """Return one number."""
    return mean + deviation * sqrt(log(1.0 - draw[0]) * -2.0) * cos(draw[1] * 6.283185307179586)
