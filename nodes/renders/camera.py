"""Camera: where a picture is seen from.

Perspective: an object of size s at depth d covers s / d * lens / 36 of the picture's width, the film being
36 mm wide. Orthographic: it covers s / view_width.

With an `f_stop` a perspective camera has a depth of field: a point at depth d is spread over a disc on the film of diameter

    c = lens^2 |d - focus_distance| / (f_stop d (focus_distance - lens))

which widens a particle and makes it fainter, its total of light kept: a blurred opaque disc is a larger, fainter one. Of
polygons nothing is out of focus. Every number may change with time, by keys or an expression; while the shutter is
open, what stands still goes straight on the screen from where the camera saw it at the opening.
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
    f_stop: float = param(INFINITY, min=1e-3, doc="Lens over the width of its opening; infinite, all is sharp."),
    focus_distance: float = param(10.0, unit="m", min=1e-6, doc="Depth along the view that is sharp, where there is an f_stop."),
    near: float = param(0.01, unit="m", min=1e-6, doc="What is nearer is not drawn."),
    far: float = param(INFINITY, unit="m", min=1e-6, doc="What is farther is not drawn."),
) -> None:
    """See."""
