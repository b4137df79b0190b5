"""What keeps a method from being chosen is told where it was asked for."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from graphfx.cook.effect import load
from graphfx.errors import GraphError

GRAPH = {
    "graphfx": 1,
    "time": {"frames": [1, 2], "method": "exact"},
    "nodes": {
        "sky": {"type": "emit"},
        "act": {"type": "stack", "from": "sky", "ops": [{"type": "vortex"}, {"type": "gravity"}]},
        "view": {"type": "camera"},
        "frames": {"type": "image", "from": "act", "camera": "view"},
    },
}


def test_a_method_that_cannot_be_is_told_where_it_is_asked_for(tmp_path: Path):
    """The message has the line and the column of time.method."""
    file = tmp_path / "two.json"
    file.write_text(json.dumps(GRAPH, indent=2))
    with pytest.raises(GraphError) as caught:
        _ = load(file).plan
    line = 1 + file.read_text().splitlines().index('    "method": "exact"')
    assert str(caught.value) == (
        f"{file}:{line}:15: time.method: there is no exact solution for vortex, gravity together; choose 'auto' or 'adaptive'"
    )
