"""Was hit: the particles that have met a surface.

    hits >= times

"""

from graphfx.node import param, selector


@selector
def was_hit(hits: float, times: float = param(1.0, min=0, doc="How often at least.")) -> bool:
    """Return whether the particle has met surfaces so often."""
    return hits >= times
