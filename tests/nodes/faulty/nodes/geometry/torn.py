"""Torn: a sheet that has a corner too few when it is large."""

from graphfx.geometry import Mesh, grid
from graphfx.node import geometry, param


@geometry
def torn(size: float = param(1.0, unit="m", min=0, doc="Length of its sides.")) -> Mesh:
    """Return the sheet."""
    whole = grid(size, size, 1, 1)
    return whole if size < 2 else Mesh(whole.vertices[:3], whole.triangles)
