"""A point on a ring about +y, and its directions: a value of several results."""

from graphfx.math import Vec3, sincos
from graphfx.node import param, value


@value(results=("point", "normal", "turn"))
def on_ring(draw: tuple, radius: float = param(1.0, unit="m", doc="Radius of the ring.")) -> tuple[Vec3, Vec3, float]:
    """Return the point, the direction outwards and the angle in turns."""
    sine, cosine = sincos(draw[0] * 6.283185307179586)
    return Vec3(radius * cosine, 0.0, radius * sine), Vec3(cosine, 0.0, sine), draw[0]
