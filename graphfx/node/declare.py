"""Decorators that make a node type of a function: its signature is its contract."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphfx.errors import Location, NodeError, Problem, suggestion
from graphfx.math import Vec3
from graphfx.node.types import (
    ATTRIBUTES,
    COMMON_KEYS,
    DERIVED_ATTRIBUTES,
    NUMERIC_TYPES,
    OTHER_TYPES,
    RESERVED,
    WAY,
    NodeType,
    Parameter,
)

_ANNOTATIONS = {float: "float", int: "int", bool: "bool", str: "string", Vec3: "vec3"}
_BY_TEXT = {"float": "float", "int": "int", "bool": "bool", "str": "string", "Vec3": "vec3", "Mesh": "mesh"}


RESPONSE = (
    Parameter("resilience", "float", 0.5, "", 0.0, 1.0, (), "Share of the speed across the surface that a bounce gives back."),
    Parameter("friction", "float", 0.0, "", 0.0, 1.0, (), "Share of the speed along the surface that a bounce takes."),
    Parameter("friction_threshold", "float", 0.0, "m/s", 0.0, None, (), "Friction does not act on a particle slower than this."),
    Parameter("rest_speed", "float", 0.01, "m/s", 0.0, None, (), "A particle that would leave more slowly comes to rest."),
)
"""Parameters that every surface has besides its function's: how a particle answers to the contact."""

TRANSFORM = (
    Parameter("translate", "vec3", (0.0, 0.0, 0.0), "m", None, None, (), "Moves the mesh, after it was scaled and rotated."),
    Parameter("rotate", "vec3", (0.0, 0.0, 0.0), "degrees", None, None, (), "Turns it about the x, then y, then z axis."),
    Parameter("scale", "vec3", (1.0, 1.0, 1.0), "", None, None, (), "Stretches it along its own x, y and z axes."),
)
"""Parameters that every geometry has besides its function's: where it stands. They may change with time."""


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
    doc: str,
    unit: str = "",
    min: float | None = None,
    max: float | None = None,
    type: str = "",
    direction: bool = False,
    choices: tuple[str, ...] = (),
    required: bool = False,
) -> Any:
    """Mark an argument as a parameter.

    `type` names a type where the annotation is not enough ("color", "path", "stream", ...);
    `direction=True` has the engine hand the function a unit vector; `required=True` has no default.
    """
    return ParameterMark(default, unit, min, max, "direction" if direction else type, choices, doc, required)


def _parameter(name: str, argument: inspect.Parameter, fail: Callable[[str], NodeError], language: bool) -> Parameter:
    """Read a parameter; only one of the language may have no default, where the engine finds it."""
    mark = argument.default
    kind = mark.type or _type_name(argument.annotation)
    if kind not in NUMERIC_TYPES and kind not in OTHER_TYPES:
        raise fail(f"parameter '{name}' has the type {argument.annotation!r}; annotate it float, int, bool, str or Vec3, "
                   f"or say type= one of {', '.join((*NUMERIC_TYPES, *OTHER_TYPES))}")
    if name in COMMON_KEYS:
        raise fail(f"parameter '{name}' has the name of a key that every node may carry; choose another")
    if not mark.doc or not mark.doc.strip().endswith("."):
        raise fail(f"parameter '{name}' needs doc= one sentence that ends with a full stop")
    default = mark.default
    if kind in NUMERIC_TYPES and not mark.required and not (language and default is None):
        size = NUMERIC_TYPES[kind]
        if size == 3 and (not isinstance(default, tuple) or len(default) != 3):
            raise fail(f"parameter '{name}' needs a default of three numbers, such as (0, 0, 0)")
        default = tuple(float(v) for v in default) if size == 3 else default
        for value in default if size == 3 else (default,):
            low, high = mark.min, mark.max
            if kind != "bool" and ((low is not None and value < low) or (high is not None and value > high)):
                raise fail(f"parameter '{name}' has the default {default}, outside its own range {low} to {high}")
    return Parameter(name, kind, default, mark.unit, mark.min, mark.max, mark.choices, mark.doc.strip(), mark.required)


def _type_name(annotation: Any) -> str:
    if isinstance(annotation, str):
        return _BY_TEXT.get(annotation, annotation)
    if getattr(annotation, "__name__", "") == "Mesh":
        return "mesh"
    return _ANNOTATIONS.get(annotation, str(annotation))


def _result_types(annotation: Any) -> tuple[str, ...]:
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", str(annotation))
    if not isinstance(annotation, str) and getattr(annotation, "__args__", None):
        return tuple(_type_name(part) for part in annotation.__args__)
    if text.startswith("tuple["):
        return tuple(_type_name(part.strip()) for part in text[6:-1].split(","))
    if annotation in (None, "None", inspect.Signature.empty):
        return ()
    return (_type_name(annotation),)


def _check_results(names: tuple[str, ...], types: tuple[str, ...], fail: Callable[[str], NodeError]) -> None:
    """Raise `NodeError` unless each of several results has a name."""
    if len(names) != len(types):
        raise fail(f"it gives {len(types)} results, so @value(results=...) needs a name for each, and has {len(names)}")
    for name in names:
        if not name.isidentifier() or name in ("x", "y", "z") or names.count(name) > 1:
            raise fail(f"a result cannot be called '{name}'; names are words, each once, and not x, y or z")


def declare(function: Callable[..., Any], kind: str, role: str, *, writes: Any = (), language: bool = False,
            neutral: str = "", exact_if: str = "", linear: Callable[..., Any] | None = None, branches: bool = False,
            results: tuple[str, ...] = ()) -> NodeType:
    """Read a function's signature into a `NodeType`; raise `NodeError` at the function's own line."""
    source = Path(inspect.getsourcefile(function) or "")
    location = Location(str(source), function.__code__.co_firstlineno)
    name = function.__name__

    def fail(message: str, *notes: str) -> NodeError:
        return NodeError(Problem(message, location, name, notes))

    if source.stem != name:
        raise fail(f"the file {source.name} must be named {name}.py after its function, or the function {source.stem}")
    doc = inspect.getdoc(inspect.getmodule(function)) or inspect.getdoc(function) or ""
    if not doc:
        raise fail("a node needs a docstring at the top of its file: its formula, and its source")
    signature = inspect.signature(function)
    reads, reserved, parameters = [], [], {}
    for argument in signature.parameters.values():
        if isinstance(argument.default, ParameterMark):
            parameters[argument.name] = _parameter(argument.name, argument, fail, language)
        elif argument.name in RESERVED or (role == "surface" and argument.name in WAY):
            reserved.append(argument.name)
        elif argument.name in ATTRIBUTES or argument.name in DERIVED_ATTRIBUTES:
            reads.append(argument.name)
        else:
            known = (*ATTRIBUTES, *DERIVED_ATTRIBUTES, *RESERVED)
            raise fail(f"argument '{argument.name}' is no attribute and has no param(...)."
                       + suggestion(argument.name, known), f"attributes: {', '.join((*ATTRIBUTES, *DERIVED_ATTRIBUTES))}",
                       f"given by the engine: {', '.join(RESERVED)}")
    writes = (writes,) if isinstance(writes, str) else tuple(writes)
    for attribute in writes:
        if attribute not in ATTRIBUTES:
            raise fail(f"it writes '{attribute}', which is no attribute." + suggestion(attribute, ATTRIBUTES))
    result = _result_types(signature.return_annotation)
    if not language and not result:
        raise fail("the function needs a return annotation: float, bool, Vec3 or tuple[...] of them")
    if role == "value" and (len(result) > 1 or results):
        _check_results(results, result, fail)
    if role == "surface":
        parameters |= {parameter.name: parameter for parameter in RESPONSE}
    elif role == "geometry":
        parameters |= {parameter.name: parameter for parameter in TRANSFORM}
    return NodeType(name, kind, role, function, tuple(signature.parameters), tuple(reads), tuple(reserved), parameters,
                    result, writes, neutral, exact_if, branches, language, doc, location, linear, tuple(results))


def _decorator(kind: str, role: str, **fixed: Any) -> Callable[..., Any]:
    def decorator(function: Callable[..., Any] | None = None, **options: Any) -> Any:
        def attach(function: Callable[..., Any]) -> Callable[..., Any]:
            function.node_type = declare(function, kind, role, **fixed, **options)  # type: ignore[attr-defined]
            return function
        return attach if function is None else attach(function)

    decorator.__name__ = role
    return decorator


class operator:
    """What an operator declares decides how time is handled.

    `neutral=` is a condition on the parameters under which the operator does nothing and is left out;
    `exact_if=` one under which it has an exact form that the engine knows: for a flow with `linear=`, the
    function of a rate of change (its arguments are among the flow's), that it is then a linear operator;
    `branches=True` runs it lane by lane, thirteen times slower, so that its body may use `if`.
    """

    assign = staticmethod(_decorator("operators", "assign"))
    """New values of attributes, at the operator's moment."""
    flow = staticmethod(_decorator("operators", "flow"))
    """The exact change over dt. One that writes position and velocity is the whole motion of a particle on which nothing
    else acts: its velocity carries it. Together with others it acts on the velocity alone, which carries it once."""
    linear = staticmethod(_decorator("operators", "linear"))
    """Its part of the rate of change, linear in position and velocity."""
    acceleration = staticmethod(_decorator("operators", "acceleration", writes="velocity"))
    """Acceleration at (position, velocity, time)."""
    velocity = staticmethod(_decorator("operators", "velocity", writes="position"))
    """Applied velocity at (position, time)."""
    surface = staticmethod(_decorator("operators", "surface"))
    """(signed distance, unit normal) of a surface at a position. One that has no two sides to measure from takes `start`
    and `end` instead, a particle's way in a step, and gives (met, a point, a unit normal to the side of the start): the
    plane at which it stops."""
    noise = staticmethod(_decorator("operators", "noise"))
    """An acceleration that holds for a time cell of 1/24 s; an applied velocity, where it writes the position."""
    pairs = staticmethod(_decorator("operators", "pairs", writes="velocity"))
    """The effect of one neighbour."""


value = _decorator("values", "value")
"""A value that a parameter or attribute may be given; `draw` hands it four random numbers. With several results,
`results=("point", "normal")` names them: the first is the value itself."""
geometry = _decorator("geometry", "geometry")
"""A mesh, made from its parameters before the cook."""
selector = _decorator("selectors", "selector")
"""True for the particles that pass."""


def language(role: str, kind: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Declare a node that the engine itself carries out; its function only states the parameters."""
    return _decorator(kind, role, language=True)()
