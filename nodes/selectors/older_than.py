"""Older than a time.

    age > seconds

"""

from graphfx.node import param, selector


@selector
def older_than(age: float, seconds: float = param(1.0, unit="s", min=0, doc="The age that is not yet enough.")) -> bool:
    """Return whether the particle is older."""
    return age > seconds
