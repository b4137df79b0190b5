"""Decorators that make a node type of a function: its signature is its contract."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

from graphfx.errors import Location, NodeError, Problem, suggestion
from graphfx.node.signature import (
    ParameterMark,
    check_flow,
    check_read,
    check_result_names,
    check_results,
    read_parameter,
    result_types,
)
from graphfx.node.source import line_of_argument, stray_name, wrong_return
from graphfx.node.types import ATTRIBUTES, DERIVED_ATTRIBUTES, NOISE, RESERVED, WAY, NodeType, Parameter

RESPONSE = (
    Parameter("resilience", "float", 0.5, "", 0.0, 1.0, (), "Share of the speed across the surface that a bounce gives back."),
    Parameter("friction", "float", 0.0, "", 0.0, 1.0, (), "Share of the speed along the surface that a bounce takes."),
    Parameter("friction_threshold", "float", 0.0, "m/s", 0.0, None, (), "Friction does not act on a particle slower than this."),
    Parameter("rest_speed", "float", 0.0, "m/s", 0.0, None, (), "A particle that would leave more slowly comes to rest at once."),
    Parameter("event_speed", "float", 0.1, "m/s", 0.0, None, (), "A slower hit counts as no event, unless it ends in rest."),
    Parameter("response", "string", "bounce", "", None, None, ("bounce", "stick", "slide", "die"), "What it does at a hit."),
)
"""Parameters that every surface has besides its function's: how a particle answers to the contact."""

PROCESS = (
    Parameter("process", "string", "hold", "", None, None, ("hold", "brownian"), "New each 1/24 s, or Brownian motion."),
)
"""Parameter that every noise has besides its function's, if that takes the engine's random vector."""

TRANSFORM = (
    Parameter("translate", "vec3", (0.0, 0.0, 0.0), "m", None, None, (), "Moves the mesh, after it was scaled and rotated."),
    Parameter("rotate", "vec3", (0.0, 0.0, 0.0), "degrees", None, None, (), "Turns it about the x, then y, then z axis."),
    Parameter("scale", "vec3", (1.0, 1.0, 1.0), "", None, None, (), "Stretches it along its own x, y and z axes."),
)
"""Parameters that every geometry has besides its function's: where it stands. They may change with time."""


def declare(function: Callable[..., Any], kind: str, role: str, *, writes: Any = (), language: bool = False,
            neutral: str = "", exact_if: str = "", linear: Callable[..., Any] | None = None,
            flow: Callable[..., Any] | None = None, branches: bool = False, results: tuple[str, ...] = ()) -> NodeType:
    """Read a function's signature into a `NodeType`; raise `NodeError` at the function's own line."""
    source = Path(inspect.getsourcefile(function) or "")
    location = Location(str(source), function.__code__.co_firstlineno)
    name = function.__name__

    def fail(message: str, *notes: str, at: str = "", line: int = 0) -> NodeError:
        line = line_of_argument(function, at) if at else line
        return NodeError(Problem(message, Location(str(source), line or location.line), name, notes))

    if source.stem != name:
        raise fail(f"the file {source.name} must be named {name}.py after its function, or the function {source.stem}")
    doc = inspect.getdoc(inspect.getmodule(function)) or ""
    if not doc:
        raise fail("a node needs a docstring at the top of its file: its formula, and its source")
    stray = "" if language or role == "geometry" else stray_name(function)
    if stray:
        raise fail(f"a function of particles cannot use '{stray}'; it has graphfx.math, and random numbers come as the "
                   "argument `draw`")
    check_flow(role, function, flow, exact_if, fail)
    signature = inspect.signature(function)
    known = (*RESERVED, *{"surface": WAY, "noise": NOISE}.get(role, ()))
    reads: list[str] = []
    reserved: list[str] = []
    parameters: dict[str, Parameter] = {}
    for argument in signature.parameters.values():
        if isinstance(argument.default, ParameterMark):
            parameters[argument.name] = read_parameter(argument, fail, language)
            continue
        check_read(argument, known, fail)
        (reads if argument.name in ATTRIBUTES | DERIVED_ATTRIBUTES else reserved).append(argument.name)
    writes = (writes,) if isinstance(writes, str) else tuple(writes)
    result = result_types(signature.return_annotation)
    if not language:
        check_results(role, writes, result, fail)
        message, line = wrong_return(function, len(result))
        if message:
            raise fail(message, line=line)
    if role == "value" and (len(result) > 1 or results):
        check_result_names(results, result, fail)
    if {"draw", *NOISE} <= {*reserved}:
        raise fail("it takes `draw` and `noise`, which are made of the same numbers; take one of them", at="draw")
    given = {parameter.name: parameter for parameter in _given_to(role, reserved)}
    for both in given.keys() & parameters.keys():
        raise fail(f"parameter '{both}' is one that every {role} has besides; choose another name", at=both)
    return NodeType(name, kind, role, function, tuple(signature.parameters), tuple(reads), tuple(reserved), parameters | given,
                    result, writes, neutral, exact_if, branches, language, doc, location, linear, flow, tuple(results))


def _given_to(role: str, reserved: list[str]) -> tuple[Parameter, ...]:
    """Return the parameters that nodes of a role have besides their functions'."""
    return {"surface": RESPONSE, "geometry": TRANSFORM}.get(role, PROCESS if "noise" in reserved else ())


_OPTIONS = ("writes", "neutral", "exact_if", "linear", "flow", "branches", "results")


def _decorator(kind: str, role: str, **fixed: Any) -> Callable[..., Any]:
    def decorator(function: Callable[..., Any] | None = None, **options: Any) -> Any:
        for name in options:
            if name not in _OPTIONS or name in fixed:
                raise TypeError(f"{role} takes no option '{name}'." + suggestion(name, _OPTIONS))

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
    function of a rate of change (its arguments are among the flow's), that it is then a linear operator (one with
    `linear=` and no `exact_if` is that too where all that acts is linear, and so exact together with it); for an
    acceleration with `flow=`, a function (its arguments are among the operator's, and position, velocity and dt), that
    gives position and velocity after dt where nothing else acts;
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
    """An acceleration, random for each particle; an applied velocity, where it writes the position. It is proportional to
    `noise`, a random vector, and its parameter `process` says which. For "hold" that is uniform in the unit ball, new each
    1/24 s. For "brownian" it is white noise, held over a step h: an increment of a Wiener process, normal with variance h
    in each component, over h; so a velocity strength * noise has variance strength^2 t after a time t, and a strength is
    in m/s^1.5. A function that takes `draw`, four random numbers new each 1/24 s, is held only."""
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
