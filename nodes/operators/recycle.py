"""Recycle: let particles begin again, as a waterfall whose drops go back to the top.

At the end of its life, or with `"when": "step"` as soon as `only` is true as a step starts, or at a `hit`, a particle
dies and is born again: the emitter's `set` is evaluated once more, with new random numbers, and `lives` counts one up.
Ages and hits are exact instants; a condition is looked at once a step. [Sims 1990, 5.2]

Also called: respawn, loop.
"""

from graphfx.node import language


@language("recycle", "operators")
def recycle() -> None:
    """Begin again."""
