"""Movie: the pictures of an image as one file, played at the graph's frames per second.

The suffix of `file` says what it is: .mp4 is H.264 (plays everywhere; even sizes), .mov ProRes, for editing (4444 with alpha
where the image is transparent), .webp an animated WebP, .png an animated PNG without loss. The first two need
`pip install 'graphfx[video]'`. An image whose pictures a movie takes keeps stills too only if it states its own `file`.
"""

from graphfx.node import language, param


@language("movie", "renders")
def movie(
    image: str = param(type="node", choices=("image", "preview"), required=True, doc="The image whose pictures it takes."),
    file: str = param("{graph}.mp4", doc="Name of the file, {graph} the graph's name: .mp4, .mov, .webp or .png."),
    quality: float = param(80.0, min=0, max=100, doc="How good the pictures are, in .mp4 and .webp; at 100 .webp loses nothing."),
) -> None:
    """Write."""
