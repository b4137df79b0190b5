"""Emit: make particles, evenly over time, or many at once.

    births = rate * dt,    and `count` more at the start and after each `every` seconds

The k-th particle of a rate is born where the integral of `rate` over time passes k. `set` gives each its
attributes at birth; `during` limits the time in which particles are made. Where `count` is given and `rate` is
not, or `vertices`, the rate is 0: a burst, or a fixed population that lives on. `"clusters": {"flicker": {"count": 60, "by":
"turn"}}` numbers the particles, in turn or as the nearest of so many seeds, for values drawn once for each
cluster. [Sims 1990, 3]
"""

from graphfx.node import INFINITY, language, param


@language("emit", "emitters")
def emit(
    rate: float = param(100.0, unit="1/s", min=0, doc="Particles made per second; 0 where only a count is given."),
    life: float = param(INFINITY, unit="s", min=0, doc="Age at which a particle dies; each particle may have its own."),
    count: int = param(0, min=0, doc="Particles made at once as it begins."),
    vertices: str = param(None, type="mesh", doc="A mesh: as it begins, one particle is made for each of its vertices."),
    every: float = param(INFINITY, unit="s", min=1e-6, doc="After this time the count is made once more, again and again."),
) -> None:
    """Make particles."""
