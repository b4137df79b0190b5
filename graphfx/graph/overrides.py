"""What stands for the parameters of a graph that is cooked: `--set name=value`, or the defaults."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from graphfx.errors import GraphError, Location, suggestion
from graphfx.graph.check_values import default_value
from graphfx.graph.checking import Checking
from graphfx.graph.items import Item, Source
from graphfx.graph.literals import Literals, lane
from graphfx.graph.model import Graph
from graphfx.graph.reader import read
from graphfx.graph.values import Literal, Value


def override(graph: Graph, checking: Checking, overrides: Mapping[str, Any]) -> dict[str, Value]:
    """Return a value for each parameter; complain of overrides that name none, or do not fit."""
    for name, text in overrides.items():
        if name not in graph.params:
            checking.complain(_place(name, text), "", f"the graph has no parameter '{name}'." + suggestion(name, graph.params),
                              f"its parameters: {graph.parameter_line}" if graph.params else "it has no parameters")
    given: dict[str, Value] = {}
    for name, parameter in graph.params.items():
        path = f"params.{name}"
        if name in overrides:
            value = _read(graph, checking, name, overrides[name])
            if value is not None:
                given[name] = value
        elif parameter.required:
            checking.complain(graph.param_locations.get(name, graph.location), path,
                              f"this parameter has no default; give it one, "
                              f"or a value for this cook: --set {name}=...")
        else:
            given[name] = default_value(parameter, path)
    return given


_ENDLESS, _QUOTED = re.compile(r"(?<![\w\"-])-?infinity\b"), r'"\g<0>"'


def _place(name: str, value: Any) -> Location:
    return Location(f"--set {name}={value if isinstance(value, str) else json.dumps(value, default=str)}")


def _read(graph: Graph, checking: Checking, name: str, value: Any) -> Value | None:
    parameter = graph.params[name]
    place = _place(name, value)
    text = value if isinstance(value, str) else json.dumps(value, default=str)
    item = Item(text, 0, Source(place.file, text))
    if parameter.type not in ("string", "path") or not isinstance(value, str):
        listed = lane(parameter.type) in ("vec3", "interval", "list") and not text.lstrip().startswith(("[", "#", '"'))
        try:
            found, problems = read(f"[{_ENDLESS.sub(_QUOTED, text)}]" if listed else text, place.file)
        except GraphError:
            found, problems = item, []
        item = item if problems else found
    inner = Checking(checking.library, checking.limits)
    folders = [*([graph.folder] if graph.folder else []), *(root / "graphs" for root in checking.library.roots)]
    result = Literals(inner, folders).read(item, parameter, f"params.{name}")
    checking.problems.extend(replace(problem, location=place) for problem in inner.problems)
    return None if result is None else Literal(parameter.type, place, f"params.{name}", "", result)
