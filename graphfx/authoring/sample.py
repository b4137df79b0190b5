"""A small graph in which a node type does its work, made from its declaration."""

from __future__ import annotations

import re
from typing import Any

from graphfx.graph.names import PICTURES
from graphfx.node import NUMERIC_TYPES, Library, NodeType, Parameter

_TINTED = {"set": {"color": [1, 0.4, 0.1]}}
_BY_ROLE: dict[str, dict[str, Any]] = {
    "set": _TINTED, "fade": _TINTED,
    "kill": {"only": {"expr": "position.y > 1.5"}}, "recycle": {"when": "step", "only": {"expr": "position.y > 1.5"}},
    "spawn": {"when": "death", "count": 8, "spread": 1},
}
"""What nodes of the language are given, where nothing but a use of theirs makes sense."""
_REFERENCES = ("node", "nodes", "mesh", "surface", "selector", "stream")


class Sample:
    """A graph that grows around one node type."""

    def __init__(self, node_type: NodeType, library: Library):
        self.library = library
        self.source: dict[str, Any] = {"type": "emit", "rate": 200, "life": 1.5,
                                       "set": {"position": {"in_sphere": {"radius": 1}}, "velocity": [0, 1, 0]}}
        self.nodes: dict[str, Any] = {"source": self.source}
        self.seen = "source"
        self.drawn_by = "image"
        self.drawn: list[str] = []
        self.looks: dict[str, Any] = {}
        self.after: dict[str, Any] = {}
        """Nodes that take the image."""
        build = getattr(self, f"_{node_type.kind}", None)
        if build is not None:
            build(node_type)

    def graph(self) -> dict[str, Any]:
        """Return the graph as JSON data."""
        self.nodes["view"] = {"type": "camera", "position": [0, 1, 8], "target": [0, 1, 0]}
        self.nodes["frames"] = {"type": self.drawn_by, "from": self.drawn or self.seen, "camera": "view", "size": [640, 360],
                                **self.looks}
        self.nodes |= self.after
        return {"graphfx": 1, "time": {"frames": [1, 48]}, "nodes": self.nodes}

    def _values(self, node_type: NodeType) -> None:
        value = {node_type.name: self._given(node_type)}
        if node_type.reads:
            kept = "color" if node_type.result[0] == "vec3" else "mass"
            self.nodes["motion"] = {"type": "stack", "from": "source", "ops": [{"type": "set", "set": {kept: value}}]}
            self.seen = "motion"
        elif node_type.result[0] == "vec3":
            self.source["set"] = {"position": value}
        else:
            self.source["values"] = {"drawn": value}
            passes = "2 if drawn else 1" if node_type.result[0] == "bool" else "drawn"
            self.source["set"]["velocity"] = {"expr": f"vec(0, {passes}, 0)"}

    def _operators(self, node_type: NodeType) -> None:
        ops = [{"type": node_type.name, **self._given(node_type)}]
        if node_type.role == "stack":
            ops = [{"type": "gravity"}, {"type": "vortex"}]
        self.nodes["motion"] = {"type": "stack", "from": "source", "ops": ops}
        self.seen = "motion"

    def _selectors(self, node_type: NodeType) -> None:
        if "hits" in node_type.reads:
            self.nodes["motion"] = {"type": "stack", "from": "source", "ops": [{"type": "gravity"}, {"type": "bounce_plane"}]}
            self.seen = "motion"
        self.nodes["chosen"] = {"type": node_type.name, "from": self.seen, **self._given(node_type)}
        self.seen = "chosen"

    def _emitters(self, node_type: NodeType) -> None:
        if node_type.role != "emit":
            self.nodes["made"] = {"type": node_type.name, "from": "source", **self._given(node_type)}
            self.seen = "made"

    def _renders(self, node_type: NodeType) -> None:
        if node_type.role in PICTURES:
            self.drawn_by = node_type.name
        elif node_type.role == "polygons":
            self.nodes["drawn"] = {"type": node_type.name, **self._given(node_type)}
            self.drawn = [self.seen, "drawn"]
        elif node_type.role == "light":
            self.nodes["light"] = {"type": node_type.name}
            self._renders(self.library["polygons"])
            self.looks["lights"] = ["light"]
        elif node_type.role == "movie":
            self.after["movie"] = {"type": node_type.name, "image": "frames", "file": "{graph}.webp"}

    def _geometry(self, node_type: NodeType) -> None:
        self.nodes["shape"] = {"type": node_type.name, **self._given(node_type)}
        users = [user for name in self.library if self.library.kind_of(name) == "values" and (user := self.library[name])
                 and any(parameter.type == "mesh" for parameter in user.parameters.values())]
        if users:
            self._values(min(users, key=lambda user: "draw" not in user.reserved))

    def _given(self, node_type: NodeType) -> dict[str, Any]:
        """Return the parameters to state: required ones, and one where the defaults do nothing."""
        stated = {parameter.name: self._one(parameter) for parameter in node_type.parameters.values() if parameter.required}
        stated |= _BY_ROLE.get(node_type.role, {}) if node_type.language else {}
        decisive = [parameter for name, parameter in node_type.parameters.items()
                    if re.search(rf"\b{name}\b", node_type.neutral)]
        if decisive and not stated and not any(map(_differs_from_zero, decisive)):
            stated[decisive[0].name] = example(decisive[0])
        return stated

    def _one(self, parameter: Parameter) -> Any:
        """Return what a required parameter is given; a node that it names is added to the graph."""
        if parameter.type == "path":
            return self._file() or parameter.name
        if parameter.type not in _REFERENCES:
            return example(parameter)
        wanted = parameter.choices or [name for name in self.library if self.library.kind_of(name) == "geometry"
                                       and not any(p.required for p in self.library[name].parameters.values())]
        if not wanted or parameter.choices == ("camera",):
            return parameter.name
        if "shape" not in self.nodes:
            self.nodes["shape"] = {"type": wanted[0]}
        return "shape"

    def _file(self) -> str:
        """Return the smallest mesh of a library, as a graph would name it."""
        found = [(file.stat().st_size, file.relative_to(root / "graphs").as_posix())
                 for root in self.library.roots for file in (root / "graphs" / "meshes").glob("*.obj")]
        return min(found, default=(0, ""))[1]


def sample(node_type: NodeType, library: Library) -> dict[str, Any]:
    """Return a small graph in which a node type does its work."""
    return Sample(node_type, library).graph()


def _differs_from_zero(parameter: Parameter) -> bool:
    return any(parameter.default) if isinstance(parameter.default, tuple) else bool(parameter.default)


def example(parameter: Parameter) -> Any:
    """Return a value that a parameter takes, and that is not zero where it need not be."""
    if parameter.choices:
        return parameter.choices[0]
    if parameter.type == "color":
        return [1, 0.4, 0.1]
    if NUMERIC_TYPES.get(parameter.type) == 3:
        return [1, 0, 0]
    if parameter.type == "bool":
        return True
    low = float("-inf") if parameter.min is None else parameter.min
    high = float("inf") if parameter.max is None else parameter.max
    if parameter.type in ("interval", "list"):
        return list(parameter.default or ((0, 1) if parameter.type == "interval" else (0, 1, 0)))
    value = min(max(1.0, low), high)
    whole = int(value) if value.is_integer() else value
    return whole if parameter.type in NUMERIC_TYPES else parameter.name
