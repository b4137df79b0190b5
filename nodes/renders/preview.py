"""Preview: draw streams quickly, each particle a line from head to tail in its colour.

    alpha of a line, summed over its pixels = opacity (length + 1)

Lines are one pixel wide whatever the radius, and nothing is sorted by depth: a pixel shows the mean colour of its
lines. Of polygons the edges are drawn, but not within flat faces. An entry of `from` is a node's id, or
`{"stream": id, "blend": "over" | "add"}`. `graphfx preview` draws the pictures of any graph so. [Sims 1990, 3.5]
"""

from graphfx.math import Vec3
from graphfx.node import language, param


@language("preview", "renders")
def preview(
    camera: str = param(type="node", choices=("camera",), required=True, doc="The camera that it is seen through."),
    size: list = param((640, 360), type="list", min=1, max=65536, doc="Width and height in pixels."),
    shutter: float = param(0.5, unit="frames", min=0, max=4, doc="How long the shutter is open; 0 draws dots."),
    phase: float = param(0.0, unit="frames", min=0, max=4, doc="How long before the frame's time the shutter closes."),
    background: Vec3 = param((0, 0, 0), type="color", min=0, doc="Colour behind the particles."),
    background_image: str = param("", type="path", doc="A picture behind the particles, cut to the frame's shape."),
    transparent: bool = param(False, doc="Leave the background out and keep the picture's alpha."),
    exposure: float = param(0.0, unit="stops", min=-30, max=30, doc="The picture's light is scaled by 2 to this power."),
    display: str = param("srgb", choices=("srgb", "filmic", "raw"), doc="How light becomes the numbers of the picture."),
    file: str = param("{graph}.####.png", doc="Name of the files; #### is the frame and {graph} the graph's name."),
) -> None:
    """Draw."""
