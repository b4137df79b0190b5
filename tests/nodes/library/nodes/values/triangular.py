"""A number with a triangular distribution.

    x = low + (high - low) (u + v) / 2

"""

from graphfx.node import param, value


@value
def triangular(
    draw: tuple,
    low: float = param(0.0, doc="Least number."),
    high: float = param(1.0, doc="Greatest number."),
) -> float:
    """Return one number."""
    return low + (high - low) * (draw[0] + draw[1]) * 0.5
