"""A random share of the particles.

    u < fraction

A particle passes or does not for its whole life; `per` says otherwise. The same node used twice lets the same
particles pass, and another node others.
"""

from graphfx.node import param, selector


@selector
def share(draw: tuple, fraction: float = param(0.5, min=0, max=1, doc="Share of the particles that pass.")) -> bool:
    """Return whether the particle is among them."""
    return draw[0] < fraction
