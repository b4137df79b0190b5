"""A document that grows: each part is checked by itself as it is added, and the whole when it is used."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from graphfx.authoring.places import Places, caller
from graphfx.authoring.values import plain
from graphfx.errors import GraphError, Problem
from graphfx.graph.check import check, check_part
from graphfx.graph.document import Document, document_of
from graphfx.node import Library

_WHOLE = ("nodes", "outputs", "expose")
"""What can be judged only beside all nodes."""


class Draft:
    """The JSON data of a graph under construction, and the lines of Python that wrote its parts."""

    def __init__(self, library: Library, file: str, folder: Path, data: dict[str, Any] | None = None):
        self.library, self.file, self.folder = library, file, folder
        self.data: dict[str, Any] = {"graphfx": 1} if data is None else data
        self.places = Places()
        self.places.note("", caller())

    @property
    def nodes(self) -> dict[str, Any]:
        """The nodes so far, by id."""
        nodes: dict[str, Any] = self.data.get("nodes", {})
        return nodes

    @property
    def groups(self) -> dict[str, str]:
        """The groups in use: their files by name."""
        groups: dict[str, str] = self.data.get("use", {})
        return groups

    def document(self, folder: Path | None = None) -> Document:
        """Return the whole as a document, which lies in a folder."""
        return document_of({**self.data, "nodes": self.nodes}, self.file, folder or self.folder)

    def problems(self, folder: Path | None = None) -> list[Problem]:
        """Return everything that is wrong with the whole as it lies in a folder, with the lines that wrote it."""
        return self.told(check(self.document(folder), self.library))

    def told(self, problems: list[Problem]) -> list[Problem]:
        """Return problems of the document with lines of Python instead of places in its text."""
        return self.places.told(problems, self.file)

    def add(self, parts: Mapping[str, Any]) -> None:
        """Put keys into the document, objects beside what they hold; raise GraphError for what is wrong by itself."""
        paths = [path for key, part in parts.items()
                 for path in ([f"{key}.{name}" for name in part] if isinstance(part, Mapping) else [key])]
        written = self._written(parts, "", paths)
        grown = {key: {**self.data.get(key, {}), **part} if isinstance(part, dict) else part for key, part in written.items()}
        self._settle(self.data | grown, paths, written.get("nodes", {}))

    def append(self, stack: str, operator: Mapping[str, Any]) -> None:
        """Put an operator at the end of a stack; raise GraphError for what is wrong with it."""
        before = self.nodes[stack]
        path = f"nodes.{stack}.ops[{len(before['ops'])}]"
        after = {**before, "ops": [*before["ops"], self._written(operator, path, [path])]}
        self._settle({**self.data, "nodes": {**self.nodes, stack: after}}, [path], {stack: after})

    def _written(self, given: Mapping[str, Any], path: str, paths: list[str]) -> dict[str, Any]:
        for each in paths:
            self.places.note(each, caller())
        data: dict[str, Any] = plain(given, path, self.places)
        return data

    def _settle(self, data: dict[str, Any], paths: list[str], nodes: dict[str, Any]) -> None:
        """Make `data` the document, unless something is wrong at or inside `paths`; `nodes` are those that changed."""
        named = set(_texts(nodes))
        beside = {id: node for id, node in data.get("nodes", {}).items() if id in named or id in nodes}
        part = {key: entry for key, entry in data.items() if key not in _WHOLE} | {"nodes": beside}
        found = check_part(document_of(part, self.file, self.folder), self.library)
        wrong = [problem for problem in found if any(f"{problem.path}.".startswith((f"{path}.", f"{path}[")) for path in paths)]
        if wrong:
            raise GraphError(self.told(wrong))
        self.data = data


def _texts(data: Any) -> Iterator[str]:
    """Yield every text in JSON data, as the id of a node that it may be."""
    if isinstance(data, str):
        yield data.partition(".")[0]
    elif isinstance(data, dict | list):
        for part in data.values() if isinstance(data, dict) else data:
            yield from _texts(part)
