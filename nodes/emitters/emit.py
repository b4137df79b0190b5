"""Emit: make particles, evenly over time.

    births = rate * dt

The k-th particle is born where the integral of `rate` over time passes k. `set` gives each its
attributes at birth; `during` limits the time in which particles are made. [Sims 1990, 3]
"""

from graphfx.node import INFINITY, language, param


@language("emit", "emitters")
def emit(
    rate: float = param(100.0, unit="1/s", min=0, doc="Particles made per second."),
    life: float = param(INFINITY, unit="s", min=0, doc="Age at which a particle dies; each particle may have its own."),
) -> None:
    """Make particles."""
