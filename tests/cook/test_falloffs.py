"""A falloff of a graph's own reaches the picture."""

from __future__ import annotations

import pytest

from .effects import effect, graph


def test_a_graph_gives_its_ramp_to_the_picture():
    """What an image says of a falloff is what its particles show."""

    def alpha(falloff):
        emit = {"rate": 0, "count": 1, "set": {"radius": 1, "position": [0, 2, 0], "velocity": [0, 0, 0]}}
        document = graph([], emit, {"frames": [1, 1]})
        document["nodes"]["frames"]["from"] = {"stream": "sky", "falloff": falloff}
        return effect(document).film(1).pixels[..., 3]

    flat, linear = alpha({"ramp": [[0, 0.25]]}), alpha("linear")
    assert flat.max() == pytest.approx(0.25) and (flat > 0).sum() == (linear > 0).sum() > 10
