"""The one canonical form of a document, so that files differ only where graphs do.

Keys stand in a fixed order, parameters in the order of their declaration; what stands at its default is
left out; nodes keep their order. What a graph means does not change, and keys that begin with `x-` stay.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from graphfx.errors import GraphError, NodeError
from graphfx.graph.document import Document
from graphfx.graph.layout import lay_out
from graphfx.graph.literals import color
from graphfx.graph.names import (
    ATTRIBUTE_KEYS,
    CLUSTER_KEYS,
    CLUSTER_WAYS,
    CONDITIONS,
    INTERPOLATIONS,
    KEYS,
    LOOKS,
    MOMENTS,
    PARAM_KEYS,
    REPEATS,
    SCOPES,
    TIME_KEYS,
    TOP_KEYS,
    VALUE_KEYS,
)
from graphfx.node import ATTRIBUTES, Library, NodeType, Parameter

_FIRST = ("type", "id", "doc", "from", "inputs", "when", "only", "during", "enabled", "seed_key", "per")
_LAST = ("clusters", "values", "set", "ops")
_MODIFIERS = {"interpolation": INTERPOLATIONS[0], "repeat": REPEATS[0], "over": "normalized_age", "per": SCOPES[0], "vary": 0}
_VALUES = ("values", "selectors")
_BROKEN = ("", "nodes")
_ENDLESS = {"infinity": float("inf"), "-infinity": float("-inf")}


def canonical(document: Document, library: Library) -> str:
    """Return a document's canonical text; raise `GraphError` where it is not JSON."""
    if document.problems:
        raise GraphError(list(document.problems))
    return lay_out(_Canonical(library).graph(document.root.data()), broken=_BROKEN) + "\n"


def _ordered(data: Mapping[str, Any], order: Iterable[str]) -> dict[str, Any]:
    """Return an object with keys in an order; others follow as they stand, and last those that begin with `x-`."""
    known = [key for key in order if key in data]
    rest = [key for key in data if key not in known]
    return {key: data[key] for key in [*known, *sorted(rest, key=lambda key: key.startswith("x-"))]}


class _Canonical:
    def __init__(self, library: Library):
        self.library = library
        self.used: frozenset[str] = frozenset()

    def type(self, name: Any) -> NodeType | None:
        try:
            return self.library[name] if isinstance(name, str) and name in self.library and name not in self.used else None
        except NodeError:
            return None

    def graph(self, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        data = _ordered(data, TOP_KEYS)
        self.used = frozenset(data["use"]) if isinstance(data.get("use"), dict) else frozenset()
        if isinstance(data.get("time"), dict):
            data["time"] = _ordered(data["time"], TIME_KEYS)
        for key, part in (("params", self.param), ("attributes", self.attribute), ("values", self.value), ("nodes", self.node)):
            if isinstance(data.get(key), dict):
                data[key] = {name: entry if name.startswith("x-") else part(entry) for name, entry in data[key].items()}
        for key in ("use", "params", "attributes", "values", "inputs", "outputs", "expose"):
            if data.get(key) in ({}, []):
                del data[key]
        return data

    def param(self, data: Any) -> Any:
        return _ordered(data, PARAM_KEYS) if isinstance(data, dict) else data

    def attribute(self, data: Any) -> Any:
        return _ordered(data, ATTRIBUTE_KEYS) if isinstance(data, dict) else data

    def cluster(self, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        data = _ordered(data, CLUSTER_KEYS)
        return {key: self.value(entry) for key, entry in data.items() if (key, entry) != ("by", CLUSTER_WAYS[0])}

    def node(self, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        node_type = self.type(data.get("type"))
        parameters = node_type.parameters if node_type else {}
        given = {key: entry for key, entry in data.items() if key not in _FIRST and key not in _LAST and key not in parameters}
        data = _ordered(data, [*_FIRST, *parameters, *(key for key in given if not key.startswith("x-")), *_LAST])
        for key, entry in list(data.items()):
            if key.startswith("x-"):
                continue
            if key in parameters:
                burst = key == "rate" and "count" in data
                if _is_default(entry, parameters[key]) and not burst:
                    del data[key]
                else:
                    data[key] = self.value(entry)
            elif key in given or key in ("only", "during", "enabled"):
                data[key] = self.value(entry)
        self._shared(data, node_type)
        self._inner(data, node_type)
        return data

    def _shared(self, data: dict[str, Any], node_type: NodeType | None) -> None:
        """Leave out the language's own keys where they say what is so anyway."""
        moment = MOMENTS.get(node_type.role, ("",))[0] if node_type is not None else ""
        if moment and data.get("when") == moment:
            del data["when"]
        if data.get("per") == SCOPES[0] and node_type is not None and node_type.kind == "selectors":
            del data["per"]
        if data.get("enabled") is True:
            del data["enabled"]
        if data.get("id") == data.get("type"):
            data.pop("id", None)

    def _inner(self, data: dict[str, Any], node_type: NodeType | None) -> None:
        """Put what a node contains into canonical form: operators, attributes, named values, looks."""
        if isinstance(data.get("ops"), list):
            data["ops"] = [self.node(op) for op in data["ops"]]
        if isinstance(data.get("clusters"), dict):
            data["clusters"] = {name: entry if name.startswith("x-") else self.cluster(entry)
                                for name, entry in data["clusters"].items()}
            if not data["clusters"] and node_type is not None and node_type.role == "emit":
                del data["clusters"]
        for key, order in (("set", ATTRIBUTES), ("values", ())):
            if isinstance(data.get(key), dict):
                entries = _ordered(data[key], order)
                data[key] = {name: entry if name.startswith("x-") else self.value(entry) for name, entry in entries.items()}
                if not data[key] and (node_type is None or "set" not in KEYS.get(node_type.role, ()) or node_type.role == "emit"):
                    del data[key]
        source = data.get("from")
        if isinstance(source, dict):
            data["from"] = _look(source)
        elif isinstance(source, list):
            looks = [_look(entry) if isinstance(entry, dict) else entry for entry in source]
            data["from"] = looks[0] if len(looks) == 1 and isinstance(looks[0], str | dict) else looks

    def value(self, data: Any) -> Any:
        """Put a value into canonical form, its parts too."""
        if isinstance(data, list):
            return [self.value(part) for part in data]
        if not isinstance(data, dict):
            return data
        node_type = next((found for key in data if (found := self.type(key)) and found.kind in _VALUES), None)
        name = node_type.name if node_type else next((key for key in data if key in VALUE_KEYS or key in CONDITIONS), "")
        modifiers = () if name in CONDITIONS else VALUE_KEYS.get(name, ("per",))
        data = _ordered(data, (name, *modifiers))
        for key, entry in list(data.items()):
            if key in modifiers and type(entry) is not bool and entry == _MODIFIERS[key]:
                del data[key]
            elif key == name and node_type and isinstance(entry, dict):
                data[key] = self._arguments(entry, node_type)
            elif key == name or key in modifiers:
                data[key] = self.value(entry)
        return data

    def _arguments(self, data: dict[str, Any], node_type: NodeType) -> dict[str, Any]:
        parameters = node_type.parameters
        kept = {key: entry for key, entry in data.items() if key not in parameters or not _is_default(entry, parameters[key])}
        return {key: entry if key.startswith("x-") else self.value(entry) for key, entry in _ordered(kept, parameters).items()}


def _look(data: dict[str, Any]) -> Any:
    """Return an entry of an image's `from`; one without looks of its own is its stream's id."""
    kept = {key: entry for key, entry in data.items() if key not in LOOKS or entry != LOOKS[key][0]}
    return kept["stream"] if list(kept) == ["stream"] and isinstance(kept["stream"], str) else _ordered(kept, ("stream", *LOOKS))


def _is_default(data: Any, parameter: Parameter) -> bool:
    """Return whether what a document gives is what the parameter is without it."""
    default = parameter.default
    if parameter.required or default is None:
        return False
    if isinstance(data, str) and parameter.type == "color":
        return color(data) == tuple(default)
    if isinstance(data, str) and data in _ENDLESS and parameter.type == "float":
        return bool(default == _ENDLESS[data])
    if isinstance(default, tuple | list):
        return isinstance(data, list) and len(data) == len(default) and all(map(_same, data, default))
    return _same(data, default)


def _same(one: Any, other: Any) -> bool:
    return isinstance(one, bool) == isinstance(other, bool) and not isinstance(one, dict | list) and bool(one == other)
