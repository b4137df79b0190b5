"""A JSON Schema (2020-12) of the language with a library's node types: editors complete and check by it.

It knows types, parameters, ranges, units and docs. What needs a reader (references, expressions, groups)
is for `check`.
"""

from __future__ import annotations

from typing import Any

from graphfx.graph.literals import VECTORS, lane
from graphfx.graph.names import (
    ATTRIBUTE_TYPES,
    CLUSTER_WAYS,
    ID,
    INTERPOLATIONS,
    LOOKS,
    METHODS,
    MOMENTS,
    ORDERS,
    PARAM_TYPES,
    PICTURES,
    REFERENCE_TYPES,
    REPEATS,
    SCOPES,
    TAIL,
    WORD,
    keys_of,
)
from graphfx.graph.own import RESERVED_WORDS
from graphfx.graph.sets import wanted_of
from graphfx.node import ATTRIBUTES, Library, NodeType, Parameter

Schema = dict[str, Any]
_NODE_KINDS = ("emitters", "selectors", "operators", "renders", "geometry")
_TEXT: Schema = {"type": "string"}
_NUMBER: Schema = {"type": "number"}
_ENDLESS: Schema = {"enum": ["infinity", "-infinity"]}
_VECTOR: Schema = {"type": "array", "prefixItems": [_NUMBER] * 3, "minItems": 3, "maxItems": 3}
_END: Schema = {"anyOf": [_NUMBER, _ENDLESS]}
_INTERVAL: Schema = {"type": "array", "prefixItems": [_END] * 2, "minItems": 2, "maxItems": 2}
_HEX = "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$"
_COLOR: Schema = {"type": "string", "pattern": _HEX}


def schema(library: Library) -> Schema:
    """Return the schema of graphs over the node types of a library."""
    types = [library[name] for name in sorted(library)]
    nodes = [node_type for node_type in types if node_type.kind in _NODE_KINDS]
    operators = [node_type for node_type in nodes if node_type.kind == "operators" and node_type.role != "stack"]
    definitions: Schema = {
        "node": _choice(nodes, "A node, or an instance of a group.", "id"),
        "operator": _choice(operators, "An operator of a stack, or a group with one stream in and one out.", "from"),
        "stream": {"type": "string", "pattern": r"^[A-Za-z_][A-Za-z0-9_-]*(\.[A-Za-z_][A-Za-z0-9_-]*)?$",
                   "description": "The id of a node that makes a stream, or id.output of a group."},
        "attributes": _attributes(tuple(ATTRIBUTES)),
        "attributes_and_tail": _attributes((*ATTRIBUTES, *TAIL)),
        "condition": _condition(),
        "any_value": {"anyOf": [{"$ref": f"#/$defs/{kind}_value"} for kind in ("float", "vec3", "bool")] + [
            _NUMBER, _VECTOR, {"type": "string", "pattern": _HEX}, {"type": "boolean"}]},
        "parameter": _parameter_declaration(),
    }
    values = [node_type for node_type in types if node_type.kind in ("values", "selectors")]
    for kind in ("float", "vec3", "bool"):
        fitting = [node_type for node_type in values if node_type.result and lane(node_type.result[0]) == kind]
        definitions[f"{kind}_value"] = _values(kind, fitting)
    for node_type in nodes:
        definitions[f"type_{node_type.name}"] = _type(node_type)
    for node_type in values:
        definitions[f"value_{node_type.name}"] = _arguments(node_type)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "A graphfx graph", **_top(), "$defs": definitions}


def _closed(properties: Schema, required: tuple[str, ...] = (), description: str = "") -> Schema:
    """Return the schema of an object with these keys, and any that begin with `x-`."""
    result: Schema = {"type": "object", "properties": properties, "patternProperties": {"^x-": True}}
    if required:
        result["required"] = list(required)
    return result | {"additionalProperties": False} | ({"description": description} if description else {})


def _map(entries: Schema, pattern: str, description: str) -> Schema:
    return {"type": "object", "patternProperties": {"^x-": True, f"^(?!x-){pattern}$": entries}, "additionalProperties": False,
            "description": description}


def _top() -> Schema:
    identifier, word = ID.pattern, WORD.pattern
    time = _closed({
        "fps": {"type": "number", "exclusiveMinimum": 0, "default": 24, "description": "Frames per second."},
        "frames": {"type": "array", "prefixItems": [{"type": "integer"}] * 2, "minItems": 2, "maxItems": 2,
                   "description": "First and last frame."},
        "preroll": {"type": "number", "minimum": 0, "default": 0, "description": "Seconds simulated before the first frame."},
        "substeps": {"type": "integer", "minimum": 1, "maximum": 1000, "default": 1, "description": "Steps of a frame."},
        "method": {"enum": list(METHODS), "default": "auto", "description": "How motion is computed."},
        "order": {"enum": list(ORDERS), "default": 6, "description": "Order of the method adaptive."},
        "tolerance": {"type": "number", "exclusiveMinimum": 0, "default": 1e-3, "description": "Error of a position [m]."},
        "precision": {"enum": [32, 64], "default": 32, "description": "Bits of a number."},
    }, description="The clock.")
    properties: Schema = {
        "$schema": _TEXT,
        "graphfx": {"const": 1, "description": "The version of the language."},
        "doc": _TEXT,
        "seed": {"type": "integer", "minimum": 0, "default": 0, "description": "Seed of all random numbers."},
        "time": time,
        "use": _map(_TEXT, identifier, "Groups: a name for each, and the path of its file."),
        "params": _map({"$ref": "#/$defs/parameter"}, word, "Parameters of the graph."),
        "attributes": _map(_closed({"type": {"enum": list(ATTRIBUTE_TYPES)},
                                    "default": {"anyOf": [_NUMBER, _ENDLESS, _VECTOR, _COLOR]}, "unit": _TEXT,
                                    "doc": _TEXT}, ("type",)), word, "Attributes of the graph's own."),
        "values": _map({"$ref": "#/$defs/any_value"}, word, "Named values, for expressions."),
        "inputs": _map(_closed({"doc": _TEXT}), identifier, "Streams that a group takes."),
        "outputs": _map({"$ref": "#/$defs/stream"}, identifier, "Streams that a group gives."),
        "expose": {"type": "array", "items": _TEXT, "description": "Parameters of inner nodes to pass up: node.parameter."},
        "nodes": _map({"$ref": "#/$defs/node"}, identifier, "Nodes by id."),
    }
    return _closed(properties, ("graphfx", "nodes"))


def _parameter_declaration() -> Schema:
    return _closed({
        "type": {"enum": list(PARAM_TYPES)}, "default": True, "min": _NUMBER, "max": _NUMBER, "unit": _TEXT, "doc": _TEXT,
    }, ("type",), "A parameter that the graph declares.")


def _choice(types: list[NodeType], description: str, without: str) -> Schema:
    """Return a schema that follows a node's `type`; types that it does not know are groups."""
    names = [node_type.name for node_type in types]
    known = [{"const": node_type.name, "description": _summary(node_type)} for node_type in types]
    group = {"type": "string", "not": {"enum": names}, "description": "A group, named under \"use\"."}
    return {
        "type": "object", "required": ["type"], "description": description,
        "properties": {"type": {"anyOf": [*known, group]}, without: False},
        "allOf": [{"if": {"properties": {"type": {"const": name}}, "required": ["type"]},
                   "then": {"$ref": f"#/$defs/type_{name}"}} for name in names],
    }


def _type(node_type: NodeType) -> Schema:
    keys = keys_of(node_type.role, node_type.kind)
    common = {key: part for key, part in _common(node_type).items() if key in keys}
    parameters = {parameter.name: _place(parameter) for parameter in node_type.parameters.values()}
    required = tuple(parameter.name for parameter in node_type.parameters.values() if parameter.required)
    if node_type.role in ("stack", "set", "fade"):
        required += ("ops" if node_type.role == "stack" else "set",)
    return _closed({**common, **parameters}, required, _summary(node_type))


def _common(node_type: NodeType) -> Schema:
    stream = {"$ref": "#/$defs/stream"}
    look: Schema = {key: {"enum": list(choices), "default": choices[0]} for key, choices in LOOKS.items()}
    point = {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number", "minimum": 0, "maximum": 1}}
    ramp = {"ramp": {"type": "array", "items": point, "minItems": 1}}
    look["falloff"] = {"anyOf": [look["falloff"], _closed(ramp, ("ramp",), "Opacity over distance / radius.")]}
    look = _closed({"stream": stream, **look}, ("stream",))
    source = {"anyOf": [stream, look]} if node_type.role in PICTURES else stream
    return {
        "type": {"const": node_type.name},
        "id": {"type": "string", "pattern": f"^{ID.pattern}$", "description": "By default the type."},
        "doc": _TEXT,
        "from": {"anyOf": [source, {"type": "array", "items": source, "minItems": 1}],
                 "description": "Whose particles it takes."},
        "ops": {"type": "array", "items": {"$ref": "#/$defs/operator"}, "description": "Operators, in order."},
        "when": _moment(node_type.role),
        "only": {"$ref": "#/$defs/condition"},
        "during": {"anyOf": [{"type": "array", "minItems": 2, "maxItems": 2, "items": {"anyOf": [_NUMBER, _ENDLESS, _given()]}},
                             _given()],
                   "description": "Start and end of the time that it acts in [s]."},
        "enabled": {"anyOf": [{"type": "boolean"}, _given()], "default": True},
        "seed_key": {"type": "string", "description": "Keys its random numbers in place of its path."},
        "per": _scope(),
        "clusters": _map(_closed({"count": {"anyOf": [{"type": "integer", "minimum": 1}, _given()]},
                                  "by": {"anyOf": [{"enum": list(CLUSTER_WAYS), "default": CLUSTER_WAYS[0]}, _given()]}},
                                 ("count",)), WORD.pattern, "Numbers given to its particles, for draws that many share."),
        "set": {"$ref": f"#/$defs/attributes{'_and_tail' * (node_type.role == 'set')}"},
        "values": _map({"$ref": "#/$defs/any_value"}, WORD.pattern, "Named values, for this node's expressions."),
    }


def _attributes(names: tuple[str, ...]) -> Schema:
    """Return the schema of `set`; other names may be the graph's own, but not what others call one of graphfx's."""
    known = _closed({name: _place(wanted_of(name)) for name in names})
    own = f"^(?!x-|({'|'.join(sorted(RESERVED_WORDS))})$){WORD.pattern}$"
    return known | {"patternProperties": {"^x-": True, own: {"$ref": "#/$defs/any_value"}}}


def _condition() -> Schema:
    one = {"$ref": "#/$defs/condition"}
    many = {"type": "array", "items": one, "minItems": 1}
    return {"anyOf": [{"type": "boolean"}, _TEXT, {"$ref": "#/$defs/bool_value"}, _closed({"all": many}, ("all",)),
                      _closed({"any": many}, ("any",)), _closed({"not": one}, ("not",))],
            "description": "Particles that it acts on: a condition, the id of a selector, or several joined by all, any, not."}


def _moment(role: str) -> Schema | bool:
    """Return what `when` may be."""
    if role not in MOMENTS:
        return False
    moments = [moment for moment in MOMENTS[role] if moment]
    surfaces = _closed({"hit": {"type": "array", "items": _TEXT, "minItems": 1}}, ("hit",), "Hits on these surfaces.")
    default = {"default": MOMENTS[role][0]} if MOMENTS[role][0] else {}
    return {"anyOf": [{"enum": moments}, *([surfaces] if "hit" in moments else [])], **default}


def _scope() -> Schema:
    return {"anyOf": [{"enum": list(SCOPES), "default": SCOPES[0]}, {"type": "string", "pattern": f"^{WORD.pattern}$"}],
            "description": "What has one draw: also a cluster, by its name."}


def _given() -> Schema:
    return {"anyOf": [_closed({"param": _TEXT}, ("param",)), _closed({"expr": _TEXT}, ("expr",))]}


def _values(kind: str, nodes: list[NodeType]) -> Schema:
    """Return the schema of values, other than literals, of one type that expressions know."""
    vector = {"anyOf": [_VECTOR, {"type": "string", "pattern": _HEX}]}
    literal = {"float": {"anyOf": [_NUMBER, _ENDLESS]}, "vec3": vector, "bool": {"type": "boolean"}}[kind]
    part = {"anyOf": [literal, {"$ref": f"#/$defs/{kind}_value"}]}
    pair = {"type": "array", "prefixItems": [_NUMBER, literal], "minItems": 2, "maxItems": 2}
    pairs = {"type": "array", "items": pair, "minItems": 1}
    scope = _scope()
    forms = [
        _closed({"param": _TEXT}, ("param",), "A parameter of the graph."),
        _closed({"expr": _TEXT}, ("expr",), "An expression of attributes, time, param.x and named values."),
    ]
    if kind != "bool":
        forms += [
            _closed({"keys": pairs, "interpolation": {"enum": list(INTERPOLATIONS)}, "repeat": {"enum": list(REPEATS)}},
                    ("keys",), "Values at times [s]."),
            _closed({"ramp": pairs, "over": {"anyOf": [_TEXT, {"$ref": "#/$defs/float_value"}], "default": "normalized_age"},
                     "interpolation": {"enum": list(INTERPOLATIONS)}},
                    ("ramp",), "Values over another value."),
            _closed({"rand": {"type": "array", "prefixItems": [part, part], "minItems": 2, "maxItems": 2}, "per": scope,
                     "vary": {"type": "number", "minimum": 0, "maximum": 1}}, ("rand",), "A random value between two."),
        ]
    for node in nodes:
        forms.append(_closed({node.name: {"$ref": f"#/$defs/value_{node.name}"}, "per": scope}, (node.name,), _summary(node)))
    if kind == "vec3":
        component = {"anyOf": [_NUMBER, {"$ref": "#/$defs/float_value"}]}
        forms.append({"type": "array", "items": component, "minItems": 3, "maxItems": 3})
    return {"anyOf": forms}


def _arguments(node_type: NodeType) -> Schema:
    required = tuple(parameter.name for parameter in node_type.parameters.values() if parameter.required)
    return _closed({name: _place(parameter) for name, parameter in node_type.parameters.items()}, required, _summary(node_type))


def _place(parameter: Parameter) -> Schema:
    """Return what may stand for a parameter: literals within its range, and values of its type."""
    literal = _literal(parameter)
    kind = lane(parameter.type)
    result: Schema = {"description": f"{parameter.doc} [{parameter.unit}]" if parameter.unit else parameter.doc}
    default = _default(parameter)
    if default is not None and not parameter.required:
        result["default"] = default
    if parameter.type in REFERENCE_TYPES:
        return result | ({"anyOf": [literal, _closed({"param": _TEXT}, ("param",))]} if kind == "mesh" else literal)
    values = {"$ref": f"#/$defs/{kind}_value"} if kind in ("float", "vec3", "bool") else _closed({"param": _TEXT}, ("param",))
    return result | {"anyOf": [literal, values]}


def _literal(parameter: Parameter) -> Schema:
    bounds = {key: value for key, value in (("minimum", parameter.min), ("maximum", parameter.max)) if value is not None}
    number = {"type": "integer" if parameter.type == "int" else "number", **bounds}
    kind = parameter.type
    if parameter.choices and kind == "list":
        return {"type": "array", "items": {"enum": list(parameter.choices)}, "uniqueItems": True}
    if kind == "nodes":
        return {"type": "array", "items": _TEXT}
    if parameter.choices and kind not in REFERENCE_TYPES:
        return {"enum": [int(choice) for choice in parameter.choices] if kind == "int" else list(parameter.choices)}
    if kind == "float":
        endless = [text for text, bound in (("infinity", parameter.max), ("-infinity", parameter.min)) if bound is None]
        return {"anyOf": [number, {"enum": endless}]} if endless else number
    if kind in VECTORS:
        vector = {"type": "array", "prefixItems": [number] * 3, "minItems": 3, "maxItems": 3}
        return {"anyOf": [vector, {"type": "string", "pattern": _HEX}]} if kind == "color" else vector
    if kind == "list":
        size = {"minItems": len(parameter.default), "maxItems": len(parameter.default)} if parameter.default else {}
        return {"type": "array", "items": {"anyOf": [{**number, "type": "number"}, _TEXT]}, **size}
    others: dict[str, Schema] = {"int": number, "bool": {"type": "boolean"}, "interval": _INTERVAL}
    return others.get(kind, _TEXT)


def _default(parameter: Parameter) -> Any:
    default = parameter.default
    if default in (float("inf"), float("-inf")):
        return "infinity" if default > 0 else "-infinity"
    return list(default) if isinstance(default, tuple) else default


def _summary(node_type: NodeType) -> str:
    return node_type.doc.split("\n\n")[0].replace("\n", " ")
