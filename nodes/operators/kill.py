"""Kill: end the life of particles.

It acts at the start of each step, or at the moment that `when` says, on the particles that `only` lets pass.
A death it causes is a death like any other: `spawn` and `set` may answer to it. [Sims 1990, 3]
"""

from graphfx.node import language


@language("kill", "operators")
def kill() -> None:
    """End lives."""
