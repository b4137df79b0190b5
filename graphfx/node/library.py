"""Find node types: load `nodes/<kind>/<name>.py` of every library root by path.

Nothing called `nodes` becomes importable: a file is a module named
`graphfx_nodes.<library>.<kind>.<name>`.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from types import ModuleType

from graphfx.errors import Location, NodeError, Problem
from graphfx.node.mistakes import PREFIX, in_file
from graphfx.node.types import NodeType

KINDS = ("emitters", "selectors", "operators", "renders", "values", "geometry")


def bundled_root() -> Path:
    """Return the library root that comes with graphfx: inside the package when installed, else the checkout."""
    package = Path(__file__).resolve().parent.parent
    inside = package / "bundled"
    return inside if inside.is_dir() else package.parent


def library_roots(extra: Iterable[str | Path] = ()) -> list[Path]:
    """Return all library roots: given ones, those of GRAPHFX_PATH, the bundled one last; the first wins a name."""
    named = [Path(part) for part in os.environ.get("GRAPHFX_PATH", "").split(os.pathsep) if part]
    roots = [*(Path(root) for root in extra), *named]
    for root in roots:
        if not (root / "nodes").is_dir() and not (root / "graphs").is_dir():
            raise NodeError(Problem(f"the library folder {root} has neither 'nodes' nor 'graphs' in it", Location(str(root))))
    return [*roots, bundled_root()]


class Library(Mapping[str, NodeType]):
    """The node types of some roots, by name; a file is executed only when its type is asked for."""

    def __init__(self, roots: Iterable[str | Path] | None = None):
        self.roots = list(map(Path, roots)) if roots is not None else library_roots()
        self._files: dict[str, tuple[str, Path]] = {}
        self._types: dict[str, NodeType] = {}
        for root in self.roots:
            for kind in KINDS:
                for file in sorted((root / "nodes" / kind).glob("*.py")):
                    if not file.name.startswith("_"):
                        self._files.setdefault(file.stem, (kind, file))

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def __contains__(self, name: object) -> bool:
        return name in self._files

    def __getitem__(self, name: str) -> NodeType:
        if name not in self._types:
            self._types[name] = self._load(*self._files[name])
        return self._types[name]

    def kind_of(self, name: str) -> str:
        """Return the kind of a node type without executing its file."""
        return self._files[name][0]

    @cached_property
    def other_names(self) -> dict[str, str]:
        """What other tools call our node types: the lines "Also called: ..." of their docs; an earlier place counts more."""
        found: dict[str, tuple[int, str]] = {}
        for name in sorted(self):
            try:
                doc = self[name].doc
            except NodeError:
                continue
            said = re.search(r"^Also called: (.+?)\.?$", doc, re.MULTILINE)
            for place, other in enumerate(said[1].split(", ") if said else ()):
                key = other.strip().lower().replace(" ", "_")
                found[key] = min(found.get(key, (place, name)), (place, name))
        return {other: name for other, (_, name) in found.items()}

    def _load(self, kind: str, file: Path) -> NodeType:
        module = _execute(file, kind)
        function = getattr(module, file.stem, None)
        node_type = getattr(function, "node_type", None)
        if node_type is None:
            raise NodeError(Problem(f"it has no decorated function named '{file.stem}'", Location(str(file), 1), file.stem,
                                    ("a node is one function with the file's name under a decorator such as @operator.flow",)))
        if node_type.kind != kind:
            raise NodeError(Problem(f"its decorator makes it one of the {node_type.kind}, but it lies in nodes/{kind}; "
                                    f"move it to nodes/{node_type.kind}", node_type.location, file.stem))
        return node_type


def _execute(file: Path, kind: str) -> ModuleType:
    root = hashlib.blake2b(str(file.parent.resolve()).encode(), digest_size=4).hexdigest()
    name = f"{PREFIX}{root}.{kind}.{file.stem}"
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except NodeError:
        raise
    except Exception as error:
        raise in_file(error, file) from error
    return module
