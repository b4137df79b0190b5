"""An exponentially distributed number that is infinite where the draw is 0.

    x = -mean log(u)

"""

from graphfx.math import log
from graphfx.node import param, value


@value
def endless(draw: tuple, mean: float = param(1.0, min=0, max=1000, doc="Mean of the distribution.")) -> float:
    """Return one number."""
    return log(draw[0]) * -mean
