"""Fade: bring attributes nearer to a target, at a rate.

    dx/dt = rate (target - x),    so x(t) = target + (x(0) - target) exp(-rate t)

Exact for any step, and it never overshoots: after ln(2) / rate seconds half the way is gone. [Sims 1990, 5.2]
"""

from graphfx.node import language, param


@language("fade", "operators")
def fade(
    rate: float = param(1.0, unit="1/s", min=0, doc="Share of the way to the target that is gone per second, at first."),
) -> None:
    """Bring attributes nearer to the values in `set`."""
