"""Letters in three dimensions: the outlines of a font, filled and extruded along z.

Text stands on the line y = 0 and looks towards +z, its depth half to either side. Each letter is a closed mesh.
A line break begins a new line below. Needs the extra `text`: pip install "graphfx[text]".
"""

from graphfx.geometry import Mesh, letters
from graphfx.node import geometry, param


@geometry
def mesh_text(
    text: str = param(type="string", required=True, doc="What is written."),
    size: float = param(1.0, unit="m", min=0, doc="Height of the font's em; a capital is about 0.73 of it."),
    depth: float = param(0.2, unit="m", min=0, doc="Thickness of the letters along z."),
    font: str = param("", type="path", doc="A TrueType or OpenType file; empty for the font that comes with graphfx."),
    align: str = param("center", choices=("left", "center", "right"), doc="Which part of each line stands at x = 0."),
    tracking: float = param(0.0, unit="em", doc="Space added between letters, as a part of the font's em."),
    curve_steps: int = param(6, min=1, max=64, doc="Straight pieces for each curve of an outline."),
) -> Mesh:
    """Return the text."""
    return letters(text, size, depth, font, align, tracking, curve_steps)
