"""A graph document: its text, where it lies, and its JSON tree with places."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphfx.errors import GraphError, LimitError, Location, Problem
from graphfx.graph.items import Item
from graphfx.graph.limits import Limits
from graphfx.graph.reader import read


@dataclass(frozen=True, eq=False)
class Document:
    """A document that could be read; `problems` are the mistakes that could be read past.

    `file` is the name in messages; `folder`, where there is one, is where its groups and files are sought.
    """

    file: str
    root: Item
    folder: Path | None = None
    problems: tuple[Problem, ...] = ()
    limits: Limits = field(default_factory=Limits)

    @property
    def name(self) -> str:
        """Return the graph's name: its file's, without the ending."""
        return Path(self.file).name.split(".")[0] or "graph"

    @property
    def digest(self) -> str:
        """Return a hash of what the document says, whatever its layout."""
        text = json.dumps(self.root.data(), ensure_ascii=True, allow_nan=False)
        return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


def load_document(path: str | Path, limits: Limits | None = None) -> Document:
    """Read a graph's file; raise `GraphError` where it cannot be read as JSON at all."""
    limits = limits or Limits()
    path = Path(path)
    place = Location(str(path))
    try:
        if path.is_dir():
            raise GraphError(Problem("this is a folder; name a graph's file in it", place))
        with path.open("rb") as file:
            data = file.read(limits.bytes + 1)
    except FileNotFoundError:
        raise GraphError(Problem("there is no such file", place)) from None
    except (OSError, ValueError) as error:
        raise GraphError(Problem(f"the file cannot be read: {getattr(error, 'strerror', None) or error}", place)) from error
    if len(data) > limits.bytes:
        raise LimitError(Problem(f"the document has more than {limits.bytes:,} bytes, the limit; split it into groups, "
                                 "or raise the limit on bytes", place))
    return read_document(data, str(path), path.parent, limits)


def read_document(text: str | bytes, file: str = "graph.json", folder: str | Path | None = None,
                  limits: Limits | None = None) -> Document:
    """Read a graph from a text, as if it stood in `file`."""
    limits = limits or Limits()
    root, problems = read(text, file, limits)
    return Document(file, root, Path(folder) if folder is not None else None, tuple(problems), limits)


def document_of(data: Mapping[str, Any], file: str = "graph.json", folder: str | Path | None = None,
                limits: Limits | None = None) -> Document:
    """Read a graph from plain Python data, as if it had been written to `file`."""
    return read_document(json.dumps(data, indent=2), file, folder, limits)
