"""Read a node function's signature: parameters, results, and what is wrong with them."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from graphfx.errors import NodeError, suggestion
from graphfx.math import Vec3
from graphfx.node.types import ATTRIBUTES, COMMON_KEYS, DERIVED_ATTRIBUTES, NUMERIC_TYPES, OTHER_TYPES, RESERVED, Parameter

Fail = Callable[..., NodeError]
"""Makes the error: a message, notes, and as `at` the argument whose line it names."""

_ANNOTATIONS = {float: "float", int: "int", bool: "bool", str: "string", Vec3: "vec3"}
_BY_TEXT = {"float": "float", "int": "int", "bool": "bool", "str": "string", "Vec3": "vec3", "Mesh": "mesh"}
_SPOKEN = {"float": "float", "vec3": "Vec3", "bool": "bool"}
_PLAIN = {"float": (int, float), "int": (int,), "bool": (bool,), "string": (str,)}
WRITERS = ("assign", "flow", "linear", "acceleration", "velocity", "noise", "pairs")
"""Roles of the operators whose results replace attributes, or are their rates of change."""


@dataclass(frozen=True)
class ParameterMark:
    """What `param(...)` leaves in a signature until the decorator reads it."""

    default: Any
    unit: str
    min: float | None
    max: float | None
    type: str
    choices: tuple[str, ...]
    doc: str
    required: bool


def param(
    default: Any = None,
    *,
    doc: str = "",
    unit: str = "",
    min: float | None = None,
    max: float | None = None,
    type: str = "",
    direction: bool = False,
    choices: tuple[str, ...] = (),
    required: bool = False,
) -> Any:
    """Mark an argument as a parameter; `doc` is one sentence on what it means.

    `type` names a type where the annotation is not enough ("color", "path", "stream", ...);
    `direction=True` has the engine hand the function a unit vector; `required=True` has no default.
    """
    return ParameterMark(default, unit, min, max, "direction" if direction else type, choices, doc, required)


def read_parameter(argument: inspect.Parameter, fail: Fail, language: bool) -> Parameter:
    """Read a parameter; only one of the language may have no default, where the engine finds it."""
    name, mark = argument.name, argument.default
    kind = mark.type or type_name(argument.annotation)
    if kind not in NUMERIC_TYPES and kind not in OTHER_TYPES:
        raise fail(f"parameter '{name}' has the type {_spelled(argument.annotation)}; annotate it float, int, bool, str or Vec3, "
                   f"or say type= one of {', '.join((*NUMERIC_TYPES, *OTHER_TYPES))}", at=name)
    if name in COMMON_KEYS:
        raise fail(f"parameter '{name}' has the name of a key that every node may carry; choose another", at=name)
    if not mark.doc or not mark.doc.strip().endswith("."):
        raise fail(f"parameter '{name}' needs doc= one sentence that ends with a full stop", at=name)
    default = mark.default
    if not mark.required and not (language and default is None):
        default = _read_default(name, kind, mark, fail)
    return Parameter(name, kind, default, mark.unit, mark.min, mark.max, mark.choices, mark.doc.strip(), mark.required)


def _read_default(name: str, kind: str, mark: ParameterMark, fail: Fail) -> Any:
    """Return a default in the form that the engine has it in."""
    default, size = mark.default, NUMERIC_TYPES.get(kind, 1)
    if size == 3:
        if not isinstance(default, tuple) or len(default) != 3:
            raise fail(f"parameter '{name}' needs a default of three numbers, such as (0, 0, 0)", at=name)
        default = tuple(float(part) for part in default)
    elif kind in _PLAIN and (not isinstance(default, _PLAIN[kind]) or (isinstance(default, bool) and kind != "bool")):
        raise fail(f"parameter '{name}' is a {kind}, and its default {default!r} is none", at=name)
    if kind in NUMERIC_TYPES and kind != "bool":
        low, high = mark.min, mark.max
        for value in default if size == 3 else (default,):
            if (low is not None and value < low) or (high is not None and value > high):
                raise fail(f"parameter '{name}' has the default {default}, outside its own range {low} to {high}", at=name)
    return default


def type_name(annotation: Any) -> str:
    """Return the type that an annotation means, or the annotation itself where it means none."""
    if isinstance(annotation, str):
        return _BY_TEXT.get(annotation, annotation)
    if getattr(annotation, "__name__", "") == "Mesh":
        return "mesh"
    return _ANNOTATIONS.get(annotation, str(annotation))


def result_types(annotation: Any) -> tuple[str, ...]:
    """Return the types of a function's results."""
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", str(annotation))
    if not isinstance(annotation, str) and getattr(annotation, "__args__", None):
        return tuple(type_name(part) for part in annotation.__args__)
    if text.startswith("tuple["):
        return tuple(type_name(part.strip()) for part in text[6:-1].split(","))
    if annotation in (None, "None", inspect.Signature.empty):
        return ()
    return (type_name(annotation),)


def check_read(argument: inspect.Parameter, known: Iterable[str], fail: Fail) -> None:
    """Raise `NodeError` where an argument is neither parameter nor attribute, or an attribute of another type."""
    name, attributes = argument.name, ATTRIBUTES | DERIVED_ATTRIBUTES
    if name in attributes:
        kind = _lane(attributes[name].type)
        if argument.annotation is not inspect.Parameter.empty and _lane(type_name(argument.annotation)) != kind:
            raise fail(f"'{name}' is a {_SPOKEN[kind]}, and is annotated {_spelled(argument.annotation)}", at=name)
    elif name not in known and argument.default is not inspect.Parameter.empty:
        raise fail(f"argument '{name}' has a default but no param(...); write {name}: {_spelled(argument.annotation)} = "
                   f'param({argument.default!r}, doc="...")', at=name)
    elif name not in known:
        raise fail(f"argument '{name}' is no attribute and has no param(...)." + suggestion(name, (*attributes, *RESERVED)),
                   f"attributes: {', '.join(attributes)}", f"given by the engine: {', '.join(RESERVED)}", at=name)


def check_results(role: str, writes: tuple[str, ...], result: tuple[str, ...], fail: Fail) -> None:
    """Raise `NodeError` where a function does not return what its decorator says that it gives."""
    for attribute in writes:
        if attribute not in ATTRIBUTES:
            raise fail(f"it writes '{attribute}', which is no attribute." + suggestion(attribute, ATTRIBUTES))
    if not result:
        raise fail("the function needs a return annotation: float, bool, Vec3 or tuple[...] of them")
    wanted: tuple[str, ...] = ()
    if role in WRITERS:
        if not writes:
            raise fail(f'the decorator needs writes=, the attributes that it gives: @operator.{role}(writes="position")')
        wanted = tuple(_lane(ATTRIBUTES[name].type) for name in writes)
    elif role == "selector":
        wanted = ("bool",)
    elif role == "surface":
        wanted = ("bool", "vec3", "vec3") if len(result) == 3 else ("float", "vec3")
    if wanted and tuple(map(_lane, result)) != wanted:
        gives = f"it writes {', '.join(writes)}" if writes else f"a {role}"
        verb = ", so it returns" if writes else " returns"
        raise fail(f"{gives}{verb} {_tuple(wanted)}, and it is annotated {_tuple(result)}")


def check_flow(role: str, function: Callable[..., Any], flow: Callable[..., Any] | None, exact_if: str, fail: Fail) -> None:
    """Raise `NodeError` where `flow=` is not the exact flow of an acceleration."""
    if flow is None:
        return
    if role != "acceleration" or not exact_if:
        raise fail("flow= is the exact flow of an acceleration, and needs exact_if=, the condition under which it has one: "
                   '@operator.acceleration(flow=..., exact_if="softening == 0")')
    known = {*inspect.signature(function).parameters, "position", "velocity", "dt"}
    for name in inspect.signature(flow).parameters:
        if name not in known:
            raise fail(f"its flow {flow.__name__} takes '{name}', which is no argument of the operator, nor position, velocity "
                       "or dt." + suggestion(name, known))
    if result_types(inspect.signature(flow).return_annotation) != ("vec3", "vec3"):
        raise fail(f"its flow {flow.__name__} gives position and velocity: annotate it -> tuple[Vec3, Vec3]")
    if not (flow.__doc__ or "").strip().endswith("."):
        raise fail(f"its flow {flow.__name__} needs a docstring, one sentence with a full stop: plans give it as reason")


def check_result_names(names: tuple[str, ...], types: tuple[str, ...], fail: Fail) -> None:
    """Raise `NodeError` unless each of several results has a name."""
    if len(names) != len(types):
        raise fail(f"it gives {len(types)} results, so @value(results=...) needs a name for each, and has {len(names)}")
    for name in names:
        if not name.isidentifier() or name in ("x", "y", "z") or names.count(name) > 1:
            raise fail(f"a result cannot be called '{name}'; names are words, each once, and not x, y or z")


def _lane(kind: str) -> str:
    return "vec3" if NUMERIC_TYPES.get(kind) == 3 else {"int": "float"}.get(kind, kind)


def _tuple(types: tuple[str, ...]) -> str:
    words = [_SPOKEN.get(kind, kind) for kind in types]
    return words[0] if len(words) == 1 else f"tuple[{', '.join(words)}]"


def _spelled(annotation: Any) -> str:
    if annotation is inspect.Parameter.empty:
        return "float"
    return annotation if isinstance(annotation, str) or not hasattr(annotation, "__name__") or hasattr(annotation, "__args__") \
        else str(annotation.__name__)
