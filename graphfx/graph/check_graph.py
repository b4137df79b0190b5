"""The parts of a document around its nodes: time, parameters, inputs, outputs, what is exposed."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from graphfx.errors import suggestion
from graphfx.graph.check_streams import check_stream
from graphfx.graph.checking import Checking, listed, nearest
from graphfx.graph.flat import TimeSettings
from graphfx.graph.items import Item, shown
from graphfx.graph.literals import Literals, lane
from graphfx.graph.model import Entry, Graph, StreamReference
from graphfx.graph.names import ID, METHODS, ORDERS, PARAM_KEYS, PARAM_TYPES, REFERENCE_TYPES, TIME_KEYS, WORD
from graphfx.graph.values import Literal, ParameterValue
from graphfx.node import COMMON_KEYS, Parameter

_TIME = {
    "fps": Parameter("fps", "float", None, min=0.001, max=1e6),
    "preroll": Parameter("preroll", "float", None, unit="s", min=0, max=1e6),
    "substeps": Parameter("substeps", "int", None, min=1, max=1000),
    "method": Parameter("method", "string", None, choices=METHODS),
    "order": Parameter("order", "int", None, choices=tuple(map(str, ORDERS))),
    "tolerance": Parameter("tolerance", "float", None, unit="m", min=1e-15, max=1e6),
    "precision": Parameter("precision", "int", None, choices=("32", "64")),
}
_SEED = Parameter("seed", "int", None, min=0, max=2**63 - 1)
_FRAME = Parameter("frames", "int", None, min=-10_000_000, max=10_000_000)
_OTHER_TYPES = {"vector": "vec3", "colour": "color", "number": "float", "boolean": "bool", "integer": "int", "text": "string"}
_GROUP_KEYS = (*COMMON_KEYS, "inputs")


class GraphReader:
    """Reads what stands around the nodes of one graph."""

    def __init__(self, checking: Checking, graph: Graph, literals: Literals):
        """Fill `graph`."""
        self.checking, self.graph, self.literals, self.complain = checking, graph, literals, checking.complain

    def seed(self, item: Item | None) -> None:
        """Read the seed of all random numbers."""
        value = self.literals.read(item, _SEED, "seed") if item is not None else None
        self.graph.seed = value or 0

    def time(self, item: Item | None) -> None:
        """Read the clock."""
        if item is None:
            return
        if not item.is_object:
            self.checking.mismatch(item, "time", "\"time\" should be an object", f"its keys: {', '.join(TIME_KEYS)}")
            return
        self.checking.unknown_keys(item, "time", TIME_KEYS, "time")
        given: dict[str, Any] = {}
        for key, want in _TIME.items():
            if key in item.value:
                value = self.literals.read(item.value[key], want, f"time.{key}")
                if value is not None:
                    given[key] = value
        if "frames" in item.value:
            first, last = self._frames(item.value["frames"])
            given.update(first=first, last=last)
        known = {field.name for field in fields(TimeSettings)}
        locations = {key: given_item.location for key, given_item in item.entries()}
        self.graph.time = TimeSettings(**{key: value for key, value in given.items() if key in known}, locations=locations)

    def _frames(self, item: Item) -> tuple[int, int]:
        default = TimeSettings()
        if not item.is_list or len(item.value) != 2:
            self.checking.mismatch(item, "time.frames", "frames should be [first, last]")
            return default.first, default.last
        ends = [self.literals.read(part, _FRAME, f"time.frames[{index}]") for index, part in enumerate(item.value)]
        if None in ends:
            return default.first, default.last
        if ends[0] > ends[1]:
            self.complain(item.location, "time.frames",
                          f"the last frame, {ends[1]}, comes before the first, {ends[0]}; write [first, last]")
        return ends[0], ends[1]

    def params(self, item: Item | None) -> None:
        """Read the parameters that the graph declares."""
        if item is not None and not item.is_object:
            self.checking.mismatch(item, "params", "\"params\" should be an object of parameters")
        for name, given in item.entries() if item is not None else ():
            path = f"params.{name}"
            if not self.checking.named(item, name, path, "the name of a parameter", WORD):  # type: ignore[arg-type]
                pass
            elif not given.is_object:
                self.checking.mismatch(given, path, "a parameter should be an object with a \"type\"",
                              'for instance {"type": "float", "default": 1, "min": 0, "doc": "..."}')
            else:
                parameter = self._param(name, given, path)
                if parameter is not None:
                    self.graph.params[name] = parameter
                    self.graph.param_locations[name] = item.key_location(name)  # type: ignore[union-attr]
                    continue
            self.graph.broken.add(path)

    def _param(self, name: str, item: Item, path: str) -> Parameter | None:
        self.checking.unknown_keys(item, path, PARAM_KEYS, "a parameter")
        kind = self._param_type(item, path)
        if not kind:
            return None
        if name in _GROUP_KEYS and (name, kind) != ("during", "interval"):
            self.complain(item.location, path, f"'{name}' is a key that any node may carry; choose another name")
            return None
        unit, doc = (self.checking.text(item.value[key], f"{path}.{key}", key) if key in item.value else ""
                     for key in ("unit", "doc"))
        bound = {key: self._bound(item, key, kind, path) for key in ("min", "max")}
        low, high = bound["min"], bound["max"]
        if low is not None and high is not None and low > high:
            self.complain(item.value["max"].location, f"{path}.max", "the maximum lies below the minimum")
            low = high = None
        parameter = Parameter(name, kind, None, unit, low, high, (), doc, "default" not in item.value)
        if parameter.required:
            return parameter
        default = item.value["default"]
        if kind == "mesh":
            self.complain(default.location, f"{path}.default", "a mesh has no default; who uses the group names one of its own")
            return replace(parameter, required=True)
        if default.is_object or default.broken:
            if default.is_object:
                self.complain(default.location, f"{path}.default", "a default should be written out, not made by a value")
            return replace(parameter, required=True)
        value = self.literals.read(default, parameter, f"{path}.default")
        return replace(parameter, default=value, required=value is None)

    def _param_type(self, item: Item, path: str) -> str:
        given = item.value.get("type")
        types = f"types: {', '.join(PARAM_TYPES)}"
        if given is None:
            self.complain(item.location, path, 'a parameter needs a "type"', types)
        elif given.is_text and given.value in PARAM_TYPES:
            return str(given.value)
        else:
            near = suggestion(given.value, PARAM_TYPES, _OTHER_TYPES) if given.is_text else ""
            stands = shown(given.value) if given.is_text else given.words
            self.complain(given.location, f"{path}.type", f"no parameter has the type {stands}." + near, types)
        return ""

    def _bound(self, item: Item, key: str, kind: str, path: str) -> float | None:
        given = item.value.get(key)
        if given is None:
            return None
        if lane(kind) not in ("float", "vec3") and kind not in ("interval", "list"):
            self.complain(given.location, f"{path}.{key}", f"a parameter of type {kind} has no {key}; leave it out")
            return None
        value = self.literals.read(given, Parameter(key, "float", None), f"{path}.{key}")
        return None if value is None else float(value)

    def inputs(self, item: Item | None) -> None:
        """Read the streams that a group takes."""
        if item is not None and not item.is_object:
            self.checking.mismatch(item, "inputs", "\"inputs\" should be an object {name: {\"doc\": ...}}")
        for name, given in item.entries() if item is not None else ():
            path = f"inputs.{name}"
            if not self.checking.named(item, name, path, "the name of an input", ID):  # type: ignore[arg-type]
                continue
            if not given.is_object:
                self.checking.mismatch(given, path, "an input should be an object such as {\"doc\": \"...\"}")
            else:
                self.checking.unknown_keys(given, path, ("doc",), "an input")
                doc = given.value.get("doc")
                self.graph.inputs[name] = self.checking.text(doc, f"{path}.doc", "doc") if doc else ""

    def outputs(self, item: Item | None) -> None:
        """Read the streams that a group gives; what they name is looked up here."""
        if item is not None and not item.is_object:
            self.checking.mismatch(item, "outputs", "\"outputs\" should be an object {name: id}")
        for name, given in item.entries() if item is not None else ():
            path = f"outputs.{name}"
            if not self.checking.named(item, name, path, "the name of an output", ID):  # type: ignore[arg-type]
                continue
            text = self.checking.text(given, path, "an output, the id of a node,")
            node, _, port = text.partition(".")
            reference = StreamReference(node, port, given.location, path)
            if text and check_stream(self.checking, self.graph, reference):
                self.graph.outputs[name] = reference

    def expose(self, item: Item | None) -> None:
        """Pass parameters of inner nodes up: each becomes a parameter of the graph, by its own name."""
        if item is not None and not item.is_list:
            self.checking.mismatch(item, "expose", "\"expose\" should be a list such as [\"left.tightness\"]")
            return
        for index, given in enumerate(item.value) if item is not None else ():
            path = f"expose[{index}]"
            text = self.checking.text(given, path, "what is exposed, \"node.parameter\",")
            if text:
                self._expose(given, text, path)

    def _expose(self, item: Item, text: str, path: str) -> None:
        place, _, name = text.rpartition(".")
        entries = {entry.place: entry for node in self.graph.nodes.values() for entry in (node, *node.ops)}
        entry = entries.get(place)
        if entry is None:
            self.complain(item.location, path, f"'{text}' should be \"node.parameter\", and there is no node '{place}'."
                          + nearest(place, entries), f"nodes: {listed(entries)}")
            return
        parameters = _exposable(entry)
        if name not in parameters:
            self.complain(item.location, path,
                          f"{entry.type_name} has no parameter '{name}' to expose." + suggestion(name, parameters),
                          f"its parameters: {', '.join(parameters) or 'none'}")
            return
        if name in self.graph.params:
            self.complain(item.location, path, f"the graph has a parameter '{name}' already; one of the two must go")
            return
        given = entry.arguments.get(name)
        if given is not None and not isinstance(given, Literal):
            self.complain(given.location, given.path,
                          f"'{text}' is exposed, so its value here is only a default and should be written out")
            return
        parameter = parameters[name]
        if given is not None:
            parameter = replace(parameter, default=given.value, required=False)
        self.graph.params[name] = parameter
        self.graph.param_locations[name] = item.location
        entry.arguments[name] = ParameterValue(parameter.type, item.location, path, "", name)


def _exposable(entry: Entry) -> dict[str, Parameter]:
    parameters = entry.group.params if entry.group else entry.node_type.parameters if entry.node_type else {}
    return {name: parameter for name, parameter in parameters.items() if parameter.type not in REFERENCE_TYPES}
