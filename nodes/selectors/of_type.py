"""Of one type: the particles whose `type` is a number.

    type = number

"""

from graphfx.node import param, selector


@selector
def of_type(type: float, number: float = param(0.0, doc="The number that an emitter, spawn or set gave as type.")) -> bool:
    """Return whether the particle is of the type."""
    return type == number
