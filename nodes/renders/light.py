"""Light: shines on polygons from far away, in one direction; particles shine by themselves.

An image is lit by those that its `lights` name. Without any, one light of 0.85 shines from over the camera's left
shoulder. What stands between a surface and a light throws no shadow.
"""

from graphfx.math import Vec3
from graphfx.node import language, param


@language("light", "renders")
def light(
    direction: Vec3 = param((0.48, -0.6, -0.64), direction=True, doc="The way in which the light travels."),
    color: Vec3 = param((1, 1, 1), type="color", min=0, doc="Its colour and strength; parts may be above 1."),
) -> None:
    """Shine."""
