"""Camera: where a picture is seen from.

Perspective: an object of size s at depth d covers s / d * lens / 36 of the picture's width, the film being
36 mm wide. Orthographic: it covers s / view_width.
"""

from graphfx.math import Vec3
from graphfx.node import INFINITY, language, param


@language("camera", "renders")
def camera(
    position: Vec3 = param((0, 2, 10), type="point", unit="m", doc="Where the camera stands."),
    target: Vec3 = param((0, 2, 0), type="point", unit="m", doc="The point at the centre of the picture."),
    up: Vec3 = param((0, 1, 0), direction=True, doc="The direction that is upwards in the picture."),
    projection: str = param("perspective", choices=("perspective", "orthographic"), doc="How depth shows."),
    lens: float = param(35.0, unit="mm", min=1, max=10000, doc="Focal length over a film 36 mm wide, for perspective."),
    view_width: float = param(10.0, unit="m", min=1e-6, doc="Width that the picture shows, for orthographic."),
    near: float = param(0.01, unit="m", min=1e-6, doc="What is nearer is not drawn."),
    far: float = param(INFINITY, unit="m", min=1e-6, doc="What is farther is not drawn."),
) -> None:
    """See."""
