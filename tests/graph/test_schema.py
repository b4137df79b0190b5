"""The JSON Schema: right graphs validate, and mistakes that an editor can see do not."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from graphfx.graph.schema import schema
from graphfx.node import Library, bundled_root

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def validator(library: Library) -> Draft202012Validator:
    """A validator of graphs over the tests' node types."""
    made = schema(library)
    Draft202012Validator.check_schema(made)
    return Draft202012Validator(json.loads(json.dumps(made, allow_nan=False)))


@pytest.mark.parametrize("path", [HERE / "good/everything.json", *sorted((HERE / "good/groups").glob("*.json")),
                                  *sorted((HERE / "bad/groups").glob("*.json"))], ids=lambda path: path.stem)
def test_right_graphs_validate(path: Path, validator: Draft202012Validator) -> None:
    """Whatever the checks accept, the schema accepts."""
    assert [error.message for error in validator.iter_errors(json.loads(path.read_text()))] == []


GOOD: dict[str, Any] = {"graphfx": 1, "nodes": {
    "sky": {"type": "emit", "rate": 3, "set": {"radius": {"rand": [1, 2]}}},
    "fall": {"type": "stack", "from": "sky", "ops": [{"type": "vortex", "tightness": 2, "axis": [0, 1, 0]}]},
    "view": {"type": "camera"}, "frames": {"type": "image", "from": "fall", "camera": "view"}}}


@pytest.mark.parametrize(("path", "value"), [
    ("graphfx", 2), ("parms", {}), ("seed", -1), ("time", {"fsp": 24}), ("params", {"a": {"type": "number"}}),
    ("nodes/2nd", {"type": "emit"}),
    ("nodes/sky/rate", -1), ("nodes/sky/rate", "fast"), ("nodes/sky/rate", [1, 2]), ("nodes/sky/rat", 1),
    ("nodes/sky/from", "sky"),
    ("nodes/sky/set/colour", "#ffffff"), ("nodes/sky/set/color", "red"), ("nodes/sky/set/radius", {"rnd": [1, 2]}),
    ("nodes/sky/set/radius", {"rand": [1, 2, 3]}), ("nodes/sky/set/radius", {"rand": [1, 2], "per": "by day"}),
    ("nodes/sky/set/radius", {"in_box": {}}), ("nodes/sky/set/position", {"in_box": {"mni": [0, 0, 0]}}),
    ("nodes/sky/set/radius", {"rand": [1, 2], "expr": "1"}), ("nodes/sky/set/radius", {"height": {}}),
    ("nodes/fall/ops/0/tightness", 9), ("nodes/fall/ops/0/tightnes", 1), ("nodes/fall/ops/0/axis", [0, 1]),
    ("nodes/fall/ops/0/from", "sky"),
    ("nodes/fall/ops/0/when", "birth"), ("nodes/fall/ops/0", {"type": "push"}), ("nodes/fall/ops", {}), ("nodes/fall",
    {"from": "sky", "ops": []}),
    ("nodes/view/id", "eye"), ("nodes/view/projection", "flat"), ("nodes/frames/camera", 3), ("nodes/frames/from", []),
    ("nodes/frames/from", [{"stream": "fall", "blend": "ad"}]), ("nodes/frames/size", [1280]),
    ("nodes/frames", {"type": "image", "from": "fall"}),
    ("attributes", {"heat": {"type": "number"}}), ("attributes", {"heat": {"default": 1}}), ("nodes/sky/clusters", {"a": {}}),
    ("nodes/sky/clusters", {"a": {"count": 0}}), ("nodes/sky/clusters", {"a": {"count": 3, "by": "nearer"}}),
    ("nodes/sky/set/age", 1), ("nodes/sky/set/tail.radius", 1), ("nodes/fall/only", {"all": []}),
    ("nodes/fall/only", {"nt": "a"}),
    ("nodes/fall/only", {"above": {"hight": 3}}), ("nodes/view", {"type": "spawn", "from": "sky", "when": "step"}),
    ("nodes/view", {"type": "spawn", "from": "sky", "when": {"hit": []}}), ("nodes/view", {"type": "fade", "from": "sky"}),
    ("nodes/view", {"type": "kill", "from": "sky", "when": "death"}), ("nodes/sky/count", 1.5),
    ("nodes/sky/set/radius", {"ramp": [[0, 1]], "interpolation": "cubic"}),
])
def test_typed_mistakes_do_not_validate(path: str, value: Any, validator: Draft202012Validator) -> None:
    """An editor that knows the schema shows the mistake while it is typed."""
    data = copy.deepcopy(GOOD)
    assert validator.is_valid(data)
    *outer, last = path.split("/")
    place: Any = data
    for part in outer:
        place = place[int(part) if isinstance(place, list) else part]
    place[int(last) if isinstance(place, list) else last] = value
    assert not validator.is_valid(data)


def test_parameters_carry_doc_unit_range_and_default(library: Library) -> None:
    """Editors can show all that the declaration says."""
    tightness = schema(library)["$defs"]["type_vortex"]["properties"]["tightness"]
    assert (tightness["description"], tightness["default"]) == ("How quickly the rate falls with R; 1 to 2 is usual.", 1.5)
    assert {"type": "number", "minimum": 0, "maximum": 8} in tightness["anyOf"]
    assert schema(library)["$defs"]["type_vortex"]["properties"]["center"]["description"] == "Any point on the axis. [m]"


def test_shipped_graphs_validate() -> None:
    """Every graph of the library validates against the schema of the library."""
    validator = Draft202012Validator(schema(Library([bundled_root()])))
    for path in sorted((bundled_root() / "graphs").rglob("*.json")):
        assert [error.message for error in validator.iter_errors(json.loads(path.read_text()))] == []


@pytest.mark.parametrize(("node", "valid"), [
    ({"type": "preview", "from": "fall", "camera": "view"}, True),
    ({"type": "preview", "from": [{"stream": "fall", "blend": "add"}], "camera": "view", "size": [320, 180], "shutter": 2}, True),
    ({"type": "preview", "from": "fall"}, False), ({"type": "preview", "camera": "view", "radius": 1}, False),
    ({"type": "movie", "image": "frames", "file": "a.webp", "quality": 50}, True), ({"type": "movie"}, False),
    ({"type": "movie", "image": "frames", "quality": 101}, False), ({"type": "movie", "image": "frames", "from": "fall"}, False),
])
def test_previews_and_movies(node: dict[str, Any], valid: bool) -> None:
    """The nodes that draw quickly and that make movies are checked as they declare themselves."""
    nodes = {"sky": {"type": "emit"}, "fall": {"type": "stack", "from": "sky", "ops": []}, "view": {"type": "camera"},
             "frames": {"type": "image", "from": "fall", "camera": "view"}, "new": node}
    validator = Draft202012Validator(schema(Library([bundled_root()])))
    assert validator.is_valid({"graphfx": 1, "nodes": nodes}) == valid
