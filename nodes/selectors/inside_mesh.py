"""Inside a closed mesh: a ray from the particle meets its faces an odd number of times.

A mesh that is not closed has no inside; what this says of one means nothing. It goes particle by particle.

Also called: mask, region, volume.
"""

from graphfx.geometry import Mesh, is_inside
from graphfx.math import Vec3
from graphfx.node import param, selector


@selector(branches=True)
def inside_mesh(
    position: Vec3,
    mesh: Mesh = param(required=True, doc="The geometry node whose mesh it is."),
) -> bool:
    """Return whether the particle is inside."""
    return is_inside(mesh, position)
