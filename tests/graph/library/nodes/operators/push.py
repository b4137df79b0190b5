"""Push: one parameter of each type that the others lack."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.assign(writes="position")
def push(
    position: Vec3,
    by: Vec3 = param(unit="m", required=True, doc="How far each time."),
    times: int = param(1, min=1, max=100, doc="How often."),
    mode: str = param("add", choices=("add", "replace"), doc="What becomes of the old position."),
    label: str = param("", doc="Any text."),
    back: bool = param(False, doc="Whether to push back."),
    tint: Vec3 = param((1, 1, 1), type="color", min=0, doc="A colour."),
    map: str = param("", type="path", doc="A file."),
    weights: list = param((), type="list", doc="Any numbers."),
    span: tuple = param((0.0, 1.0), type="interval", unit="s", doc="From when to when."),
) -> Vec3:
    """Return the position."""
    return position
