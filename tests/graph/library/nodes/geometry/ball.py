"""A geometry for the tests of the language, which make none."""

from graphfx.node import language, param


@language("geometry", "geometry")
def ball(size: float = param(1.0, unit="m", min=0, doc="Its size.")) -> None:
    """Make nothing."""
