"""A selector that takes a mesh; no test finds it."""

from graphfx.math import Vec3
from graphfx.node import param, selector


@selector
def within(position: Vec3, mesh: str = param(type="mesh", required=True, doc="A geometry node.")) -> bool:
    """Return whether the particle is inside."""
    return position.y > 0.0
