"""A flat sheet about the origin, in the plane of x and z, that looks up."""

from graphfx.geometry import Mesh, grid
from graphfx.node import geometry, param


@geometry
def mesh_grid(
    width: float = param(1.0, unit="m", min=0, doc="Its length along x."),
    depth: float = param(1.0, unit="m", min=0, doc="Its length along z."),
    columns: int = param(1, min=1, max=1000, doc="Patches along x."),
    rows: int = param(1, min=1, max=1000, doc="Patches along z."),
) -> Mesh:
    """Return the sheet."""
    return grid(width, depth, columns, rows)
