"""Graphs in Python, which save to the same canonical JSON as graphs in files.

    g = graphfx.Graph(doc="Snow.", seed=7, fps=24, frames=(1, 120), preroll=6)
    sky = g.emit("sky", rate=4000, life=12, set={"position": g.in_box(min=(-8, 6, -8), max=(8, 7, 8))})
    fall = sky.stack("fall").spiral(speed=g.rand(2, 5)).bounce_plane(resilience=0, friction=1)
    fall.image("frames", camera=g.camera("view", position=(0, 2, 14)))
    g.save("snow.json")

Node types, values and groups are found by name when they are called. What a call adds is checked at once,
and complaints name the line of the call. `of=` is the key `from`, a word that Python keeps for itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphfx.authoring.draft import Draft
from graphfx.authoring.language import Language
from graphfx.authoring.nodes import Node, Stack, maker_of
from graphfx.authoring.places import fault, missing
from graphfx.errors import GraphError, Problem
from graphfx.graph.document import load_document
from graphfx.graph.format import canonical
from graphfx.graph.names import TIME_KEYS
from graphfx.node import Library, library_roots

if TYPE_CHECKING:
    from graphfx.cook.effect import Effect


class Graph(Language):
    """A graph under construction.

    `time` are the clock's settings: fps, frames, preroll, substeps, method, order, tolerance, precision. `name` is what
    its pictures are called, `folder` where its groups and files are sought, `library` further library roots.
    """

    def __init__(self, doc: str = "", *, seed: int | None = None, name: str = "graph", folder: str | Path | None = None,
                 library: Iterable[str | Path] = (), **time: Any):
        where = Path.cwd() if folder is None else Path(folder)
        self._draft = Draft(Library(library_roots(library)), f"{name}.json", where)
        unknown = [key for key in time if key not in TIME_KEYS]
        if unknown:
            raise fault(f"a graph has no setting '{unknown[0]}'.", TIME_KEYS, wrong=unknown[0],
                        notes=(f"Graph takes: doc, seed, name, folder, library, {', '.join(TIME_KEYS)}",))
        parts = {"doc": doc or None, "seed": seed, "time": time or None}
        self._draft.add({key: part for key, part in parts.items() if part is not None})

    @classmethod
    def load(cls, path: str | Path, library: Iterable[str | Path] = ()) -> Graph:
        """Return a graph's file as a graph under construction: add to it, and save it again."""
        document = load_document(path)
        if document.problems:
            raise GraphError(list(document.problems))
        graph = cls(name=document.name, folder=document.folder, library=library)
        graph._draft.data = document.root.data()
        return graph

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        return maker_of(self, name)

    def __getitem__(self, id: str) -> Node:
        """Return a node that the graph has."""
        if id not in self._draft.nodes:
            raise missing(f"there is no node '{id}'.", id, self._draft.nodes)
        node = self._draft.nodes[id]
        return (Stack if isinstance(node, dict) and node.get("type") == "stack" else Node)(self, id)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._draft.library, *self._draft.groups]

    def __repr__(self) -> str:
        return f"<graph of {len(self._draft.nodes)} nodes: {', '.join(self._draft.nodes)}>"

    def __str__(self) -> str:
        return self.text

    def node(self, type: str, id: str = "", /, **given: Any) -> Any:
        """Add a node of a type by its name: `g.node("vortex", "left")` is `g.vortex("left")`."""
        return maker_of(self, type)(id, **given)

    def problems(self) -> list[Problem]:
        """Return everything that is wrong with the graph so far, with the lines that wrote it."""
        return self._draft.problems()

    @property
    def data(self) -> dict[str, Any]:
        """The graph as JSON data."""
        data: dict[str, Any] = self._draft.document().root.data()
        return data

    @property
    def text(self) -> str:
        """The graph's canonical text, as `graphfx format` prints it."""
        return canonical(self._draft.document(), self._draft.library)

    def save(self, path: str | Path) -> Path:
        """Write the canonical text; raise GraphError with everything that is wrong with it there. Return the path."""
        from graphfx.output.atomic import whole_file

        found = self._draft.problems(Path(path).parent)
        if found:
            raise GraphError(found)
        with whole_file(str(path)) as stream:
            stream.write(self.text.encode())
        return Path(path)

    def effect(self, set: Mapping[str, Any] | None = None) -> Effect:
        """Return the effect, to cook or to take particles and pictures of; raise GraphError with everything that is wrong.

        `set` gives values to the graph's parameters.
        """
        from graphfx.cook.effect import Effect
        from graphfx.graph.flatten import flatten

        try:
            return Effect(flatten(self._draft.document(), self._draft.library, set))
        except GraphError as error:
            raise GraphError(self._draft.told(error.problems)) from None
