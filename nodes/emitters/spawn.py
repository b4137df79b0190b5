"""Spawn: make particles from particles: splashes, sparks, bursts, trails.

    births = count              at each birth, hit or death of a parent, as `when` says
    births = rate * dt          along the path of each parent, where `rate` is given instead

What is made starts at the instant and the place of its cause, as a copy of its parent (of the attributes that `inherit`
lists); `set` is applied, where `parent.x` is the parent's and `hit.point`, `hit.normal` and `hit.speed` tell of the contact,
and a random velocity in a ball of radius `spread` added. It makes a stream of its own, or with `into` joins an emitter's.

Also called: sub-emitter, trails, event.
"""

from graphfx.node import language, param


@language("spawn", "emitters")
def spawn(
    rate: float = param(0.0, unit="1/s", min=0, doc="Particles made per second by each parent, along its path."),
    count: int = param(1, min=0, doc="Particles made at each event; each parent may have its own."),
    probability: float = param(1.0, min=0, max=1, doc="Share of the events that make any."),
    spread: float = param(0.0, unit="m/s", min=0, doc="Speed of the random velocity that is added, at most."),
    life: float = param(None, unit="s", min=0, doc="Age at which what is made dies; without it, the parent's."),
    inherit: list = param(None, type="list", doc="Attributes copied from the parent, besides its position; without it, all."),
    into: str = param(None, type="node", choices=("emit",), doc="An emitter whose particles they join."),
    generations: int = param(8, min=1, doc="With into: so many spawns away from the emitter at most."),
) -> None:
    """Make particles of particles."""
