"""A whole effect flattens with the shape that its document says."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

from graphfx.graph.document import load_document
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root


def test_snow_is_a_chain_from_the_sky_to_the_ground(library: Library) -> None:
    """Operators of the stack and of the group inside it follow one another, each by its instance path."""
    flat = flatten(load_document(Path(__file__).parents[1] / "snow.json"), Library([*library.roots, bundled_root()]))
    chain = ["sky", "fall/spiral", "fall/gust/left", "fall/gust/right", "fall/bounce_plane"]
    assert [(node.path, node.sources) for node in flat.nodes.values()] == [
        ("sky", ()), *((path, (source,)) for source, path in pairwise(chain)),
        ("view", ()), ("frames", ("fall/bounce_plane",))]
