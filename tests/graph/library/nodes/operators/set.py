"""Set: give attributes new values.

It acts on each frame, or at the moment that `when` says. A value may read the attribute that it sets,
which is then its value before: `"set": {"radius": {"expr": "radius * 0.99"}}`.
"""

from graphfx.node import language


@language("set", "operators")
def set() -> None:
    """Give attributes the values in `set`."""
