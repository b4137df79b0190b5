"""Just born: younger than a time, a frame at 24 frames per second unless it is stated.

    age < seconds

"""

from graphfx.node import param, selector


@selector
def just_born(
    age: float,
    seconds: float = param(0.0416667, unit="s", min=0, doc="The age from which it is just born no more."),
) -> bool:
    """Return whether the particle has only just been born."""
    return age < seconds
