"""What `graphfx nodes` prints of groups: all of it from their own files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from graphfx.cli.node_docs import parameter_data, parameter_lines, parameter_words
from graphfx.errors import GraphfxError
from graphfx.graph.check_document import read_graph
from graphfx.graph.check_streams import walk
from graphfx.graph.checking import Checking
from graphfx.graph.document import document_of, load_document
from graphfx.graph.format import canonical
from graphfx.graph.model import Graph
from graphfx.node import Library


@dataclass(frozen=True)
class Group:
    """A group of a library: the path by which a graph names it, and what it says."""

    path: str
    graph: Graph

    @property
    def name(self) -> str:
        """Return its file's name."""
        return self.graph.name

    @property
    def summary(self) -> str:
        """Return the first sentence of its doc."""
        return self.graph.doc.split(". ")[0].rstrip(".") + "."


def groups_of(library: Library) -> dict[str, Group]:
    """Return the groups of all library roots by name; a file that is wrong is none."""
    return {group.name: group for group in _found(library)}


def _found(library: Library) -> Iterator[Group]:
    for root in reversed(library.roots):
        for file in sorted((root / "graphs" / "groups").rglob("*.json")):
            checking = Checking(library)
            try:
                graph = read_graph(load_document(file), checking)
            except GraphfxError:
                continue
            if graph.outputs and not checking.problems:
                yield Group(file.relative_to(root / "graphs").as_posix(), graph)


def group_lines(groups: dict[str, Group]) -> list[str]:
    """Return the groups, a line each."""
    width = max(map(len, groups), default=0)
    return [f"{name:{width}}  {groups[name].summary}" for name in sorted(groups)]


def group_texts(groups: dict[str, Group]) -> dict[str, tuple[str, ...]]:
    """Return, of each group, its summary, its doc, and those of its parameters."""
    return {name: (group.summary, group.graph.doc, parameter_words(group.graph.params)) for name, group in groups.items()}


def describe_group(group: Group, library: Library) -> str:
    """Return everything about a group."""
    graph = group.graph
    parts = [f"{group.name} (group {group.path})", "", graph.doc, ""]
    if graph.params:
        parts += ["Parameters", *parameter_lines(graph.params), ""]
    parts += [f"{name}: {', '.join(streams)}" for name, streams in (("takes", graph.inputs), ("gives", graph.outputs)) if streams]
    text = canonical(document_of(group_sample(group)), library)
    return "\n".join([*parts, "", "A graph that runs", "", text.rstrip()])


def group_data(group: Group) -> dict[str, Any]:
    """Return everything about a group as JSON data."""
    graph = group.graph
    return {"name": group.name, "kind": "group", "use": group.path, "doc": graph.doc, "parameters": parameter_data(graph.params),
            "inputs": list(graph.inputs), "outputs": list(graph.outputs), "sample": group_sample(group)}


def group_sample(group: Group) -> dict[str, Any]:
    """Return a small graph in which a group does its work."""
    graph = group.graph
    nodes: dict[str, Any] = {}
    source = {"type": "emit", "rate": 200, "life": 1.5, "set": {"position": {"in_sphere": {"radius": 1}}, "velocity": [0, 1, 0]}}
    taken = "source"
    if graph.inputs:
        nodes["source"] = source
    if any(entry.when == "hit" for entry in walk(graph)):
        taken, floor = "fall", {"type": "bounce_plane", "point": [0, -1, 0]}
        nodes["fall"] = {"type": "stack", "from": "source", "ops": [{"type": "gravity"}, floor]}
    nodes["made"] = {"type": group.name, **({"inputs": dict.fromkeys(graph.inputs, taken)} if graph.inputs else {})}
    if len(graph.inputs) == 1:
        nodes["made"] = {"type": group.name, "from": taken}
    if meshes := [name for name, parameter in graph.params.items() if parameter.type == "mesh" and parameter.required]:
        nodes["shape"] = {"type": "mesh_box"}
        nodes["made"] |= dict.fromkeys(meshes, "shape")
    seen = ["made"] if len(graph.outputs) == 1 else [f"made.{port}" for port in graph.outputs]
    nodes["view"] = {"type": "camera", "position": [0, 1, 8], "target": [0, 1, 0]}
    nodes["frames"] = {"type": "image", "from": seen, "camera": "view", "size": [640, 360]}
    return {"graphfx": 1, "time": {"frames": [1, 48]}, "use": {group.name: group.path}, "nodes": nodes}
