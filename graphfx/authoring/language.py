"""What a graph says besides its nodes: parameters, attributes, values, groups, inputs and outputs."""

from __future__ import annotations

from pathlib import PurePath
from typing import Any

from graphfx.authoring.draft import Draft
from graphfx.authoring.nodes import Node
from graphfx.authoring.values import Value


def _stated(**keys: Any) -> dict[str, Any]:
    """Return the keys that are given."""
    return {key: given for key, given in keys.items() if given is not None}


def type_of(default: Any) -> str:
    """Return the type of a parameter or attribute with this default: 1.0 is a float, 1 an int, three numbers a vec3."""
    if isinstance(default, bool):
        return "bool"
    if isinstance(default, int):
        return "int"
    if isinstance(default, str):
        return "color" if default.startswith("#") else "string"
    if isinstance(default, list | tuple):
        return {2: "interval", 3: "vec3"}.get(len(default), "list")
    return "float"


class Language:
    """The words of the language that are no nodes."""

    _draft: Draft

    def expr(self, text: str) -> Value:
        """Return the value of an expression: `g.expr("1 - age / life")`."""
        return Value({"expr": text})

    def keys(self, *pairs: Any, interpolation: str | None = None, repeat: str | None = None) -> Value:
        """Return a value with keys in time: `g.keys((0, 1), (2, 5))`, times in seconds."""
        return Value({"keys": list(pairs), **_stated(interpolation=interpolation, repeat=repeat)})

    def ramp(self, *pairs: Any, over: Any = None, interpolation: str | None = None) -> Value:
        """Return a value with points over the normalized age, or over what `over` says."""
        return Value({"ramp": list(pairs), **_stated(over=over, interpolation=interpolation)})

    def rand(self, low: Any, high: Any, *, per: str | None = None, vary: float | None = None) -> Value:
        """Return a value drawn evenly between two, once for each particle unless `per` says otherwise."""
        return Value({"rand": [low, high], **_stated(per=per, vary=vary)})

    def param(self, name: str, default: Any = None, *, type: str | None = None, min: float | None = None,
              max: float | None = None, unit: str | None = None, doc: str | None = None) -> Value:
        """Declare a parameter of the graph, and return the value that it has; with a name alone, only return it.

        The type follows from the default unless it is given.
        """
        if (default, type, min, max, unit, doc) != (None,) * 6:
            declared = _stated(type=type or type_of(default), default=default, min=min, max=max, unit=unit, doc=doc)
            self._draft.add({"params": {name: declared}})
        return Value({"param": name})

    def attribute(self, name: str, default: Any = 0.0, *, type: str | None = None, unit: str | None = None,
                  doc: str | None = None) -> Value:
        """Declare an attribute of the graph's own, and return the value that a particle has."""
        declared = _stated(type=type or type_of(float(default) if isinstance(default, int) else default),
                           default=default, unit=unit, doc=doc)
        self._draft.add({"attributes": {name: declared}})
        return Value({"expr": name})

    def use(self, path: str, name: str | None = None) -> None:
        """Name a group's file, sought beside the graph and then in the libraries; its file's name is its own unless given."""
        self._draft.add({"use": {name or PurePath(path).stem: path}})

    def values(self, **named: Any) -> None:
        """Name values, for expressions to read."""
        self._draft.add({"values": named})

    def input(self, name: str, doc: str | None = None) -> Node:
        """Declare a stream that this graph takes where it is used as a group; return it."""
        self._draft.add({"inputs": {name: _stated(doc=doc)}})
        return Node(self, name)  # type: ignore[arg-type]

    def output(self, **streams: Node) -> None:
        """Name the streams that this graph gives where it is used as a group."""
        self._draft.add({"outputs": streams})

    def expose(self, *parameters: str) -> None:
        """Make parameters of nodes parameters of the graph: `g.expose("left.tightness")`."""
        self._draft.add({"expose": [*self._draft.data.get("expose", ()), *parameters]})
