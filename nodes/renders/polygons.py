"""Polygons: the triangles of a mesh, drawn among the particles.

    colour = color map light,    light = ambient + sum of light colour max(n . l, 0)    (Lambert; l points to the light)

An image draws them where its `from` names this node. They are sorted with the particles in every pixel, any number of
transparent layers; what has an opacity of exactly 1 hides all behind it and costs the least. Colour and opacity may
change with time, and the mesh stands where its transform puts it as the shutter closes: polygons have no motion blur, and
are sharp wherever the camera's focus is.
The alpha of a colour map multiplies the opacity. Maps repeat, unless they are clamped; they lie on a mesh as its
coordinates say, which all shapes have and files may have. [Sims 1990, 4]
Smooth light goes round an edge up to 50 degrees between its faces; a sharper edge stays one. A file's own normals stay.
"""

from graphfx.math import Vec3
from graphfx.node import language, param


@language("polygons", "renders")
def polygons(
    geometry: str = param(type="mesh", required=True, doc="The mesh whose triangles are drawn."),
    color: Vec3 = param((1, 1, 1), type="color", min=0, doc="Its colour, by which a colour map is multiplied."),
    opacity: float = param(1.0, min=0, max=1, doc="1 hides what is behind, 0 is not there; multiplies an opacity map."),
    shading: str = param("flat", choices=("flat", "smooth", "unlit"), doc="Lit by face, lit as if round, or bright by itself."),
    color_map: str = param("", type="path", doc="A picture of its colour, in sRGB; 16 bits where it is grey, floats as light."),
    opacity_map: str = param("", type="path", doc="A picture of its opacity: its alpha, or where it has none how light it is."),
    wrap: str = param("repeat", choices=("repeat", "clamp"), doc="Beyond a map's border: the map again, or its border."),
    double_sided: bool = param(True, doc="Whether triangles are seen from behind too, lit as from the front."),
) -> None:
    """Draw."""
