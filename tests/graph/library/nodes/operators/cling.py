"""An operator that takes a mesh; no test runs it."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.assign(writes="position")
def cling(position: Vec3, mesh: str = param(type="mesh", required=True, doc="A geometry node.")) -> Vec3:
    """Return the position."""
    return position
