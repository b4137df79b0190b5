"""Nodes in Python, and what a name of the library makes when it is called: a node, an operator of a stack, or a value."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from graphfx.authoring.places import fault, missing
from graphfx.authoring.values import Reference, Value
from graphfx.graph.checking import declared, takes
from graphfx.node import NodeType

if TYPE_CHECKING:
    from graphfx.authoring.graph import Graph


class Node(Reference):
    """A node of a graph.

    Its methods are the library's node types and the groups in use: each makes a node that takes this one's stream.
    `node["port"]` is one output of a group.
    """

    def __init__(self, graph: Graph, id: str):
        super().__init__(id)
        self._graph = graph

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        return maker_of(self._graph, name, self)

    def __getitem__(self, port: str) -> Node:
        return Node(self._graph, f"{self.id}.{port}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._graph._draft.library, *self._graph._draft.groups]

    def __repr__(self) -> str:
        kind = self._graph._draft.nodes.get(self.id, {}).get("type", "stream")
        return f"<{kind} '{self.id}'>"


class Stack(Node):
    """A stack: operators and groups called on it are put at its end, and give the stack again."""


def maker_of(graph: Graph, name: str, source: Node | None = None) -> Callable[..., Any]:
    """Return what makes something of a type; its nodes take the stream of `source`, and a stack takes its operators."""
    draft = graph._draft
    if name in draft.groups:
        kind, node_type = "group", None
    elif name in draft.library:
        kind, node_type = draft.library.kind_of(name), draft.library[name]
    else:
        known = [*draft.library, *draft.groups]
        raise missing(f"there is no node type, value or group '{name}'.", name, known, draft.library.other_names)
    grows = isinstance(source, Stack) and kind in ("operators", "group") and name != "stack"

    def make(id: str = "", /, **given: Any) -> Any:
        if not isinstance(id, str):
            raise fault(f"what stands first in {name}(...) is its id, a text; give everything else by name")
        if node_type is not None and (kind == "values" or (kind == "selectors" and not id and source is None)):
            return _value(node_type, id, given)
        entry = {"from" if key == "of" else key: part for key, part in given.items() if part is not None}
        if grows and source is not None and "from" not in entry:
            draft.append(source.id, {"type": name, **({"id": id} if id else {}), **entry})
            return source
        if source is not None and "inputs" not in entry:
            entry.setdefault("from", source)
        return _node(graph, id or name, {"type": name, **({"ops": []} if name == "stack" else {}), **entry})

    return _described(make, name, node_type)


def _value(node_type: NodeType, id: str, given: dict[str, Any]) -> Value:
    """Return a value node, or a selector that stands inside another node."""
    name, parameters = node_type.name, node_type.parameters
    if id:
        raise fault(f"{name} is a value and has no id; give its parameters by name")
    per = {"per": given.pop("per")} if "per" in given and "per" not in parameters else {}
    for key in given:
        if key not in parameters:
            raise fault(f"{name} has no parameter '{key}'.", parameters, wrong=key, path=f"{name}.{key}",
                        notes=(takes(name, parameters.values()), declared(node_type)))
    return Value({name: {key: part for key, part in given.items() if part is not None}, **per})


def _node(graph: Graph, id: str, entry: dict[str, Any]) -> Node:
    draft = graph._draft
    if id in draft.nodes:
        first = draft.places.of(f"nodes.{id}")
        raise fault(f"there is a node '{id}' already, made at {first}; give this one another id", path=f"nodes.{id}")
    draft.add({"nodes": {id: entry}})
    return graph[id]


def _described(make: Callable[..., Any], name: str, node_type: NodeType | None) -> Callable[..., Any]:
    """Return a maker with the name, the docs and the signature of its node type, for `help` and for editors."""
    make.__name__ = make.__qualname__ = name
    if node_type is not None:
        make.__doc__ = node_type.doc
        first = inspect.Parameter("id", inspect.Parameter.POSITIONAL_ONLY, default="")
        others = [inspect.Parameter(parameter.name, inspect.Parameter.KEYWORD_ONLY,
                                    default=inspect.Parameter.empty if parameter.required else parameter.default)
                  for parameter in node_type.parameters.values()]
        rest = inspect.Parameter("common", inspect.Parameter.VAR_KEYWORD)
        make.__signature__ = inspect.Signature([first, *others, rest])  # type: ignore[attr-defined]
    return make
