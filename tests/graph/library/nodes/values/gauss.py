"""A normal number: the parameters of the real one."""

from graphfx.node import param, value


@value
def gauss(
    draw: tuple,
    mean: float = param(0.0, doc="Mean."),
    deviation: float = param(1.0, min=0, doc="Standard deviation."),
) -> float:
    """Return a number."""
    return mean
