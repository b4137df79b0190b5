"""Image: draw streams into one picture per frame.

An entry of `from` is a node's id, or `{"stream": id, "blend": "over" | "add", "falloff": "linear" |
"gaussian" | "disc", "streak": "exposed" | "solid"}`. [Sims 1990, 4]
"""

from graphfx.math import Vec3
from graphfx.node import language, param


@language("image", "renders")
def image(
    camera: str = param(type="node", choices=("camera",), required=True, doc="The camera that it is seen through."),
    size: list = param((1280, 720), type="list", min=1, max=65536, doc="Width and height in pixels."),
    shutter: float = param(0.5, unit="frames", min=0, max=1, doc="How long the shutter is open; 0 draws no streaks."),
    background: Vec3 = param((0, 0, 0), type="color", min=0, doc="Colour behind the particles."),
    background_image: str = param("", type="path", doc="A picture behind the particles, cut to the frame's shape."),
    transparent: bool = param(False, doc="Leave the background out and keep the picture's alpha."),
    exposure: float = param(0.0, unit="stops", min=-30, max=30, doc="The picture's light is scaled by 2 to this power."),
    display: str = param("srgb", choices=("srgb", "filmic", "raw"), doc="How light becomes the numbers of a PNG."),
    file: str = param("{graph}.####.png", doc="Name of the files, .png or .exr; #### is the frame and {graph} the graph's name."),
    bits: int = param(choices=("8", "16", "32"), doc="Bits of a number: PNG 8 (default) or 16, EXR 16 (default) or 32."),
    channels: list = param((), type="list", choices=("depth", "velocity", "world_velocity", "id", "stream"),
                           doc="What an EXR holds besides colour and alpha."),
    deep: bool = param(False, doc="Keep every fragment of every pixel, in an EXR."),
) -> None:
    """Draw."""
