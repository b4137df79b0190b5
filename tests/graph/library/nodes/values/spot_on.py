"""A value that takes a mesh; no test finds it."""

from graphfx.math import Vec3
from graphfx.node import param, value


@value(results=("point", "normal"))
def spot_on(mesh: str = param(type="mesh", required=True, doc="A geometry node.")) -> tuple[Vec3, Vec3]:
    """Return a point, and the normal there."""
    return Vec3(0.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)
