"""Set: give attributes new values.

    x' = value

It acts on each frame, or at the moment that `when` says: birth, step, frame, hit, `{"hit": [surfaces]}` or death.
A value may read the attribute that it sets, which is then its value before: `{"radius": {"expr": "radius * 0.99"}}`.
`tail.radius`, `tail.color` and `tail.opacity` set the tail's alone: comets. [Sims 1990, 3.5]
"""

from graphfx.node import language


@language("set", "operators")
def set() -> None:
    """Give attributes the values in `set`."""
