"""A value that takes a mesh; no test finds it."""

from graphfx.math import Vec3
from graphfx.node import param, value


@value
def spot_on(mesh: str = param(type="mesh", required=True, doc="A geometry node.")) -> Vec3:
    """Return a point."""
    return Vec3(0.0, 0.0, 0.0)
