"""Image: draw streams and polygons into one picture per frame.

An entry of `from` is the id of a `polygons` node or of one that makes a stream, or `{"stream": id, "blend": "over" |
"add", "falloff": "linear" | "gaussian" | "disc", "streak": "exposed" | "solid"}`; a falloff of one's own is
`{"ramp": [[0, 1], [0.8, 0.9], [1, 0]]}`, opacity over the distance from the centre over the radius. [Sims 1990, 4]

The shutter is open from phase + shutter to phase frames before the frame's time: with a shutter of 1.2 streaks overlap from
frame to frame, and with a phase of 0.25 a shutter of 0.5 is open around half a frame before. Ways bend at hits, begin at
births and end at deaths; of more than eight hits of a particle in a frame the first ones and the last are exact. (The
method `sims` bounces at the ends of steps, where ways do not bend.) Colours and radii are those of the frame's time, unless
the tail has its own. Nothing is seen of what comes after the frame, so a phase is never negative.

The end of `file` says the format. A PNG has the background in it, and shows light as `display` says: `srgb` clips
what is beyond 1, `filmic` rolls it off towards white at 10 (Narkowicz's fit of the ACES curve; middle grey
stays), `raw` is the light itself, clipped. An EXR (extra `exr`; deep ones without) holds light as it is, multiplied by
alpha, which it keeps unless a background is stated. A background picture fills the frame, its proportions kept, and
is cut where it is longer. Where a `movie` takes the pictures, they are files of their own only if `file` is stated.

`channels` of an EXR are `depth` (Z, m along the camera's axis, of the nearest of what is seen; 1e30 where nothing is), and
of the particle that is seen most in a pixel: `velocity` (.X .Y, pixels a frame on the screen, Y upwards), `world_velocity`
(.X .Y .Z, m/s), `id` and `stream` (whole numbers; the streams of `from`, from 1 on); all 0 where polygons are seen, or nothing.
Velocities are means over the shutter, or over half a frame where it stays shut. A `deep` EXR has instead every fragment
with its depth, id and such channels; flattened, it is the picture without background.
"""

from graphfx.math import Vec3
from graphfx.node import language, param


@language("image", "renders")
def image(
    camera: str = param(type="node", choices=("camera",), required=True, doc="The camera that it is seen through."),
    size: list = param((1280, 720), type="list", min=1, max=65536, doc="Width and height in pixels."),
    shutter: float = param(0.5, unit="frames", min=0, max=4, doc="How long the shutter is open; 0 draws no streaks."),
    phase: float = param(0.0, unit="frames", min=0, max=4, doc="How long before the frame's time the shutter closes."),
    background: Vec3 = param((0, 0, 0), type="color", min=0, doc="Colour behind the particles."),
    background_image: str = param("", type="path", doc="A picture behind the particles, cut to the frame's shape."),
    transparent: bool = param(False, doc="Leave the background out and keep the picture's alpha."),
    lights: list = param((), type="nodes", choices=("light",), doc="Lights on polygons; none: one from over the shoulder."),
    ambient: Vec3 = param((0.15, 0.15, 0.15), type="color", min=0, doc="Light on polygons from all sides."),
    cutoff: float = param(0.0, min=0, max=0.5, doc="Leave out what is behind particles that let less light through; 0 is exact."),
    exposure: float = param(0.0, unit="stops", min=-30, max=30, doc="The picture's light is scaled by 2 to this power."),
    display: str = param("srgb", choices=("srgb", "filmic", "raw"), doc="How light becomes the numbers of a PNG."),
    file: str = param("{graph}.####.png", doc="Name of the files, .png or .exr; #### is the frame and {graph} the graph's name."),
    bits: int = param(choices=("8", "16", "32"), doc="Bits of a number: PNG 8 (default) or 16, EXR 16 (default) or 32."),
    channels: list = param((), type="list", choices=("depth", "velocity", "world_velocity", "id", "stream"),
                           doc="What an EXR holds besides colour and alpha."),
    deep: bool = param(False, doc="Keep every fragment of every pixel, in an EXR."),
) -> None:
    """Draw."""
