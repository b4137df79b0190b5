"""What `graphfx nodes` prints: all of it from the node's own file."""

from __future__ import annotations

import json
import re
from itertools import groupby
from pathlib import Path
from typing import Any

from graphfx.graph.document import document_of
from graphfx.graph.format import canonical
from graphfx.node import INFINITY, NUMERIC_TYPES, Library, NodeType, Parameter


def first_line(node_type: NodeType) -> str:
    """Return a node type's summary: the first line of its file's docstring."""
    return node_type.doc.strip().splitlines()[0]


def table(library: Library) -> str:
    """Return all node types by kind, a line each."""
    width = max(len(name) for name in library)
    lines: list[str] = []
    for kind, names in groupby(sorted(library, key=lambda name: (library.kind_of(name), name)), key=library.kind_of):
        lines += ["", kind, *(f"  {name:{width}}  {first_line(library[name])}" for name in names)]
    return "\n".join([*lines[1:], "", "'graphfx nodes NAME' says all about one."])


def describe(node_type: NodeType, library: Library) -> str:
    """Return everything about a node type."""
    parts = [f"{node_type.name} ({node_type.kind}, {role(node_type)})", "", node_type.doc.strip(), ""]
    if node_type.parameters:
        parts += ["Parameters", *parameter_lines(node_type.parameters), ""]
    facts = [("reads", ", ".join(node_type.reads)), ("writes", ", ".join(node_type.writes)),
             ("gives", ", ".join(node_type.result) if node_type.kind == "values" else ""),
             ("left out when", node_type.neutral), ("declared in", shown_path(node_type.location.file))]
    parts += [f"{name}: {text}" for name, text in facts if text]
    return "\n".join([*parts, "", "A graph that runs", "", canonical(document_of(sample(node_type)), library).rstrip()])


def shown_path(file: str) -> str:
    """Return a file's path as one would type it here: relative where it lies below the current folder."""
    path = Path(file)
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else file


def role(node_type: NodeType) -> str:
    """Return how the engine treats a node type, in words."""
    return "part of the language" if node_type.language else node_type.role


def parameter_lines(parameters: dict[str, Parameter]) -> list[str]:
    """Return a table of parameters: name with unit, type, default, range, and what it means."""
    rows = [(parameter.label, parameter.type, default_text(parameter), range_text(parameter))
            for parameter in parameters.values()]
    widths = [max(len(row[k]) for row in rows) for k in range(4)]
    return ["  " + "  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)) + f"  {parameter.doc}"
            for row, parameter in zip(rows, parameters.values(), strict=True)]


def default_text(parameter: Parameter) -> str:
    """Return a default as a graph would state it."""
    if parameter.required or parameter.default is None:
        return "required" if parameter.required else "none"
    return json.dumps(_plain(parameter.default)).replace("Infinity", '"infinity"')


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def range_text(parameter: Parameter) -> str:
    """Return what a parameter may be, where that is limited."""
    if parameter.choices:
        return " | ".join(parameter.choices)
    low, high = (None if bound is None else f"{bound:g}" for bound in (parameter.min, parameter.max))
    if low is not None and high is not None:
        return f"{low} to {high}"
    return f"at least {low}" if low is not None else f"at most {high}" if high is not None else ""


def sample(node_type: NodeType) -> dict[str, Any]:
    """Return a small graph in which a node type does its work."""
    source: dict[str, Any] = {"type": "emit", "rate": 200, "life": 2,
                              "set": {"position": {"in_sphere": {"radius": 1}}, "velocity": [0, 1, 0]}}
    nodes: dict[str, Any] = {"source": source}
    ops: list[dict[str, Any]] = []
    if node_type.kind == "values":
        if node_type.result[0] == "vec3":
            source["set"]["position"] = {node_type.name: given(node_type)}
        else:
            source |= {"values": {"speed": {node_type.name: given(node_type)}}}
            source["set"]["velocity"] = {"expr": "vec(0, speed, 0)"}
    elif node_type.role == "stack":
        ops = [{"type": "gravity"}, {"type": "vortex"}]
    elif node_type.kind == "operators":
        ops = [{"type": node_type.name, **given(node_type)}]
    elif node_type.kind == "selectors":
        nodes["chosen"] = {"type": node_type.name, "from": "source", **given(node_type)}
    if ops:
        nodes["motion"] = {"type": "stack", "from": "source", "ops": ops}
    seen = list(nodes)[-1]
    nodes["view"] = {"type": "camera", "position": [0, 1, 8], "target": [0, 1, 0]}
    nodes["frames"] = {"type": "image", "from": [seen], "camera": "view", "size": [640, 360]}
    return {"graphfx": 1, "time": {"frames": [1, 48]}, "nodes": nodes}


def given(node_type: NodeType) -> dict[str, Any]:
    """Return the parameters that a sample must state: required ones, and one where the defaults do nothing."""
    stated = {name: example(parameter) for name, parameter in node_type.parameters.items() if parameter.required}
    decisive = [parameter for name, parameter in node_type.parameters.items() if re.search(rf"\b{name}\b", node_type.neutral)]
    if decisive and not stated and not any(map(_differs_from_zero, decisive)):
        stated[decisive[0].name] = example(decisive[0])
    return stated


def _differs_from_zero(parameter: Parameter) -> bool:
    return any(parameter.default) if isinstance(parameter.default, tuple) else bool(parameter.default)


def example(parameter: Parameter) -> Any:
    """Return a value that a parameter takes, and that is not zero where it need not be."""
    if parameter.choices:
        return parameter.choices[0]
    if NUMERIC_TYPES.get(parameter.type) == 3:
        return [1, 0, 0]
    if parameter.type == "bool":
        return True
    low = -INFINITY if parameter.min is None else parameter.min
    high = INFINITY if parameter.max is None else parameter.max
    return _plain(min(max(1.0, low), high)) if parameter.type in NUMERIC_TYPES else parameter.name
